"""Replace a file only by a whole one."""

from __future__ import annotations

import errno
import os
import re
import stat
import time
from collections.abc import Mapping
from pathlib import Path

from bobdesk.errors import InputError
from bobdesk.files.new_file import new_file

# Virus scanners, indexers and synchronised folders open a file just after it was written, for a moment.
_PAUSES_S = (0.02, 0.05, 0.1, 0.2, 0.4) if os.name == "nt" else ()
STAGED = (".bobdesk-", ".part")  # how the name of a file begins and ends that is not yet in its place


def write_atomic(path: Path, content: bytes) -> None:
    """Write a file beside its place, flush it to the disk, and move it there.

    Whatever fails leaves what was there before. A link stays a link; what it points to is replaced.

    Raises
    ------
    InputError
        If the file cannot be written; the sentence says why.
    """
    write_all({path: content})


def write_all(files: Mapping[Path, bytes]) -> None:
    """Write files as `write_atomic` does, and none of them unless all fit on the disk.

    Raises
    ------
    InputError
        If one of them cannot be written; the sentence says which and why.
    """
    staged: list[tuple[Path, Path]] = []
    try:
        for path, content in files.items():
            check_writable(path)
            try:
                place = resolved(path)
                staged.append((_staged(place, content), place))
            except (OSError, ValueError) as error:
                raise InputError(f"{_shown(path)}: cannot be written: {reason(error)}") from error
        for temporary, place in staged:
            try:
                _moved(temporary, place)
            except OSError as error:
                raise InputError(f"{place}: cannot be written: {reason(error)}") from error
    finally:
        for temporary, _ in staged:
            temporary.unlink(missing_ok=True)


def _moved(temporary: Path, place: Path) -> None:
    """Put a file in its place; on Windows wait a moment for programs that have the old one open."""
    for pause in _PAUSES_S:
        try:
            temporary.replace(place)
        except PermissionError:
            time.sleep(pause)
        else:
            return
    temporary.replace(place)


def check_writable(path: Path) -> None:
    """Refuse an output that cannot be written before the work is done, not after.

    Raises
    ------
    InputError
        If the folder is missing or closed, or the path is a folder or a device.
    """
    try:
        _check_writable(path)
    except (OSError, ValueError) as error:
        raise InputError(f"{_shown(path)}: cannot be written: {reason(error)}") from error


def resolved(path: Path) -> Path:
    """Return where a path leads, through links.

    Raises
    ------
    OSError
        If it leads nowhere, in a circle.
    """
    try:
        place = path.resolve()
    except RuntimeError:  # what Python before 3.13 raises; later ones return the link itself
        place = path
    if place.is_symlink():
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    return place


def _check_writable(path: Path) -> None:
    folder = resolved(path).parent if path.is_symlink() else path.parent
    if os.name == "nt" and is_windows_device(path.name):
        raise InputError(f"{path}: cannot be written: Windows keeps that name for a device; choose another")
    if path.is_dir():
        raise InputError(f"{path}: cannot be written: it is a folder")
    # To replace a device or a pipe by a file would break it for every program of the computer.
    if path.exists() and not stat.S_ISREG(path.stat().st_mode):
        raise InputError(f"{path}: cannot be written: it is no ordinary file")
    if not folder.is_dir():
        raise InputError(f"{path}: cannot be written: there is no folder {folder}")
    if not os.access(folder, os.W_OK) or (path.exists() and not os.access(path, os.W_OK)):
        raise InputError(f"{path}: cannot be written: permission denied")


def is_windows_device(name: str) -> bool:
    """Return whether Windows takes a file's name for a device, whatever its ending."""
    stem = name.split(".")[0].rstrip(" ").upper()
    return stem in ("CON", "PRN", "AUX", "NUL") or bool(re.fullmatch(r"(COM|LPT)[1-9¹²³]", stem))


def reason(error: OSError | ValueError) -> str:
    """Return why a file operation failed, in words; a name with a zero byte in it is a ValueError."""
    strerror = error.strerror if isinstance(error, OSError) else None
    return (strerror or str(error)).lower()


def _shown(path: Path) -> str:
    return str(path).replace("\0", "\\0")


def _staged(path: Path, content: bytes) -> Path:
    """Write the content beside its place, and return where."""
    handle, temporary = new_file(path.parent, prefix=STAGED[0], suffix=STAGED[1])
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        temporary.chmod(_mode_of(path))
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    return temporary


def _mode_of(path: Path) -> int:
    """Return the permissions of the file that is replaced, or those that a new file gets."""
    if path.exists():
        return path.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask

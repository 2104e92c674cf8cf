"""Replace a file only by a whole one."""

from __future__ import annotations

import os
import stat
import tempfile
from collections.abc import Mapping
from pathlib import Path

from bobdesk.errors import InputError


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
                place = path.resolve()
                staged.append((_staged(place, content), place))
            except OSError as error:
                raise InputError(f"{path}: cannot be written: {reason(error)}") from error
        for temporary, place in staged:
            try:
                temporary.replace(place)
            except OSError as error:
                raise InputError(f"{place}: cannot be written: {reason(error)}") from error
    finally:
        for temporary, _ in staged:
            temporary.unlink(missing_ok=True)


def check_writable(path: Path) -> None:
    """Refuse an output that cannot be written before the work is done, not after.

    Raises
    ------
    InputError
        If the folder is missing or closed, or the path is a folder or a device.
    """
    try:
        _check_writable(path)
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {reason(error)}") from error


def _check_writable(path: Path) -> None:
    folder = path.parent
    if path.is_dir():
        raise InputError(f"{path}: cannot be written: it is a folder")
    # To replace a device or a pipe by a file would break it for every program of the computer.
    if path.exists() and not stat.S_ISREG(path.stat().st_mode):
        raise InputError(f"{path}: cannot be written: it is no ordinary file")
    if not folder.is_dir():
        raise InputError(f"{path}: cannot be written: there is no folder {folder}")
    if not os.access(folder, os.W_OK) or (path.exists() and not os.access(path, os.W_OK)):
        raise InputError(f"{path}: cannot be written: permission denied")


def reason(error: OSError) -> str:
    """Return why a file operation failed, in words."""
    return (error.strerror or str(error)).lower()


def _staged(path: Path, content: bytes) -> Path:
    """Write the content beside its place, and return where."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=".bobdesk-", suffix=".part")
    temporary = Path(name)
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

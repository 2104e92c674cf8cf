"""Replace a file only by a whole one."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from bobdesk.errors import InputError


def write_atomic(path: Path, content: bytes) -> None:
    """Write a file beside its place, flush it to the disk, and move it there.

    Whatever fails leaves what was there before.

    Raises
    ------
    InputError
        If the file cannot be written; the sentence says why.
    """
    try:
        _write(path, content)
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {reason(error)}") from error


def check_writable(path: Path) -> None:
    """Refuse an output that cannot be written before the work is done, not after.

    Raises
    ------
    InputError
        If the folder is missing or closed, or the path is a folder.
    """
    folder = path.parent
    if path.is_dir():
        raise InputError(f"{path}: cannot be written: it is a folder")
    if not folder.is_dir():
        raise InputError(f"{path}: cannot be written: there is no folder {folder}")
    if not os.access(folder, os.W_OK) or (path.exists() and not os.access(path, os.W_OK)):
        raise InputError(f"{path}: cannot be written: permission denied")


def reason(error: OSError) -> str:
    """Return why a file operation failed, in words."""
    return (error.strerror or str(error)).lower()


def _write(path: Path, content: bytes) -> None:
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=".part")
    temporary = Path(name)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        temporary.chmod(_mode_of(path))
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def _mode_of(path: Path) -> int:
    """Return the permissions of the file that is replaced, or those that a new file gets."""
    if path.exists():
        return path.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask

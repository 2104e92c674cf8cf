"""A lock for one project file: a second BobDesk that opens it is told.

The lock is held by the system and ends with the process, however that ends: there is never one to
clean up by hand. It lies in the user's data folder, since the project's own may be read-only; so it tells
of other windows of this user, not of other computers.
"""

from __future__ import annotations

import contextlib
import errno
import hashlib
import os
import sys
from pathlib import Path
from typing import IO

_HELD = (errno.EACCES, errno.EAGAIN, errno.EWOULDBLOCK, errno.EDEADLK)  # other errors: locks do not work there
_LOCKED_BYTE = 1 << 30  # past the text, so that Windows lets others read that


class FileLock:
    """A lock on a file of its own."""

    def __init__(self, stream: IO[bytes]) -> None:
        self._stream = stream

    def release(self) -> None:
        """Give the lock back."""
        self._stream.close()


def take_lock(path: Path) -> FileLock | None:
    """Return the lock at `path`, or None while another process or window holds it.

    Raises
    ------
    OSError
        If there is no place for it.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    stream = path.open("a+b")
    try:
        _lock(stream)
    except OSError as error:
        stream.close()
        if error.errno in _HELD:
            return None
        raise
    return FileLock(stream)


def take_project_lock(folder: Path, project: Path) -> FileLock | None:
    """Return the lock for the project file `project`, or None while it is open elsewhere.

    Raises
    ------
    OSError
        If the user's data `folder` has no place for it.
    """
    name = os.path.normcase(os.path.realpath(project))
    digest = hashlib.sha256(name.encode("utf-8", "surrogateescape")).hexdigest()[:24]
    return take_lock(folder / "open" / f"{digest}.lock")


def is_locked(path: Path) -> bool:
    """Return whether some process holds the lock at `path`."""
    if not path.exists():
        return False
    with contextlib.suppress(OSError):
        lock = take_lock(path)
        if lock is None:
            return True
        lock.release()
    return False


if sys.platform == "win32":
    import msvcrt

    def _lock(stream: IO[bytes]) -> None:
        stream.seek(_LOCKED_BYTE)
        msvcrt.locking(stream.fileno(), msvcrt.LK_NBLCK, 1)

else:
    import fcntl

    def _lock(stream: IO[bytes]) -> None:
        fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)

"""A new file with a name that no other has."""

from __future__ import annotations

import os
import secrets
from pathlib import Path

_TRIES = 100
# What only some systems have: bytes as they are, and a file that helper processes do not inherit.
_MORE_FLAGS = getattr(os, "O_BINARY", 0) | getattr(os, "O_NOINHERIT", 0) | getattr(os, "O_NOFOLLOW", 0)


def new_file(folder: Path, *, prefix: str = "", suffix: str = "") -> tuple[int, Path]:
    """Open a new file, which only this user may read, and return its descriptor and its path.

    `tempfile.mkstemp` does so, too; but where Windows refuses a folder it takes that for a name which is taken, and
    goes on with two thousand million others.

    Raises
    ------
    OSError
        If the folder takes no file.
    """
    for _try in range(_TRIES):
        path = folder / f"{prefix}{secrets.token_hex(6)}{suffix}"
        try:
            return os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL | _MORE_FLAGS, 0o600), path
        except FileExistsError:
            continue
    raise FileExistsError(f"{folder} has no name left for a new file")

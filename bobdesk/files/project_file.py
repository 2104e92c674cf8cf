"""The project file, NAME.bobdesk: saved whole or not at all, opened whole or with one sentence."""

from __future__ import annotations

import contextlib
import time
from pathlib import Path

from bobdesk.errors import InputError
from bobdesk.files.atomic import STAGED, write_atomic
from bobdesk.files.project_archive import DOCUMENT, archive_bytes, begins_like_a_project, entries_in, read_archive
from bobdesk.files.project_decoding import checked, decode_project
from bobdesk.files.project_encoding import encode_project
from bobdesk.project.project import Project

SUFFIX = ".bobdesk"
_LEFT_AFTER_S = 60.0  # no save takes as long, so that of another window is left alone


def save_project(project: Project, path: Path) -> None:
    """Write a project; whatever fails leaves the file that was there before.

    What could not be opened again is not written. Saving the same project twice gives the same bytes.

    Raises
    ------
    InputError
        If it cannot be written; the sentence says why.
    """
    try:
        content = archive_bytes(checked(encode_project(project)))
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    write_atomic(path, content)
    _sweep(path)


def _sweep(path: Path) -> None:
    """Delete what a crash in the middle of an earlier save left beside the file."""
    with contextlib.suppress(OSError):
        for place in path.parent.iterdir():
            left = place.name.startswith(STAGED[0]) and place.name.endswith(STAGED[1])
            if left and time.time() - place.stat().st_mtime > _LEFT_AFTER_S:
                place.unlink(missing_ok=True)


def load_project(path: Path) -> Project:
    """Return the project in a file.

    Raises
    ------
    InputError
        If it is missing, unreadable, damaged, no project, made by a newer BobDesk, or over a limit.
    """
    try:
        entries = read_archive(path)
        return decode_project(entries[DOCUMENT], lambda name: entries[name])
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    except MemoryError:
        raise InputError(f"{path}: there is not enough memory to open it") from None


def project_in(data: bytes, *, name: str) -> Project:
    """Return the project in a file's bytes; see `load_project`.

    Raises
    ------
    InputError
        If it cannot be used; the sentence names the file `name`.
    """
    try:
        entries = entries_in(data)
        return decode_project(entries[DOCUMENT], lambda entry: entries[entry])
    except InputError as error:
        raise InputError(f"{name}: {error}") from error
    except MemoryError:
        raise InputError(f"{name}: there is not enough memory to open it") from None


def is_project(path: Path) -> bool:
    """Return whether a path names a project file, by its ending or, whatever that is, by what it begins with."""
    if path.suffix.lower() == SUFFIX:
        return True
    try:
        if not path.is_file():
            return False
        with path.open("rb") as stream:
            return begins_like_a_project(stream.read(64))
    except (OSError, ValueError):
        return False

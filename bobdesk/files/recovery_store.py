"""Recovery copies on the disk: one folder for each session, with the newest state of its project.

    recovery/<session>/session.lock   held while the session lives
                       state.json     the document, what is shown of it to the user, and the names of its blobs
                       <digest>       the picture and tables, each written once

`state.json` is replaced as a whole after the blobs that it names are there, so that a crash at any
moment leaves a state that can be read.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import shutil
from dataclasses import dataclass
from pathlib import Path

import msgspec

from bobdesk.errors import InputError
from bobdesk.files.atomic import reason, write_atomic
from bobdesk.files.instance_lock import is_locked
from bobdesk.files.project_decoding import decode_project
from bobdesk.files.project_encoding import Encoded
from bobdesk.project.project import Project

KEPT = 10
LOCK = "session.lock"
STATE = "state.json"
_LARGEST_STATE = 300_000_000


class _State(msgspec.Struct, forbid_unknown_fields=True):
    format: str
    version: int
    name: str
    path: str | None
    time: float
    last_edit: str
    document: str
    blobs: dict[str, str]
    path_bytes: str | None = None  # of a path that is no text, in hexadecimal


@dataclass(frozen=True)
class Recoverable:
    """A project that a session left behind.

    Attributes
    ----------
    folder
        Where its copy lies.
    name
        Of the project.
    path
        Of its file, or None for one that was never saved.
    time
        Of the copy, seconds since 1970.
    last_edit
        Label of the last edit in it.
    """

    folder: Path
    name: str
    path: Path | None
    time: float
    last_edit: str


def recovery_folder(data_folder: Path) -> Path:
    """Return where the copies lie in the user's data folder."""
    return data_folder / "recovery"


def recoverable(data_folder: Path) -> tuple[Recoverable, ...]:
    """Return what sessions that are no longer alive left behind, newest first."""
    found = []
    for folder in _sessions(data_folder):
        if is_locked(folder / LOCK):
            continue
        with contextlib.suppress(InputError):
            state = _read(folder)
            found.append(Recoverable(folder, state.name, _path(state), state.time, state.last_edit))
    return tuple(sorted(found, key=lambda item: -item.time))


def recover(item: Recoverable) -> Project:
    """Return the project of a recovery copy, which stays where it is.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    try:
        state = _read(item.folder)

        def blob(name: str) -> bytes:
            digest = state.blobs[name]
            content = (item.folder / _checked(digest)).read_bytes()
            if hashlib.sha256(content).hexdigest() != digest:
                raise ValueError("a part of it is damaged")
            return content

        return decode_project(state.document.encode(), blob)
    except InputError as error:
        raise InputError(f"the recovery copy of {item.name or 'the project'} cannot be used: {error}") from error
    except OSError as error:
        raise InputError(
            f"the recovery copy of {item.name or 'the project'} cannot be read: {reason(error)}"
        ) from error


def forget(item: Recoverable) -> None:
    """Delete a recovery copy: the user has it, or does not want it."""
    shutil.rmtree(item.folder, ignore_errors=True)


def forget_old(data_folder: Path, *, kept: int = KEPT) -> None:
    """Delete all copies of dead sessions but the newest ones; empty ones too."""
    newest = recoverable(data_folder)
    for item in newest[kept:]:
        forget(item)
    for folder in _sessions(data_folder):
        if not (folder / STATE).exists() and not is_locked(folder / LOCK):
            shutil.rmtree(folder, ignore_errors=True)


def write_state(
    folder: Path,
    encoded: Encoded,
    digests: dict[str, str],
    *,
    name: str,
    path: Path | None,
    time: float,
    last_edit: str,
) -> None:
    """Write the newest state of a session: first new blobs, then the state, then old blobs go.

    Raises
    ------
    InputError
        If the disk does not take it; the state before is still whole.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{folder}: cannot be written: {reason(error)}") from error
    for blob, content in encoded.blobs.items():
        place = folder / digests[blob]
        if not place.exists():
            write_atomic(place, content)
    state = _State(
        format="bobdesk-recovery",
        version=1,
        name=_text(name),
        path=None if path is None else _text(str(path)),
        time=time,
        last_edit=_text(last_edit),
        document=encoded.document.decode(),
        blobs=digests,
        path_bytes=None if path is None or _text(str(path)) == str(path) else os.fsencode(path).hex(),
    )
    write_atomic(folder / STATE, msgspec.json.encode(state))
    _delete_unused(folder, set(digests.values()))


def _delete_unused(folder: Path, used: set[str]) -> None:
    with contextlib.suppress(OSError):
        for place in folder.iterdir():
            if place.name not in used and place.name not in (STATE, LOCK):
                place.unlink(missing_ok=True)


def _sessions(data_folder: Path) -> list[Path]:
    try:
        return sorted(place for place in recovery_folder(data_folder).iterdir() if place.is_dir())
    except OSError:
        return []


def _read(folder: Path) -> _State:
    try:
        place = folder / STATE
        if place.stat().st_size > _LARGEST_STATE:
            raise InputError("it is larger than a project may be")
        state = msgspec.json.decode(place.read_bytes(), type=_State)
    except (msgspec.MsgspecError, RecursionError, ValueError):  # bytes that are no text are a ValueError
        raise InputError("it is damaged") from None
    except OSError as error:
        raise InputError(f"it cannot be read: {reason(error)}") from error
    if state.format != "bobdesk-recovery" or state.version != 1:
        raise InputError("it was made by another version of BobDesk")
    return state


def _path(state: _State) -> Path | None:
    if state.path_bytes is None:
        return None if state.path is None else Path(state.path)
    try:
        return Path(os.fsdecode(bytes.fromhex(state.path_bytes)))
    except ValueError:
        raise InputError("it is damaged") from None


def _text(text: str) -> str:
    """Return text as it is; what a file's name holds that is none becomes question marks."""
    return text.encode("utf-8", "replace").decode()


def _checked(digest: str) -> str:
    if len(digest) != 64 or not set(digest) <= set("0123456789abcdef"):
        raise ValueError("a part of it has a name that none has")
    return digest

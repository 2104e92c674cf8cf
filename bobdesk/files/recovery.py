"""Nothing is lost on a crash: after each edit a copy of the project is written, on a thread of its own."""

from __future__ import annotations

import contextlib
import hashlib
import shutil
import threading
import time
import uuid
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import platformdirs

from bobdesk.errors import InputError
from bobdesk.files.instance_lock import FileLock, take_lock
from bobdesk.files.project_decoding import checked
from bobdesk.files.project_encoding import Encoded, encode_project
from bobdesk.files.recovery_store import LOCK, STATE, forget_old, recovery_folder, write_state
from bobdesk.project.project import Project

_TRY_AGAIN_S = 1.0


def user_data_folder() -> Path:
    """Return the folder that holds BobDesk's own files for this user."""
    return Path(platformdirs.user_data_dir("bobdesk", appauthor=False))


@dataclass(frozen=True, eq=False)
class _Wanted:
    project: Project | None  # None: there is nothing to recover
    path: Path | None
    last_edit: str
    time: float


class Recovery:
    """Keeps the newest state of one window's project on the disk.

    `keep` hands a project to a thread and returns at once; while that is busy, only the newest one waits.
    When the disk fails, `say` is called once, from that thread, with a sentence for the user; it is tried again
    until it works, and only a failure after that is said again.

    Parameters
    ----------
    data_folder
        The user's data folder, see `user_data_folder`.
    say
        Called with a sentence.
    try_again_s
        Seconds between trials on a failing disk.
    """

    def __init__(
        self, data_folder: Path, *, say: Callable[[str], None] = lambda _: None, try_again_s: float = _TRY_AGAIN_S
    ) -> None:
        self.folder = recovery_folder(data_folder) / f"{time.time_ns():020d}-{uuid.uuid4().hex[:8]}"
        self._data_folder = data_folder
        self._say = say
        self._try_again_s = try_again_s
        self._lock: FileLock | None = None
        self._wanted: _Wanted | None = None
        self._changed = threading.Condition()
        self._busy = False
        self._closing = False
        self._picture: tuple[bytes, str] | None = None
        self._thread = threading.Thread(target=self._run, name="recovery", daemon=True)
        self._thread.start()

    def keep(self, project: Project, *, path: Path | None, last_edit: str) -> None:
        """Have a project written soon; returns at once.

        Parameters
        ----------
        project
            As it is after the edit.
        path
            Of its file, or None for one that was never saved.
        last_edit
            Label of the edit.
        """
        with self._changed:
            self._wanted = _Wanted(project, path, last_edit, time.time())
            self._changed.notify_all()

    def saved(self) -> None:
        """Have the copy deleted: the project is in its file, and there is nothing to recover until the next edit."""
        with self._changed:
            self._wanted = _Wanted(None, None, "", time.time())
            self._changed.notify_all()

    def wait(self, timeout: float) -> bool:
        """Wait until all is written; return whether it is."""
        with self._changed:
            return self._changed.wait_for(lambda: self._wanted is None and not self._busy, timeout)

    def close(self, *, forget: bool) -> None:
        """End the thread; `forget` deletes the copy: the project is saved, or not wanted."""
        with self._changed:
            if forget:
                self._wanted = None
            self._closing = True
            self._changed.notify_all()
        self._thread.join()
        if self._lock is not None:
            self._lock.release()
        if forget:
            shutil.rmtree(self.folder, ignore_errors=True)

    def _run(self) -> None:
        said = False
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._wanted is not None or self._closing)
                wanted, self._wanted = self._wanted, None
                if wanted is None:
                    return
                self._busy = True
            failure = self._written(wanted)
            with self._changed:
                self._busy = False
                if failure is not None and self._wanted is None:
                    self._wanted = wanted
                last = failure is not None and self._closing
                self._changed.notify_all()
            if failure is None:
                said = False
            elif not said:
                said = True
                # Who listens may fail; the next copies are written all the same.
                with contextlib.suppress(Exception):
                    self._say(failure)
            if last:
                return
            if failure is not None:
                with self._changed:
                    self._changed.wait_for(lambda: self._closing, self._try_again_s)

    def _written(self, wanted: _Wanted) -> str | None:
        """Write a state; return None, or the sentence that says why it could not be done."""
        if wanted.project is None:
            with contextlib.suppress(OSError):
                (self.folder / STATE).unlink(missing_ok=True)
            return None
        try:
            encoded = checked(encode_project(wanted.project))
            self._take_lock()
            write_state(
                self.folder,
                encoded,
                self._digests(encoded),
                name=_name(wanted.project, wanted.path),
                path=wanted.path,
                time=wanted.time,
                last_edit=wanted.last_edit,
            )
        except InputError as error:
            return f"No recovery copy could be written, and it is tried again: {error}"
        except (OSError, MemoryError) as error:
            return f"No recovery copy could be written, and it is tried again: {str(error).lower() or 'memory is full'}"
        # Whatever is wrong with one state, the thread must live for the next one.
        except Exception as error:  # noqa: BLE001
            return f"No recovery copy could be written, and it is tried again: {type(error).__name__}: {error}"
        with contextlib.suppress(OSError):
            forget_old(self._data_folder)
        return None

    def _take_lock(self) -> None:
        """Hold the session's lock, anew where its folder has vanished meanwhile."""
        place = self.folder / LOCK
        if self._lock is not None and place.exists():
            return
        if self._lock is not None:
            self._lock.release()
        self._lock = take_lock(place)

    def _digests(self, encoded: Encoded) -> dict[str, str]:
        digests = {}
        for name, content in encoded.blobs.items():
            # The picture is large and stays the same object from edit to edit.
            if self._picture is not None and self._picture[0] is content:
                digests[name] = self._picture[1]
                continue
            digests[name] = hashlib.sha256(content).hexdigest()
            if name == "picture":
                self._picture = (content, digests[name])
        return digests


def _name(project: Project, path: Path | None) -> str:
    if path is not None:
        return path.stem
    return project.name or "untitled"

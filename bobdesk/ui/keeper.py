"""Keeps the work: a recovery copy after every edit, the lock on the open file, saving by itself."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, Qt, QTimer, Signal, Slot

from bobdesk.files.instance_lock import FileLock, take_project_lock
from bobdesk.files.recovery import Recovery
from bobdesk.files.recovery_store import Recoverable, forget, recoverable
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk


class Keeper(QObject):
    """Follows the document.

    Parameters
    ----------
    data_folder
        The user's data folder.
    save
        Saves the document; called by the timer of the preference "save by itself".
    """

    _disk_failed = Signal(str)

    def __init__(self, desk: Desk, data_folder: Path, save: Callable[[], None], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._data_folder = data_folder
        self._save = save
        self._lock: FileLock | None = None
        # `Recovery` speaks from its own thread.
        self._disk_failed.connect(self._on_disk_failed, Qt.ConnectionType.QueuedConnection)
        self._recovery = Recovery(data_folder, say=self._disk_failed.emit)
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._on_timer)
        desk.session.changed.connect(self._on_changed)
        desk.session.state_changed.connect(self._on_state)
        desk.settings.changed.connect(self._on_setting)
        self._on_setting("autosave_minutes")

    def recoverable(self) -> tuple[Recoverable, ...]:
        """Return what earlier windows left behind."""
        return recoverable(self._data_folder)

    def forget(self, item: Recoverable) -> None:
        """Delete a recovery copy."""
        forget(item)

    def take(self, path: Path) -> bool:
        """Lock the file of the document that is about to be opened or saved; return whether it is ours."""
        self.let_go()
        try:
            self._lock = take_project_lock(self._data_folder, path)
        except OSError:
            return True  # no place for a lock: better without one than not at all
        return self._lock is not None

    def let_go(self) -> None:
        """Give the lock back."""
        if self._lock is not None:
            self._lock.release()
            self._lock = None

    def keep_now(self) -> bool:
        """Have the document as it is written to its recovery copy; return whether it is there after two seconds."""
        self._keep(self._desk.session.project)
        return self._recovery.wait(2.0)

    def close(self, *, forget_copy: bool) -> None:
        """End: `forget_copy` when the document is saved, or not wanted."""
        self._timer.stop()
        self.let_go()
        self._recovery.close(forget=forget_copy)

    def _keep(self, project: Project) -> None:
        session = self._desk.session
        self._recovery.keep(project, path=session.path, last_edit=session.undo_label or "")

    def _on_changed(self, _before: Project, after: Project) -> None:
        if self._desk.session.is_open and not self._desk.session.is_saved:
            self._keep(after)

    def _on_state(self) -> None:
        if self._desk.session.is_saved:
            self._recovery.saved()

    def _on_timer(self) -> None:
        session = self._desk.session
        if session.path is not None and not session.is_saved:
            self._save()

    def _on_setting(self, name: str) -> None:
        if name == "autosave_minutes":
            minutes = self._desk.settings.autosave_minutes
            self._timer.stop()
            if minutes > 0:
                self._timer.start(60_000 * minutes)

    @Slot(str)
    def _on_disk_failed(self, sentence: str) -> None:
        self._desk.notices.error(sentence)

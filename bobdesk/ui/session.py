"""The open document and the only way to change it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from bobdesk.errors import InputError, TargetError
from bobdesk.project.history import History
from bobdesk.project.project import Project

Edit = Callable[[Project], Project]


class Session(QObject):
    """One project, its history and its file.

    Signals
    -------
    changed
        The project before and after; a widget redraws only what is another object than before.
    document_changed
        Another document was opened: zoom and selection start anew.
    state_changed
        Undo, redo, saved mark or path may be others than before.
    refused
        An edit could not be done: the sentence.
    """

    changed = Signal(object, object)
    document_changed = Signal()
    state_changed = Signal()
    refused = Signal(str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._history: History[Project] = History(Project())
        self._path: Path | None = None
        self._is_open = False
        self._recovered = False

    @property
    def project(self) -> Project:
        """The project as it is now."""
        return self._history.value

    @property
    def document(self) -> object:
        """Stands for the open document: another object once another one was opened in its place."""
        return self._history

    @property
    def path(self) -> Path | None:
        """The project's file, or None before the first save."""
        return self._path

    @property
    def is_open(self) -> bool:
        """Whether there is a document; if not, the start page is shown."""
        return self._is_open

    @property
    def is_saved(self) -> bool:
        """Whether there is nothing that a save would add."""
        return not self._is_open or (self._history.is_saved and not self._recovered)

    @property
    def undo_label(self) -> str | None:
        """What Undo would take back."""
        labels = self._history.undo_labels
        return labels[0] if labels else None

    @property
    def redo_label(self) -> str | None:
        """What Redo would do again."""
        labels = self._history.redo_labels
        return labels[0] if labels else None

    def apply(self, label: str, edit: Edit, *, key: str | None = None) -> bool:
        """Do an edit as one step of undo; return whether it could be done.

        Parameters
        ----------
        label
            What is done, for menu and recovery: "Move vertex".
        edit
            A function from a project to a new one; what it refuses with InputError is told, and changes nothing.
        key
            Edits with the same key in a row (nudging, a spin box) are one step.
        """
        before = self.project
        try:
            after = edit(before)
        except (InputError, TargetError) as error:
            self.refused.emit(str(error))
            return False
        if after is before:
            return True
        self._is_open = True
        self._history.push(label, after, key=key)
        self._tell(before)
        return True

    def undo(self) -> None:
        """Take the last step back."""
        before = self.project
        self._history.undo()
        self._tell(before)

    def redo(self) -> None:
        """Do the step again that was taken back last."""
        before = self.project
        self._history.redo()
        self._tell(before)

    def open(self, project: Project, path: Path | None, *, recovered: bool = False) -> None:
        """Put another document in the place of this one.

        Parameters
        ----------
        recovered
            The project holds more than its file does, or has none: it is not saved.
        """
        before = self.project
        self._history = History(project)
        self._path, self._is_open, self._recovered = path, True, recovered
        self.document_changed.emit()
        self._tell(before)

    def close(self) -> None:
        """Have no document: the start page."""
        before = self.project
        self._history = History(Project())
        self._path, self._is_open, self._recovered = None, False, False
        self.document_changed.emit()
        self._tell(before)

    def saved(self, project: Project, path: Path) -> None:
        """Remember that `project` is in the file `path`; later edits may have been made meanwhile."""
        self._path = path
        self._recovered = False
        if project is self.project:
            self._history.mark_saved()
        self.state_changed.emit()

    def _tell(self, before: Project) -> None:
        if self.project is not before:
            self.changed.emit(before, self.project)
        self.state_changed.emit()

"""Undo, redo and the clipboard."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QLineEdit, QPlainTextEdit, QTextEdit

from bobdesk.ui.actions.action import Action
from bobdesk.ui.plans import Plans
from bobdesk.ui.session import Session


class EditActions(QObject):
    """Undo and redo act on the text field that is being typed in first, then on the tool in mid-work.

    Parameters
    ----------
    take_back
        Takes the last click of the tool back; returns whether there was one.
    in_work
        Whether the tool in hand is one that clicks can be taken back of.
    """

    def __init__(
        self,
        session: Session,
        plans: Plans,
        take_back: Callable[[], bool],
        in_work: Callable[[], bool],
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._in_work = in_work
        self._session = session
        self._plans = plans
        self._take_back = take_back

    def table(self) -> tuple[Action, ...]:
        """Return the rows."""
        return (
            Action(
                "undo",
                self.tr("&Undo"),
                self.undo,
                ("Ctrl+Z",),
                "undo",
                self.tr("Take the last step back"),
                "Edit",
                "undo",
                enabled=lambda: self._session.undo_label is not None or self._in_work(),
                context=True,
            ),
            Action(
                "redo",
                self.tr("&Redo"),
                self.redo,
                ("Ctrl+Y", "Ctrl+Shift+Z"),
                "redo",
                self.tr("Do again what was taken back"),
                "Edit",
                "undo",
                enabled=lambda: self._session.redo_label is not None,
                context=True,
            ),
            Action(
                "paste",
                self.tr("&Paste"),
                self.paste,
                ("Ctrl+V",),
                "paste",
                self.tr("Take a picture of the plan, or a file, from the clipboard"),
                "Edit",
                "clipboard",
            ),
        )

    def undo(self) -> None:
        """Take back what is being typed, or a click in mid-work, else the last step."""
        if not (_undo_typing() or self._take_back()):
            self._session.undo()

    def redo(self) -> None:
        """Do the last step again."""
        self._session.redo()

    def paste(self) -> None:
        """Paste text where one is typing, else a plan."""
        typed = _text_field()
        if typed is not None:
            typed.paste()
            return
        self._plans.paste(QGuiApplication.clipboard().mimeData())


def _text_field() -> QLineEdit | QPlainTextEdit | QTextEdit | None:
    focus = QApplication.focusWidget()
    if isinstance(focus, (QLineEdit, QPlainTextEdit, QTextEdit)) and not focus.isReadOnly():
        return focus
    return None


def _undo_typing() -> bool:
    typed = _text_field()
    if typed is None:
        return False
    can = typed.isUndoAvailable() if isinstance(typed, QLineEdit) else typed.document().isUndoAvailable()
    if can:
        typed.undo()
    return can

"""Undo, redo and the clipboard."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject
from PySide6.QtGui import QGuiApplication

from bobdesk.ui.actions.action import Action
from bobdesk.ui.plans import Plans
from bobdesk.ui.session import Session
from bobdesk.ui.typing_undo import TypingUndo, text_field


class EditActions(QObject):
    """Undo and redo act on text that is being typed first, then on the tool in mid-work.

    Parameters
    ----------
    typing
        What is being typed.
    take_back
        Takes the last click of the tool back; returns whether there was one.
    in_work
        Whether the tool in hand is one that clicks can be taken back of.
    """

    def __init__(
        self,
        session: Session,
        plans: Plans,
        typing: TypingUndo,
        take_back: Callable[[], bool],
        in_work: Callable[[], bool],
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._in_work = in_work
        self._session = session
        self._plans = plans
        self._typing = typing
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
                enabled=lambda: self._session.undo_label is not None or self._in_work() or self._typing.is_typing,
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
                enabled=lambda: self._session.redo_label is not None or self._typing.is_typing,
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
        if not (self._typing.undo() or self._take_back()):
            self._session.undo()

    def redo(self) -> None:
        """Type again what was taken back, else do the last step again."""
        if not self._typing.redo():
            self._session.redo()

    def paste(self) -> None:
        """Paste text where one is typing, else a plan."""
        typed = text_field()
        if typed is not None:
            typed.paste()
            return
        self._plans.paste(QGuiApplication.clipboard().mimeData())

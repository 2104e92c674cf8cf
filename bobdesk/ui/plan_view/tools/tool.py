"""What every tool is: the plan view hands it mouse and keys, and it previews, then commits one edit."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent, QPainter

from bobdesk.ui.desk import Desk


@dataclass(frozen=True)
class Pointer:
    """Where the mouse is.

    Attributes
    ----------
    plan
        Picture pixels, or metres with y up for a plan from coordinates.
    screen
        Pixels of the viewport.
    px_per_screen
        Plan units per screen pixel, for tolerances that are the same at every zoom.
    button
        That was pressed or released; NoButton while moving.
    modifiers
        Shift, Ctrl, Alt.
    """

    plan: tuple[float, float]
    screen: QPointF
    px_per_screen: float
    button: Qt.MouseButton
    modifiers: Qt.KeyboardModifier


class Tool(QObject):
    """A tool does nothing by default; each overrides what it needs.

    A drag is previewed by `paint` and committed once, on release, with `desk.session.apply`.

    Signals
    -------
    repaint
        What `paint` draws has changed.
    said
        What the tool does now, one line for the status bar.
    """

    repaint = Signal()
    said = Signal(str)
    name = ""
    cursor = Qt.CursorShape.CrossCursor

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.desk = desk

    def start(self) -> None:
        """Be taken in hand: say what to do."""

    def stop(self) -> None:
        """Be put down: end what is under way without losing what was placed."""

    def press(self, pointer: Pointer) -> None:
        """Take a mouse button going down."""

    def move(self, pointer: Pointer) -> None:
        """Take a move of the mouse, with or without a button."""

    def release(self, pointer: Pointer) -> None:
        """Take a mouse button going up."""

    def double_click(self, pointer: Pointer) -> None:
        """Take a double click; its first press came by `press`."""

    def key(self, event: QKeyEvent) -> bool:
        """Take a key; return whether it was used."""
        return False

    def cancel(self) -> bool:
        """Esc: drop what is under way, never what was placed; return whether there was something."""
        return False

    def take_back(self) -> bool:
        """Undo in mid-work: take the last click back; return whether there was one."""
        return False

    def paint(self, painter: QPainter, px_per_screen: float) -> None:
        """Draw the preview, in scene coordinates (picture pixels, y down; metres times -1 in y for coordinates)."""

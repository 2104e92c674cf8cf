"""What lies over the curves of a strip and takes the mouse before the strip does, such as boundaries."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QPainter

from bobdesk.ui.strips.strip_painting import Geometry


@dataclass(frozen=True)
class StripPointer:
    """Where the mouse is on a strip.

    Attributes
    ----------
    at
        Pixels of the strip.
    on
        What the strip shows now.
    modifiers
        Shift, Ctrl, Alt.
    """

    at: QPointF
    on: Geometry
    modifiers: Qt.KeyboardModifier

    @property
    def station(self) -> float:
        """Station under the mouse, m."""
        return self.on.station(self.at.x())

    def holds(self, modifier: Qt.KeyboardModifier) -> bool:
        """Return whether a modifier key is held."""
        return bool(self.modifiers & modifier)


class Overlay:
    """An overlay does nothing by default; each overrides what it needs."""

    def paint_below(self, painter: QPainter, on: Geometry) -> None:
        """Draw behind the curves."""

    def paint_above(self, painter: QPainter, on: Geometry) -> None:
        """Draw over the curves."""

    def cursor_at(self, pointer: StripPointer) -> Qt.CursorShape | None:
        """Return the shape of the mouse where the overlay would take a press, else None."""
        return None

    def press(self, pointer: StripPointer) -> bool:
        """Take the left button going down; return whether it is taken, so that `move` and `release` follow."""
        return False

    def move(self, pointer: StripPointer) -> None:
        """Take a move with the button held."""

    def release(self, pointer: StripPointer) -> None:
        """Take the button going up."""

    def cancel(self) -> bool:
        """Esc: drop what is under way; return whether there was something."""
        return False

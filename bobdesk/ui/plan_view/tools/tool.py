"""What every tool is: the plan view hands it mouse and keys, and it previews, then commits one edit."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent, QPainter
from PySide6.QtWidgets import QWidget

from bobdesk.arrays import FloatArray
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.space import Frame

# How far from a thing a click may lie, screen pixels.
HIT = 10.0


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

    @property
    def reach(self) -> float:
        """How far a click may lie off, plan units."""
        return HIT * self.px_per_screen

    def holds(self, modifier: Qt.KeyboardModifier) -> bool:
        """Return whether a modifier key is held."""
        return bool(self.modifiers & modifier)


class Tool(QObject):
    """A tool does nothing by default; each overrides what it needs.

    A drag is previewed by `paint` and committed once, on release, with `desk.session.apply`.

    Signals
    -------
    repaint
        What `paint` draws has changed.
    said
        What the tool does now, one line for the status bar.
    done
        The tool has done its work: the view takes the select tool in hand.
    show_place
        A place of the plan that should be brought into view: x and y.
    """

    repaint = Signal()
    said = Signal(str)
    done = Signal()
    show_place = Signal(float, float)
    name = ""
    cursor = Qt.CursorShape.CrossCursor
    places_points = True

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.desk = desk
        self.sentence = ""
        # What small forms of the tool lie on; set by the view.
        self.host: QWidget | None = None

    def say(self, sentence: str) -> None:
        """Tell what the tool does now."""
        if sentence != self.sentence:
            self.sentence = sentence
            self.said.emit(sentence)

    def start(self) -> None:
        """Be taken in hand: say what to do."""

    def stop(self) -> None:
        """Be put down: end what is under way without losing what was placed."""

    def reset(self) -> None:
        """Forget everything: another document was opened."""

    def refresh(self) -> None:
        """Look at a document that has changed."""

    @property
    def is_dragging(self) -> bool:
        """Whether something is being moved, so that a loupe helps."""
        return False

    def preview_points(self) -> FloatArray | None:
        """Return the vertices (n, 2) that the trace would have if the drag ended now."""
        return None

    def press(self, pointer: Pointer) -> None:
        """Take a mouse button going down."""

    def move(self, pointer: Pointer) -> None:
        """Take a move of the mouse, with or without a button."""

    def leave(self) -> None:
        """Take that the mouse has left the view."""

    def release(self, pointer: Pointer) -> None:
        """Take a mouse button going up."""

    def double_click(self, pointer: Pointer) -> None:
        """Take a double click; its first press came by `press`."""

    def takes_key(self, event: QKeyEvent) -> bool:
        """Return whether a key means something to the tool now, so that no action gets it."""
        return False

    def key(self, event: QKeyEvent) -> bool:
        """Take a key; return whether it was used."""
        return False

    def delete(self) -> bool:
        """Take away what is selected and belongs to this tool; return whether there was something."""
        return False

    def cancel(self) -> bool:
        """Esc: drop what is under way, never what was placed; return whether there was something."""
        return False

    def let_go(self) -> None:
        """Drop a drag whose ground has changed: another step, the keyboard elsewhere; what is selected stays."""
        if self.is_dragging:
            self.cancel()

    def take_back(self) -> bool:
        """Undo in mid-work: take the last click back; return whether there was one."""
        return False

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """Draw the preview, in screen pixels."""

"""A shown plan view with a drawn circle as its picture, and hands that use the mouse as a person does."""

from __future__ import annotations

import io
from collections.abc import Iterable

import numpy as np
from PIL import Image
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from bobdesk.project.project import Picture
from bobdesk.ui.plan_view.view import PlanView
from tests.plan.drawn_lines import exact_line

LEFT, RIGHT, MIDDLE = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton, Qt.MouseButton.MiddleButton
NONE = Qt.KeyboardModifier.NoModifier
SHIFT, CONTROL, ALT = (
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.AltModifier,
)
RADIUS = 120.0


def on_circle(turn: float, radius: float = RADIUS) -> tuple[float, float]:
    """Return a place of the drawn circle, at a share of a whole turn."""
    return 200 + radius * float(np.cos(2 * np.pi * turn)), 200 + radius * float(np.sin(2 * np.pi * turn))


def drawn_circle() -> np.ndarray:
    """Return the picture's pixels."""
    angle = np.linspace(0, 2 * np.pi * 0.93, 2000)
    points = np.column_stack([200 + RADIUS * np.cos(angle), 200 + RADIUS * np.sin(angle)])
    return exact_line(points, width=2.0, size=(400, 400))


def picture() -> Picture:
    """Return the circle as a file that was opened."""
    out = io.BytesIO()
    Image.fromarray(drawn_circle()).save(out, "PNG")
    return Picture(out.getvalue(), "circle.png", size_px=(400, 400))


class Hand:
    """Uses the mouse over a view, at places of the plan."""

    def __init__(self, view: PlanView) -> None:
        self.view = view

    def at(self, place: tuple[float, float]) -> QPoint:
        """Return the pixel of the viewport nearest to a place."""
        return self.view.frame_now().point(place).toPoint()

    def move(self, place: tuple[float, float], *, buttons: Qt.MouseButton = Qt.MouseButton.NoButton) -> None:
        """Move the mouse."""
        self._send(QEvent.Type.MouseMove, place, Qt.MouseButton.NoButton, buttons, NONE)

    def click(
        self, *places: tuple[float, float], button: Qt.MouseButton = LEFT, held: Qt.KeyboardModifier = NONE
    ) -> None:
        """Click at one place after the other."""
        for place in places:
            self.move(place)
            QTest.mouseClick(self.view.viewport(), button, held, self.at(place))

    def double_click(self, place: tuple[float, float]) -> None:
        """Click twice, as Qt reports it: press, release, double click, release."""
        self.click(place)
        QTest.mouseDClick(self.view.viewport(), LEFT, NONE, self.at(place))

    def drag(
        self,
        start: tuple[float, float],
        way: Iterable[tuple[float, float]],
        *,
        button: Qt.MouseButton = LEFT,
        held: Qt.KeyboardModifier = NONE,
        release: bool = True,
    ) -> None:
        """Press, move along a way, and release at its end; screen places are fixed before the first move."""
        spots = [self.view.frame_now().point(place) for place in (start, *way)]
        self.move(start)
        self._at(QEvent.Type.MouseButtonPress, spots[0], button, button, held)
        for spot in spots[1:]:
            self._at(QEvent.Type.MouseMove, spot, Qt.MouseButton.NoButton, button, held)
        if release:
            self._at(QEvent.Type.MouseButtonRelease, spots[-1], button, Qt.MouseButton.NoButton, held)

    def key(self, key: Qt.Key, held: Qt.KeyboardModifier = NONE) -> None:
        """Press and release a key."""
        QTest.keyClick(self.view, key, held)

    def wheel(self, place: tuple[float, float], notches: int = 1) -> None:
        """Turn the wheel."""
        at = self.view.frame_now().point(place)
        event = QWheelEvent(
            at,
            self.view.viewport().mapToGlobal(at),
            QPoint(),
            QPoint(0, 120 * notches),
            Qt.MouseButton.NoButton,
            NONE,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        QApplication.sendEvent(self.view.viewport(), event)

    def _send(
        self,
        kind: QEvent.Type,
        place: tuple[float, float],
        button: Qt.MouseButton,
        buttons: Qt.MouseButton,
        held: Qt.KeyboardModifier,
    ) -> None:
        self._at(kind, QPointF(self.at(place)), button, buttons, held)

    def _at(
        self, kind: QEvent.Type, at: QPointF, button: Qt.MouseButton, buttons: Qt.MouseButton, held: Qt.KeyboardModifier
    ) -> None:
        port = self.view.viewport()
        QApplication.sendEvent(port, QMouseEvent(kind, at, port.mapToGlobal(at), button, buttons, held))

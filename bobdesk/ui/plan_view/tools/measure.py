"""Measure: click from place to place; nothing is stored unless the user says so."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Literal

from PySide6.QtCore import QObject, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QKeyEvent, QPainter

from bobdesk.ui.desk import Desk
from bobdesk.ui.notices import Remedy
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import pen
from bobdesk.ui.plan_view.tools.give_distance import give_distance
from bobdesk.ui.plan_view.tools.tool import Pointer, Tool
from bobdesk.ui.theme import colours

Place = tuple[float, float]


class MeasureTool(Tool):
    """Each leg's length, the sum, and the angle at the last corner."""

    name = "measure"

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(desk, parent)
        self._places: list[Place] = []
        self._cursor: Pointer | None = None
        self._ended = False
        self._last_screen = QPointF()

    def start(self) -> None:
        """Say what to do."""
        self._say()

    def stop(self) -> None:
        """Forget what was measured."""
        self.reset()

    def refresh(self) -> None:
        """Say the lengths by another scale."""
        self._say()
        self.repaint.emit()

    def reset(self) -> None:
        """Begin anew."""
        self._places.clear()
        self._cursor, self._ended = None, False
        self.repaint.emit()

    def press(self, pointer: Pointer) -> None:
        """Take the next place; the first one after an end begins anew."""
        if pointer.button != Qt.MouseButton.LeftButton:
            return
        if self._ended:
            self.reset()
        if not self._places or math.dist(self._places[-1], pointer.plan) > pointer.px_per_screen:
            self._places.append(pointer.plan)
            self._last_screen = pointer.screen
        self._cursor = pointer
        self._say()
        self.repaint.emit()

    def move(self, pointer: Pointer) -> None:
        """Measure to the mouse."""
        self._cursor = pointer
        self._say()
        self.repaint.emit()

    def leave(self) -> None:
        """Measure to the last click."""
        self._cursor = None
        self.repaint.emit()

    def double_click(self, pointer: Pointer) -> None:
        """End here."""
        self._end()

    def takes_key(self, event: QKeyEvent) -> bool:
        """Return whether the key ends the measuring or takes a click back."""
        return bool(self._places) and event.key() in (Qt.Key.Key_Backspace, Qt.Key.Key_Return, Qt.Key.Key_Enter)

    def key(self, event: QKeyEvent) -> bool:
        """Take the keys that end or take back."""
        if event.key() == Qt.Key.Key_Backspace:
            return self.take_back()
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            return self._end()
        return False

    def cancel(self) -> bool:
        """Drop what was measured: nothing of it is stored."""
        if not self._places:
            return False
        self.reset()
        self._say()
        return True

    def take_back(self) -> bool:
        """Take the last click back."""
        if not self._places:
            return False
        self._places.pop()
        self._ended = False
        self._say()
        self.repaint.emit()
        return True

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """Draw legs, corners and lengths."""
        of = colours()
        places = self._measured()
        points = [frame.point(place) for place in places]
        for shade, width in ((of.base, 4.0), (of.measure, 1.8)):
            painter.setPen(pen(shade, width))
            for start, end in pairwise(points):
                painter.drawLine(start, end)
        painter.setBrush(QColor(of.base))
        painter.setPen(pen(of.measure, 1.6))
        for point in points:
            painter.drawEllipse(point, 3.0, 3.0)
        for (one, other), (start, end) in zip(pairwise(places), pairwise(points), strict=True):
            if (end - start).manhattanLength() > 50:
                self._write(painter, (start + end) / 2, self._length(math.dist(one, other)))

    def _write(self, painter: QPainter, at: QPointF, text: str) -> None:
        of = colours()
        metrics = painter.fontMetrics()
        box = QRectF(0, 0, metrics.horizontalAdvance(text) + 10, metrics.height() + 2)
        box.moveCenter(at)
        painter.setPen(pen(of.measure, 1.0))
        painter.setBrush(QColor(of.base))
        painter.drawRoundedRect(box, 3, 3)
        painter.setPen(QColor(of.text))
        painter.drawText(box, int(Qt.AlignmentFlag.AlignCenter), text)

    def _measured(self) -> list[Place]:
        follows = self._cursor is not None and self._places and not self._ended
        return [*self._places, self._cursor.plan] if follows and self._cursor is not None else list(self._places)

    def _length(self, units: float) -> str:
        """Return a length in metres, in pixels, or both."""
        quantities = self.desk.quantities
        if self.desk.session.project.source is not None:
            return quantities.length(units, 2)
        pixels = self.tr("{count} px").format(count=quantities.number(units, 1))
        scale = self._scale()
        return pixels if scale is None else f"{quantities.length(units * scale, 2)} ({pixels})"

    def _scale(self) -> float | None:
        from bobdesk.project import derive

        found = derive.calibration(self.desk.session.project).value
        return None if found is None or not found.scale_known else found.metres_per_pixel

    def _end(self) -> bool:
        if len(self._places) < 2 or self._ended:
            return False
        self._ended = True
        self._say()
        self.repaint.emit()
        if self.desk.session.project.source is None:
            start, end = self._places[-2], self._places[-1]
            self.desk.notices.note(
                self.tr("{length} in the plan").format(length=self._length(math.dist(start, end))),
                Remedy(self.tr("Add as known distance"), lambda: self._store(start, end, "known")),
                Remedy(self.tr("Add as check distance"), lambda: self._store(start, end, "check")),
            )
        return True

    def _store(self, start: Place, end: Place, what: Literal["known", "check"]) -> None:
        if self.host is not None:
            give_distance(self.desk, self.host, self._last_screen, start, end, what)

    def _say(self) -> None:
        places = self._measured()
        if len(places) < 2:
            self.say(self.tr("Click from place to place to measure; nothing is stored."))
            return
        legs = [math.dist(one, other) for one, other in pairwise(places)]
        text = self._length(legs[-1])
        if len(legs) > 1:
            text = self.tr("{leg}, together {sum}").format(leg=text, sum=self._length(sum(legs)))
            text = self.tr("{text}, angle {angle}").format(text=text, angle=self._angle(places))
        if not self._ended:
            text = self.tr("{text}. Enter or double-click ends.").format(text=text)
        self.say(text)

    def _angle(self, places: list[Place]) -> str:
        """Return the angle between the last two legs, 180° for straight on."""
        (ax, ay), (bx, by), (cx, cy) = places[-3:]
        one, other = math.atan2(ay - by, ax - bx), math.atan2(cy - by, cx - bx)
        turn = abs(one - other) % (2 * math.pi)
        return self.desk.quantities.angle(min(turn, 2 * math.pi - turn))

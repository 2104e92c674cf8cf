"""Segments on a strip: curves tinted, boundaries as handles that can be dragged."""

from __future__ import annotations

import math

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen
from PySide6.QtWidgets import QApplication

from bobdesk.alignment.segments import Segment
from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.alignment_now import AlignmentNow, alignment_now
from bobdesk.ui.segments.boundary_drag import BoundaryDrag
from bobdesk.ui.segments.drag_words import DragWords
from bobdesk.ui.strips.contents import shade
from bobdesk.ui.strips.overlay import Overlay, StripPointer
from bobdesk.ui.strips.strip_painting import Geometry

_NEAR = 6.0
_HANDLE = 7.0
_SNAP = 8.0
_A_DRAG = 3.0
_CLOSEST = 9.0


class SegmentOverlay(Overlay):
    """Shades curves, marks selected segments, and moves boundaries.

    Parameters
    ----------
    has_handles
        Whether boundaries have handles at the top here; the lines can be dragged everywhere.
    """

    def __init__(self, desk: Desk, drag: BoundaryDrag, *, has_handles: bool) -> None:
        self._desk = desk
        self._now: AlignmentNow = alignment_now(desk)
        self._drag = drag
        self._words = DragWords(desk, drag)
        self._has_handles = has_handles
        self._pressed: QPointF | None = None
        self._offset = 0.0
        self._is_moving = False

    def paint_below(self, painter: QPainter, on: Geometry) -> None:
        """Tint curves and selected segments."""
        segments = self._now.segments
        seen = [one for one in segments if one.end >= on.low and one.start <= on.high]
        chosen = [segments[index] for index in self._desk.selection.segments if index < len(segments)]
        painter.setPen(Qt.PenStyle.NoPen)
        for boxes, colour in (
            (chosen, shade("selected_row")),
            ([one for one in seen if one.kind == "curve"], shade("curve", 30)),
        ):
            painter.setBrush(colour)
            painter.drawRects([self._box(one, on) for one in boxes])
        painter.setBrush(Qt.BrushStyle.NoBrush)

    def paint_above(self, painter: QPainter, on: Geometry) -> None:
        """Draw boundaries; where they are too close for handles on the screen, only lines."""
        segments = self._now.segments
        selected = self._desk.selection.boundary
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        shown = [index for index, segment in enumerate(segments[:-1]) if on.low <= segment.end <= on.high]
        places = {index: round(on.x(segments[index].end)) + 0.5 for index in shown}
        top, bottom = on.area.top(), on.area.bottom()
        painter.setPen(QPen(shade("muted", 120), 1))
        painter.drawLines([QLineF(x, top, x, bottom) for index, x in places.items() if index != selected])
        if selected in places:
            painter.setPen(QPen(shade("accent"), 2))
            painter.drawLine(QLineF(places[selected], top, places[selected], bottom))
        if self._has_handles:
            self._draw_handles(painter, places, top)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self._has_handles:
            self._draw_locks(painter, on)
            self._draw_figures(painter, on)

    def cursor_at(self, pointer: StripPointer) -> Qt.CursorShape | None:
        """Show that a boundary can be dragged."""
        return None if self._boundary_at(pointer) is None else Qt.CursorShape.SizeHorCursor

    def press(self, pointer: StripPointer) -> bool:
        """Take hold of a boundary."""
        if pointer.holds(Qt.KeyboardModifier.ShiftModifier) or pointer.holds(Qt.KeyboardModifier.ControlModifier):
            return False
        boundary = self._boundary_at(pointer)
        if boundary is None:
            return False
        self._pressed, self._is_moving = pointer.at, False
        self._offset = self._now.segments[boundary].end - pointer.station
        self._drag.hold(boundary)
        return True

    def move(self, pointer: StripPointer) -> None:
        """Preview the boundary at the mouse; Alt moves it freely."""
        if self._pressed is None or self._drag.boundary is None:
            return
        self._is_moving = self._is_moving or abs(pointer.at.x() - self._pressed.x()) >= _A_DRAG
        if self._is_moving:
            free = pointer.holds(Qt.KeyboardModifier.AltModifier)
            snap = 0.0 if free else _SNAP * pointer.on.metres_per_pixel
            self._drag.drag(pointer.station + self._offset, snap=snap)

    def release(self, pointer: StripPointer) -> None:
        """Keep it there; a click alone only selects the boundary."""
        self._pressed = None
        if self._is_moving:
            self._is_moving = False
            self._drag.drop()
        else:
            self._drag.cancel()

    def cancel(self) -> bool:
        """Put the boundary back."""
        self._pressed, self._is_moving = None, False
        return self._drag.cancel()

    def _box(self, segment: Segment, on: Geometry) -> QRectF:
        left = on.x(segment.start)
        return QRectF(left, on.area.top(), on.x(segment.end) - left, on.area.height())

    def _boundary_at(self, pointer: StripPointer) -> int | None:
        if not pointer.on.area.adjusted(-_NEAR, -_NEAR, _NEAR, 0).contains(pointer.at):
            return None
        return self._drag.boundary_at(pointer.station, _NEAR * pointer.on.metres_per_pixel)

    def _draw_handles(self, painter: QPainter, places: dict[int, float], top: float) -> None:
        """Draw full squares, and hollow ones for boundaries that a lock holds."""
        segments, selected = self._now.segments, self._desk.selection.boundary
        last = -math.inf
        squares: dict[bool, list[QRectF]] = {True: [], False: []}
        for index, x in places.items():
            if x - last >= _CLOSEST and index != selected:
                last = x
                is_free = not (segments[index].locked or segments[index + 1].locked)
                squares[is_free].append(QRectF(round(x - _HANDLE / 2), round(top), _HANDLE, _HANDLE))
        for is_free, colour in ((True, "text"), (False, "base")):
            painter.setPen(QPen(shade("text"), 1))
            painter.setBrush(shade(colour))
            painter.drawRects(squares[is_free])
        if selected in places:
            size = _HANDLE + 2
            painter.setPen(QPen(shade("accent"), 1))
            painter.setBrush(shade("accent"))
            painter.drawRect(QRectF(round(places[selected] - size / 2), round(top), size, size))
        painter.setBrush(Qt.BrushStyle.NoBrush)

    def _draw_locks(self, painter: QPainter, on: Geometry) -> None:
        """Draw a small closed lock in the middle of locked segments that have room for one."""
        for segment in self._now.segments:
            middle = on.x(0.5 * (segment.start + segment.end))
            if (
                not segment.locked
                or on.x(segment.end) - on.x(segment.start) < 18
                or not on.area.left() < middle < on.area.right()
            ):
                continue
            top = on.area.top() + 3
            painter.setPen(QPen(shade("text"), 1.3))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawArc(QRectF(middle - 2.5, top, 5, 7), 0, 180 * 16)
            painter.setBrush(shade("text"))
            painter.drawRect(QRectF(middle - 4, top + 4, 8, 5.5))
            painter.setBrush(Qt.BrushStyle.NoBrush)

    def _draw_figures(self, painter: QPainter, on: Geometry) -> None:
        """Beside a boundary that is being dragged: station, and length, radius, turn and fit at both sides."""
        boundary = self._drag.boundary
        if boundary is None or not self._is_moving:
            return
        lines = self._words.lines(self._drag)
        font = QApplication.font()
        painter.setFont(font)
        metrics = QFontMetricsF(font)
        width = max(metrics.horizontalAdvance(line) for line in lines) + 16
        height = len(lines) * metrics.height() + 8
        x = on.x(self._now.segments[boundary].end)
        left = x + 10 if x + 10 + width < on.area.right() else x - 10 - width
        box = QRectF(left, on.area.top() + 4, width, height)
        painter.setPen(QPen(shade("border"), 1))
        painter.setBrush(shade("base", 240))
        painter.drawRoundedRect(box, 4, 4)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(shade("text"))
        painter.drawText(
            box.adjusted(8, 4, -8, -4), Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop, "\n".join(lines)
        )

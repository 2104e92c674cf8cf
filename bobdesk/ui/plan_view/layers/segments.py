"""Straights and curves along the centreline: straights thin, curves thick, with handles and the curves' numbers."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPixmap

from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.layer import Layer
from bobdesk.ui.plan_view.line_on_plan import LineOnPlan, ScreenLine, ScreenPart
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import pen
from bobdesk.ui.segments.alignment_now import AlignmentNow, alignment_now
from bobdesk.ui.theme import colours

_BADGE = 9.0
_BADGE_AWAY = 18.0
_HANDLE, _HELD = 7.0, 10.0
_CLOSEST = 6.0
_ROOM = 16.0
_FEW = 4
# On paper, in every theme.
_INK = "#22252b"


class SegmentsLayer(Layer):
    """Draws the segments as they are now, a drag in mid-work included; selected ones lie on a band."""

    name = "segments"
    usually_shown = False

    def __init__(self, desk: Desk, frame: Callable[[], Frame]) -> None:
        super().__init__(desk, frame)
        self._now: AlignmentNow | None = None
        self._held: QPixmap | None = None
        self._held_for: object = None
        for signal in (
            desk.selection.segments_changed,
            desk.selection.boundary_changed,
            desk.selection.station_changed,
        ):
            signal.connect(self.repaint)

    def concerns(self, before: Project, after: Project) -> bool:
        """Return whether this layer may have to be worked out for the first time."""
        return self._now is None

    def draw(self, painter: QPainter, frame: Frame) -> None:
        """Paint every segment, the boundaries, and the numbers of the curves."""
        if self._now is None:
            self._now = alignment_now(self.desk)
            self._line = LineOnPlan(self._now)
            self._now.changed.connect(self.repaint)
        line = self._line.on_screen(self.desk.session.project, frame)
        segments = self._now.segments
        if line is None or not segments:
            return
        changed = self._changed(segments)
        if changed:
            self._draw_held(painter, frame, line, segments, changed)
            self._draw(painter, frame, line, segments, sorted(changed))
        else:
            self._held = None
            self._draw(painter, frame, line, segments, range(len(segments)))
        self._draw_cursor(painter, frame, line)

    def _changed(self, segments: Segments) -> set[int]:
        """Return which segments a drag in mid-work changes; empty if there is none, or if they are many."""
        known = None if self._now is None or not self._now.is_preview else self._now.known
        if known is None or len(known.segments) != len(segments):
            return set()
        changed = {
            index for index, pair in enumerate(zip(segments, known.segments, strict=True)) if pair[0] is not pair[1]
        }
        return changed if len(changed) <= _FEW else set()

    def _draw_held(
        self, painter: QPainter, frame: Frame, line: ScreenLine, segments: Segments, changed: set[int]
    ) -> None:
        """Draw what a drag does not change as a picture that is made once."""
        ratio = painter.device().devicePixelRatioF()
        wanted = (frame, line, changed, self.desk.selection.segments, self.desk.selection.boundary, ratio)
        if self._held is None or self._held_for != wanted:
            self._held = QPixmap(round(ratio * frame.width), round(ratio * frame.height))
            self._held.setDevicePixelRatio(ratio)
            self._held.fill(Qt.GlobalColor.transparent)
            inside = QPainter(self._held)
            self._draw(inside, frame, line, segments, [one for one in range(len(segments)) if one not in changed])
            inside.end()
            self._held_for = wanted
        painter.drawPixmap(0, 0, self._held)

    def _draw(
        self, painter: QPainter, frame: Frame, line: ScreenLine, segments: Segments, indices: Sequence[int]
    ) -> None:
        """Paint some segments, the boundaries between and before them, and the numbers of the curves."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        view = QRectF(0, 0, frame.width, frame.height).adjusted(-_ROOM, -_ROOM, _ROOM, _ROOM)
        parts = {index: line.kept_part(segments[index].start, segments[index].end) for index in indices}
        # A straight along an axis has no area, which Qt calls no rectangle.
        seen = {index: part for index, part in parts.items() if part.bounds.adjusted(-1, -1, 1, 1).intersects(view)}
        self._draw_lines(painter, segments, seen)
        self._draw_handles(painter, frame, segments, parts)
        numbers = np.cumsum([segment.kind == "curve" for segment in segments]).tolist()
        for index, part in seen.items():
            if segments[index].kind == "curve":
                _draw_badge(painter, frame, part.points, segments[index].name or str(numbers[index]))

    def _draw_lines(self, painter: QPainter, segments: Segments, seen: dict[int, ScreenPart]) -> None:
        of = colours()
        painter.setPen(pen(of.trace_doubtful, 13.0, alpha=110))
        for index in self.desk.selection.segments:
            if index in seen:
                painter.drawPolyline(seen[index].polygon)
        for kind, stroke in (("straight", pen(of.straight, 2.0)), ("curve", pen(of.curve, 4.5))):
            painter.setPen(stroke)
            for index, part in seen.items():
                if segments[index].kind == kind:
                    painter.drawPolyline(part.polygon)

    def _draw_cursor(self, painter: QPainter, frame: Frame, line: ScreenLine) -> None:
        station = self.desk.selection.station
        if station is None:
            return
        x, y = line.at(np.array([station]))[0].tolist()
        if frame.sees(QPointF(x, y)):
            painter.setPen(pen(colours().paper, 4.0))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawEllipse(QPointF(x, y), 6.0, 6.0)
            painter.setPen(pen(colours().accent, 2.0))
            painter.drawEllipse(QPointF(x, y), 6.0, 6.0)

    def _draw_handles(self, painter: QPainter, frame: Frame, segments: Segments, parts: dict[int, ScreenPart]) -> None:
        of = colours()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        held = self.desk.selection.boundary
        squares: dict[str, list[QRectF]] = {of.vertex: [], of.border: [], of.accent: []}
        last_x, last_y = -math.inf, -math.inf
        for behind, part in parts.items():
            index = behind - 1
            if index < 0:
                continue
            x, y = part.points[0].tolist()
            if not frame.sees(QPointF(x, y)) or (index != held and math.hypot(x - last_x, y - last_y) < _CLOSEST):
                continue
            last_x, last_y = x, y
            locked = segments[index].locked or segments[index + 1].locked
            size = _HELD if index == held else _HANDLE
            square = QRectF(round(x - size / 2) + 0.5, round(y - size / 2) + 0.5, size, size)
            squares[of.accent if index == held else of.border if locked else of.vertex].append(square)
        for colour, drawn in squares.items():
            painter.setPen(pen(of.muted if colour == of.border else _INK, 1.2))
            painter.setBrush(QColor(colour))
            painter.drawRects(drawn)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)


def _draw_badge(painter: QPainter, frame: Frame, part: FloatArray, text: str) -> None:
    """Write the number of a curve on its outer side, where the curve is long enough on the screen."""
    if float(np.hypot(*np.ptp(part, axis=0))) < 2 * _BADGE:
        return
    middle = part[len(part) // 2]
    outwards = middle - 0.5 * (part[0] + part[-1])
    size = float(np.hypot(*outwards))
    if size < 0.3:
        way = part[-1] - part[0]
        outwards, size = np.array([-way[1], way[0]]), max(float(np.hypot(*way)), 1e-9)
    at = QPointF(*(middle + outwards / size * _BADGE_AWAY).tolist())
    if not frame.sees(at):
        return
    of = colours()
    width = max(2 * _BADGE, painter.fontMetrics().horizontalAdvance(text) + 8.0)
    box = QRectF(at.x() - width / 2, at.y() - _BADGE, width, 2 * _BADGE)
    painter.setPen(pen(of.border, 1.0))
    painter.setBrush(QColor(of.base))
    painter.drawRoundedRect(box, _BADGE, _BADGE)
    painter.setPen(QColor(of.text))
    painter.drawText(box, int(Qt.AlignmentFlag.AlignCenter), text)

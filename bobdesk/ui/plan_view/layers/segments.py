"""Straights and curves along the centreline: straights thin, curves thick, with handles and the curves' numbers."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.layer import Layer
from bobdesk.ui.plan_view.line_on_plan import LineOnPlan, ScreenLine
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import draw_line, pen
from bobdesk.ui.segments.alignment_now import AlignmentNow, alignment_now
from bobdesk.ui.theme import colours

_BADGE = 9.0
_BADGE_AWAY = 18.0
_HANDLE, _HELD = 7.0, 10.0
_CLOSEST = 6.0


class SegmentsLayer(Layer):
    """Draws the segments as they are now, a drag in mid-work included; selected ones lie on a band."""

    name = "segments"
    usually_shown = False

    def __init__(self, desk: Desk, frame: Callable[[], Frame]) -> None:
        super().__init__(desk, frame)
        self._now: AlignmentNow | None = None
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
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        parts = [line.part(segment.start, segment.end) for segment in segments]
        self._draw_segments(painter, frame, segments, parts)
        self._draw_cursor(painter, frame, line)
        self._draw_handles(painter, frame, segments, parts)
        number = 0
        for segment, part in zip(segments, parts, strict=True):
            if segment.kind == "curve":
                number += 1
                _draw_badge(painter, frame, part, segment.name or str(number))

    def _draw_segments(self, painter: QPainter, frame: Frame, segments: Segments, parts: list[FloatArray]) -> None:
        of = colours()
        painter.setPen(pen(of.trace_doubtful, 13.0, alpha=110))
        for index in self.desk.selection.segments:
            if index < len(parts):
                draw_line(painter, parts[index], frame)
        for segment, part in zip(segments, parts, strict=True):
            painter.setPen(pen(of.straight, 2.0) if segment.kind == "straight" else pen(of.curve, 4.5))
            draw_line(painter, part, frame)

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

    def _draw_handles(self, painter: QPainter, frame: Frame, segments: Segments, parts: list[FloatArray]) -> None:
        of = colours()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        last = np.array([-1e9, -1e9])
        for index, part in enumerate(parts[1:]):
            x, y = part[0].tolist()
            held = index == self.desk.selection.boundary
            if not frame.sees(QPointF(x, y)) or (not held and np.hypot(*(part[0] - last)) < _CLOSEST):
                continue
            last = part[0]
            size = _HELD if held else _HANDLE
            locked = segments[index].locked or segments[index + 1].locked
            painter.setPen(pen("#22252b" if not locked else of.muted, 1.2))
            painter.setBrush(QColor(of.accent if held else of.vertex if not locked else of.border))
            painter.drawRect(QRectF(round(x - size / 2) + 0.5, round(y - size / 2) + 0.5, size, size))
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

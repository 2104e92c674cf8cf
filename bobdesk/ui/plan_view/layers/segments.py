"""Straights and curves along the centreline: straights thin, curves thick, with numbers on the curves."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from bobdesk.arrays import FloatArray
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.derived_layer import DerivedLayer
from bobdesk.ui.plan_view.plan_lines import LineInPlan, segments_in_plan
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import draw_line, pen
from bobdesk.ui.theme import colours

_BADGE = 9.0
_BADGE_AWAY = 18.0
_BOUNDARY = 6.0


class SegmentsLayer(DerivedLayer):
    """Draws the segments in force; selected ones lie on a band."""

    name = "segments"
    usually_shown = False

    def __init__(self, desk: Desk, frame: Callable[[], Frame]) -> None:
        super().__init__(desk, frame)
        desk.selection.segments_changed.connect(self.repaint)

    def work(self, project: Project) -> LineInPlan:
        """Return the centreline with its segments."""
        return segments_in_plan(project)

    def inputs(self, project: Project) -> tuple[object, ...] | None:
        """Return what the segments follow from."""
        line = super().inputs(project)
        return None if line is None else (*line, project.segments, project.segmentation)

    def title(self) -> str:
        """Return what is worked out, for the user."""
        return self.tr("Finding straights and curves")

    def draw_line(self, painter: QPainter, frame: Frame, line: LineInPlan) -> None:
        """Paint every segment, the boundaries, and the numbers of the curves."""
        of = colours()
        screen = frame.to_screen(line.points)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        parts = [_part(screen, line.stations, segment.start, segment.end) for segment in line.segments]
        painter.setPen(pen(of.trace_doubtful, 13.0, alpha=110))
        for index in self.desk.selection.segments:
            if index < len(parts):
                draw_line(painter, parts[index], frame)
        for segment, part in zip(line.segments, parts, strict=True):
            painter.setPen(pen(of.straight, 2.0) if segment.kind == "straight" else pen(of.curve, 4.5))
            draw_line(painter, part, frame)
        painter.setPen(pen(of.finish if not of.is_dark else of.canvas, 1.0))
        painter.setBrush(QColor(of.vertex))
        for part in parts[1:]:
            painter.drawRect(QRectF(part[0, 0] - _BOUNDARY / 2, part[0, 1] - _BOUNDARY / 2, _BOUNDARY, _BOUNDARY))
        number = 0
        for segment, part in zip(line.segments, parts, strict=True):
            if segment.kind == "curve":
                number += 1
                _draw_badge(painter, frame, part, segment.name or str(number))


def _part(screen: FloatArray, stations: FloatArray, start: float, end: float) -> FloatArray:
    inside = (stations > start) & (stations < end)
    ends = np.column_stack([np.interp([start, end], stations, screen[:, axis]) for axis in (0, 1)])
    return np.concatenate([ends[:1], screen[inside], ends[1:]])


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

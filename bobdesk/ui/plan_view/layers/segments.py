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
from bobdesk.ui.plan_view.held_picture import HeldPicture, transparent
from bobdesk.ui.plan_view.layers.layer import Layer
from bobdesk.ui.plan_view.line_on_plan import LineOnPlan, ScreenLine, ScreenPart
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import draw_line, pen
from bobdesk.ui.segments.alignment_now import AlignmentNow, alignment_now
from bobdesk.ui.theme import colours

_BADGE = 9.0
_BADGE_AWAY = 18.0
_HANDLE, _HELD = 7.0, 10.0
_CLOSEST = 6.0
_ROOM = 16.0
# How far badge and handle of a segment reach beyond its line, and how much further for each letter of a name.
_AROUND, _A_LETTER = 32.0, 6.0
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
        self._all = HeldPicture()
        self._rest: QPixmap | None = None
        self._rest_for: object = None
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
        self._draw_bands(painter, frame, line, segments)
        changed = self._changed(segments)
        known = self._now.known.segments if changed and self._now.known is not None else segments
        if changed:
            self._draw_rest(painter, frame, line, known, changed)
            self._draw(painter, frame, line, segments, sorted(changed))
            # The lines just drawn lie over the handles at the far ends of what they meet.
            behind = [index for index in range(min(changed), max(changed) + 2) if index < len(segments)]
            parts = {index: line.kept_part(segments[index].start, segments[index].end) for index in behind}
            self._draw_handles(painter, frame, segments, parts)
        else:
            self._paint_all(painter, frame, line, known)
        self._draw_held_handle(painter, frame, line, segments)
        self._draw_cursor(painter, frame, line)

    def _changed(self, segments: Segments) -> frozenset[int]:
        """Return which segments a drag in mid-work changes; empty if there is none, or if they are many."""
        known = None if self._now is None or not self._now.is_preview else self._now.known
        if known is None or len(known.segments) != len(segments):
            return frozenset()
        changed = frozenset(
            index for index, pair in enumerate(zip(segments, known.segments, strict=True)) if pair[0] is not pair[1]
        )
        return changed if len(changed) <= _FEW else frozenset()

    def _paint_all(self, painter: QPainter, frame: Frame, line: ScreenLine, segments: Segments) -> QPixmap | None:
        """Draw all segments as if none were selected; return the picture of it, if there is one."""
        key = (line, segments, colours())
        return self._all.paint(
            painter, frame, key, lambda on: self._draw(on, frame, line, segments, range(len(segments)))
        )

    def _draw_rest(
        self, painter: QPainter, frame: Frame, line: ScreenLine, segments: Segments, changed: frozenset[int]
    ) -> None:
        """Draw what a drag does not change: the picture of all, in which only the place of the drag is drawn anew."""
        wanted = (line, segments, frame, changed, colours(), painter.device().devicePixelRatioF())
        if self._rest is None or self._rest_for != wanted:
            whole = transparent(painter, frame)
            inside = QPainter(whole)
            # Twice, so that it is kept as a picture whatever was drawn before.
            made = self._paint_all(inside, frame, line, segments) or self._paint_all(inside, frame, line, segments)
            inside.end()
            self._rest = whole if made is None else made.copy()
            self._rest_for = wanted
            self._take_out(self._rest, frame, line, segments, changed)
        painter.drawPixmap(0, 0, self._rest)

    def _take_out(
        self, picture: QPixmap, frame: Frame, line: ScreenLine, segments: Segments, changed: frozenset[int]
    ) -> None:
        """Wipe the place of some segments out of a picture of all, and draw what else lies there."""
        around = _AROUND + _A_LETTER * max(len(segment.name) for segment in segments)
        bounds = {
            index: line.kept_part(segment.start, segment.end).bounds.adjusted(-around, -around, around, around)
            for index, segment in enumerate(segments)
        }
        place = QRectF()
        for index in changed:
            place = place.united(bounds[index])
        inside = QPainter(picture)
        inside.setClipRect(place)
        inside.setCompositionMode(QPainter.CompositionMode.CompositionMode_Clear)
        inside.fillRect(place, Qt.GlobalColor.transparent)
        inside.setCompositionMode(QPainter.CompositionMode.CompositionMode_SourceOver)
        near = [index for index in bounds if index not in changed and bounds[index].intersects(place)]
        self._draw(inside, frame, line, segments, near)
        inside.end()

    def _draw(
        self, painter: QPainter, frame: Frame, line: ScreenLine, segments: Segments, indices: Sequence[int]
    ) -> None:
        """Paint some segments, the boundaries before them, and the numbers of the curves."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        view = QRectF(0, 0, frame.width, frame.height).adjusted(-_ROOM, -_ROOM, _ROOM, _ROOM)
        parts = {index: line.kept_part(segments[index].start, segments[index].end) for index in indices}
        # A straight along an axis has no area, which Qt calls no rectangle.
        seen = {index: part for index, part in parts.items() if part.bounds.adjusted(-1, -1, 1, 1).intersects(view)}
        of = colours()
        for kind, stroke in (("straight", pen(of.straight, 2.0)), ("curve", pen(of.curve, 4.5))):
            painter.setPen(stroke)
            for index, part in seen.items():
                if segments[index].kind == kind:
                    painter.drawPolyline(part.polygon)
        self._draw_handles(painter, frame, segments, parts)
        numbers = np.cumsum([segment.kind == "curve" for segment in segments]).tolist()
        for index, part in seen.items():
            if segments[index].kind == "curve":
                _draw_badge(painter, frame, part.points, segments[index].name or str(numbers[index]))

    def _draw_bands(self, painter: QPainter, frame: Frame, line: ScreenLine, segments: Segments) -> None:
        """Lay a band under selected segments."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(pen(colours().trace_doubtful, 13.0, alpha=110))
        for index in self.desk.selection.segments:
            if index < len(segments):
                part = line.kept_part(segments[index].start, segments[index].end)
                draw_line(painter, part.points, frame)

    def _draw_held_handle(self, painter: QPainter, frame: Frame, line: ScreenLine, segments: Segments) -> None:
        """Draw the handle of the selected boundary, larger than others and over them."""
        held = self.desk.selection.boundary
        if held is None or held >= len(segments) - 1:
            return
        x, y = line.at(np.array([segments[held].end]))[0].tolist()
        if frame.sees(QPointF(x, y)):
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
            painter.setPen(pen(_INK, 1.2))
            painter.setBrush(QColor(colours().accent))
            painter.drawRect(_square(x, y, _HELD))
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)

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
        squares: dict[str, list[QRectF]] = {of.vertex: [], of.border: []}
        last_x, last_y = -math.inf, -math.inf
        for behind, part in parts.items():
            index = behind - 1
            if index < 0:
                continue
            x, y = part.points[0].tolist()
            if not frame.sees(QPointF(x, y)) or math.hypot(x - last_x, y - last_y) < _CLOSEST:
                continue
            last_x, last_y = x, y
            locked = segments[index].locked or segments[index + 1].locked
            squares[of.border if locked else of.vertex].append(_square(x, y, _HANDLE))
        for colour, drawn in squares.items():
            painter.setPen(pen(of.muted if colour == of.border else _INK, 1.2))
            painter.setBrush(QColor(colour))
            painter.drawRects(drawn)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)


def _square(x: float, y: float, size: float) -> QRectF:
    return QRectF(round(x - size / 2) + 0.5, round(y - size / 2) + 0.5, size, size)


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

"""Ticks along the centreline at round stations, with numbers; and the station that all parts of the window mark."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.derived_layer import DerivedLayer
from bobdesk.ui.plan_view.plan_lines import LineInPlan
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import pen
from bobdesk.ui.theme import colours

_TICK = 5.0
# Ticks lie at least so far from each other on the screen, and numbers so far.
_TICKS_APART, _NUMBERS_APART = 14.0, 60.0
# The turn at a tick is felt over so many metres to both sides.
_FEEL = 25.0
_STEPS = (1.0, 5.0, 10.0, 50.0, 100.0, 500.0, 1000.0)


class StationsLayer(DerivedLayer):
    """Stations count in the user's unit."""

    name = "stations"
    usually_shown = False

    def __init__(self, desk: Desk, frame: Callable[[], Frame]) -> None:
        super().__init__(desk, frame)
        desk.selection.station_changed.connect(self.repaint)
        desk.quantities.changed.connect(self.repaint)

    def draw_line(self, painter: QPainter, frame: Frame, line: LineInPlan) -> None:
        """Paint ticks and numbers."""
        of = colours()
        screen = frame.to_screen(line.points)
        unit = 1.0 / self.desk.quantities.length_factor
        length = float(line.stations[-1])
        on_screen = float(np.hypot(*np.diff(screen, axis=0).T).sum())
        per_unit = on_screen / max(length, 1e-9) * unit
        tick = next((step for step in _STEPS if step * per_unit >= _TICKS_APART), _STEPS[-1])
        numbered = next((step for step in _STEPS if step >= tick and step * per_unit >= _NUMBERS_APART), _STEPS[-1])
        count = int(length / (tick * unit)) + 1
        stations = np.arange(count) * tick * unit
        x, y = (np.interp(stations, line.stations, screen[:, axis]) for axis in (0, 1))
        ahead = np.minimum(stations + 0.5, length)
        behind = np.maximum(stations - 0.5, 0.0)
        dx, dy = (
            np.interp(ahead, line.stations, screen[:, axis]) - np.interp(behind, line.stations, screen[:, axis])
            for axis in (0, 1)
        )
        size = np.maximum(np.hypot(dx, dy), 1e-9)
        # Numbers stand on the inner side of curves; those of the curves themselves stand on the outer one.
        further = np.clip(stations[:, None] + _FEEL * np.array([-1.0, 1.0]), 0.0, length)
        behind_x, ahead_x = np.interp(further, line.stations, screen[:, 0]).T
        behind_y, ahead_y = np.interp(further, line.stations, screen[:, 1]).T
        turn = (x - behind_x) * (ahead_y - y) - (y - behind_y) * (ahead_x - x)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for index in range(count):
            at = QPointF(float(x[index]), float(y[index]))
            if not frame.sees(at):
                continue
            across = QPointF(float(-dy[index] / size[index]), float(dx[index] / size[index]))
            is_numbered = round(index * tick) % round(numbered) == 0
            long = _TICK * (1.5 if is_numbered else 1.0)
            for shade, broad in ((of.base, 3.2), (of.text, 1.4)):
                painter.setPen(pen(shade, broad))
                painter.drawLine(at - across * long, at + across * long)
            if is_numbered:
                inwards = across if turn[index] >= 0 else -across
                self._write(painter, at + inwards * (long + 14), round(index * tick))
        self._mark_station(painter, frame, line)

    def _write(self, painter: QPainter, at: QPointF, station: int) -> None:
        of = colours()
        text = self.desk.quantities.number(station, 0)
        width = painter.fontMetrics().horizontalAdvance(text) + 6.0
        height = painter.fontMetrics().height() + 0.0
        box = QRectF(at.x() - width / 2, at.y() - height / 2, width, height)
        shade = QColor(of.base)
        shade.setAlpha(215)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(shade)
        painter.drawRoundedRect(box, 3, 3)
        painter.setPen(QColor(of.text))
        painter.drawText(box, int(Qt.AlignmentFlag.AlignCenter), text)

    def _mark_station(self, painter: QPainter, frame: Frame, line: LineInPlan) -> None:
        station = self.desk.selection.station
        if station is None:
            return
        place = (
            float(np.interp(station, line.stations, line.points[:, 0])),
            float(np.interp(station, line.stations, line.points[:, 1])),
        )
        painter.setPen(pen(colours().error, 2.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawEllipse(frame.point(place), 7.0, 7.0)

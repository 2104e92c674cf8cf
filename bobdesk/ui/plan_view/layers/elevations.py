"""Where elevations are known, where one more would help most, and the selected stretch of the line."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPolygonF

from bobdesk.arrays import FloatArray
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.derived_layer import DerivedLayer
from bobdesk.ui.plan_view.plan_lines import LineInPlan
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import pen
from bobdesk.ui.solve.open_data import open_data_of
from bobdesk.ui.theme import colours

# On white paper and on photographs alike, as the handles of segments.
_INK = "#22252b"
_SIZE = 6.0
_STRETCH = 9.0


class ElevationsLayer(DerivedLayer):
    """Diamonds as in the elevation strip; stations are those of the line as it is now."""

    name = "elevations"

    def __init__(self, desk: Desk, frame: Callable[[], Frame]) -> None:
        super().__init__(desk, frame)
        self._open = open_data_of(desk)
        self._open.changed.connect(self.repaint)
        desk.selection.stretch_changed.connect(self.repaint)

    def concerns(self, before: object, after: object) -> bool:
        """Return whether something is to be drawn: known elevations change without the line."""
        return before is not after

    def draw_line(self, painter: QPainter, frame: Frame, line: LineInPlan) -> None:
        """Paint the stretch, and diamonds over it."""
        from bobdesk.project import derive

        of = colours()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        stretch = self.desk.selection.stretch
        if stretch is not None:
            self._draw_stretch(painter, frame, line, stretch)
        project = self.desk.session.project
        if project.known_elevations:
            factor = derive.plan_factor(project)
            stations = factor * np.array([known.station for known in project.known_elevations])
            self._draw_diamonds(painter, frame, line, stations, _INK)
        found = self._open.advice
        if found is not None and self._open.is_current("advice"):
            share = found.station / float(found.stations[-1])
            station = np.array([share * float(line.stations[-1])])
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(pen(of.accent, 1.6, Qt.PenStyle.DashLine))
            painter.drawEllipse(_at(frame, line, station)[0], 2 * _SIZE, 2 * _SIZE)
            self._draw_diamonds(painter, frame, line, station, of.accent)

    def _draw_diamonds(self, painter: QPainter, frame: Frame, line: LineInPlan, stations: FloatArray, ink: str) -> None:
        painter.setPen(pen(ink, 1.6))
        painter.setBrush(QColor(colours().vertex))
        for at in _at(frame, line, stations):
            if frame.sees(at):
                x, y = at.x(), at.y()
                corners = (QPointF(x, y - _SIZE), QPointF(x + _SIZE, y), QPointF(x, y + _SIZE), QPointF(x - _SIZE, y))
                painter.drawPolygon(QPolygonF(corners))
        painter.setBrush(Qt.BrushStyle.NoBrush)

    def _draw_stretch(self, painter: QPainter, frame: Frame, line: LineInPlan, stretch: tuple[float, float]) -> None:
        inside = (line.stations > stretch[0]) & (line.stations < stretch[1])
        stations = np.concatenate([[stretch[0]], line.stations[inside], [stretch[1]]])
        broad = pen(colours().accent, _STRETCH, alpha=110)
        broad.setCapStyle(Qt.PenCapStyle.FlatCap)
        painter.setPen(broad)
        painter.drawPolyline(QPolygonF(_at(frame, line, stations)))


def _at(frame: Frame, line: LineInPlan, stations: FloatArray) -> list[QPointF]:
    places = np.column_stack([np.interp(stations, line.stations, line.points[:, axis]) for axis in (0, 1)])
    return [QPointF(x, y) for x, y in frame.to_screen(places).tolist()]

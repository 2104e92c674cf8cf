"""A designer's curves over the curvature strip: a bar of the designed length at the designed curvature."""

from __future__ import annotations

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QPainter, QPen

from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.design import design_of
from bobdesk.ui.strips.contents import shade
from bobdesk.ui.strips.overlay import Overlay
from bobdesk.ui.strips.strip_painting import Geometry


class DesignOverlay(Overlay):
    """Draws only; nothing of it can be dragged."""

    def __init__(self, desk: Desk) -> None:
        self._desk = desk
        self._design = design_of(desk)

    def paint_above(self, painter: QPainter, on: Geometry) -> None:
        """Draw a bar for each curve."""
        found = self._design.list
        if found is None:
            return
        factor = self._desk.quantities.length_factor
        painter.setPen(QPen(shade("preview"), 2.4, Qt.PenStyle.SolidLine, Qt.PenCapStyle.FlatCap))
        for curve in found.curves:
            left, right = on.x(curve.start + self._design.offset), on.x(curve.end + self._design.offset)
            if right < on.area.left() or left > on.area.right():
                continue
            y = max(on.y(1.0 / curve.radius / factor), on.area.top() + 2)
            painter.drawLine(QPointF(left, y), QPointF(right, y))
            for x in (left, right):
                painter.drawLine(QPointF(x, y - 3), QPointF(x, y + 3))

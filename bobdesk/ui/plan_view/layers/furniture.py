"""Scale bar and north arrow, which stay in their corners."""

from __future__ import annotations

import math
from collections.abc import Callable

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPolygonF

from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.layer import Layer
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import pen
from bobdesk.ui.theme import colours

_LONGEST = 180.0
_AWAY = 14.0


class FurnitureLayer(Layer):
    """Both are drawn in pixels of the screen alone."""

    name = "furniture"

    def __init__(self, desk: Desk, frame: Callable[[], Frame]) -> None:
        super().__init__(desk, frame)
        desk.quantities.changed.connect(self.repaint)

    def draw(self, painter: QPainter, frame: Frame) -> None:
        """Paint both where they mean something."""
        project = self.desk.session.project
        if project.source is None and project.picture is None:
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        per_unit, north = _scale_and_north(project)
        if per_unit is not None:
            self._draw_bar(painter, frame, per_unit, is_picture=project.source is None)
        if north is not None:
            _draw_north(painter, frame, north, self.tr("N"))

    def _draw_bar(self, painter: QPainter, frame: Frame, per_unit: float, *, is_picture: bool) -> None:
        of, quantities = colours(), self.desk.quantities
        shown_per_screen = per_unit / frame.scale * quantities.length_factor
        length = round_length(_LONGEST * shown_per_screen)
        width = length / shown_per_screen
        digits = 0 if length >= 1 else min(3, math.ceil(-math.log10(length)))
        text = f"{quantities.number(length, digits)} {quantities.length_unit}"
        if is_picture:
            text = f"{text} ({quantities.length(per_unit, 4)}/px)"
        metrics = painter.fontMetrics()
        inner = max(width, metrics.horizontalAdvance(text) + 2.0)
        box = QRectF(0, 0, inner + 20, metrics.height() + 20)
        box.moveBottomRight(QPointF(frame.width - _AWAY, frame.height - _AWAY))
        shade = QColor(of.base)
        shade.setAlpha(225)
        painter.setPen(pen(of.border, 1.0))
        painter.setBrush(shade)
        painter.drawRoundedRect(box, 4, 4)
        painter.setPen(QColor(of.text))
        painter.drawText(QPointF(box.x() + 10, box.y() + 4 + metrics.ascent()), text)
        y = box.bottom() - 8
        painter.setPen(pen(of.text, 2.6))
        painter.drawLine(QPointF(box.x() + 10, y), QPointF(box.x() + 10 + width, y))
        painter.setPen(pen(of.text, 1.4))
        for x in (box.x() + 10, box.x() + 10 + width):
            painter.drawLine(QPointF(x, y - 4), QPointF(x, y + 2))


def round_length(longest: float) -> float:
    """Return the largest of 1, 2, 5, 10 … that is no longer than `longest`."""
    power = 10.0 ** math.floor(math.log10(max(longest, 1e-12)))
    return next(factor * power for factor in (5.0, 2.0, 1.0) if factor * power <= longest * (1 + 1e-9))


def _scale_and_north(project: Project) -> tuple[float | None, float | None]:
    """Return metres per plan unit, and the direction of north on the screen, radians clockwise from up."""
    if project.source is not None:
        return 1.0, (None if project.source.longitude is None else 0.0)
    if project.calibration.way == "points" and not (project.control_points or project.known_distances):
        return None, None
    from bobdesk.project import derive

    found = derive.calibration(project).value
    if found is None or not found.scale_known:
        return None, None
    return found.metres_per_pixel, (found.rotation_rad if project.calibration.way == "world" else None)


def _draw_north(painter: QPainter, frame: Frame, angle: float, text: str) -> None:
    of = colours()
    painter.save()
    painter.translate(_AWAY + 20, frame.height - _AWAY - 26)
    painter.rotate(math.degrees(angle))
    painter.setPen(pen(of.base, 2.0))
    painter.setBrush(QColor(of.text))
    painter.drawPolygon(QPolygonF([QPointF(0, -16), QPointF(8, 14), QPointF(0, 8), QPointF(-8, 14)]))
    painter.setPen(QColor(of.text))
    painter.drawText(QRectF(-14, 15, 28, 18), int(Qt.AlignmentFlag.AlignCenter), text)
    painter.restore()

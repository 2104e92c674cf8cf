"""Control points with their residuals, known distances, and distances that only check."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QCoreApplication, QLocale, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPolygonF

from bobdesk.plan.control_points import KnownDistance
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.layer import Layer
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import pen
from bobdesk.ui.theme import colours

_RADIUS = 9.0
# The longest residual is drawn as long as this, screen pixels; never smaller than it is.
_LONGEST_ARROW = 44.0


class ControlPointsLayer(Layer):
    """Everything that the scale is made of."""

    name = "control_points"

    def __init__(self, desk: Desk, frame: Callable[[], Frame]) -> None:
        super().__init__(desk, frame)
        desk.selection.control_point_changed.connect(self.repaint)
        desk.quantities.changed.connect(self.repaint)

    def concerns(self, before: Project, after: Project) -> bool:
        """Return whether points or distances are others."""
        return (
            before.control_points is not after.control_points
            or before.known_distances is not after.known_distances
            or before.check_distances is not after.check_distances
        )

    def draw(self, painter: QPainter, frame: Frame) -> None:
        """Paint distances, then points, then residuals."""
        project = self.desk.session.project
        if project.source is not None:
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for known in project.known_distances:
            self._draw_distance(painter, frame, known, checks=False)
        for known in project.check_distances:
            self._draw_distance(painter, frame, known, checks=True)
        for index, point in enumerate(project.control_points):
            chosen = index == self.desk.selection.control_point
            at = frame.point((point.x_px, point.y_px))
            if frame.sees(at):
                draw_target(painter, at, point.name or str(index + 1), chosen=chosen, used=point.used)
        if len(project.control_points) > 1:
            _draw_residuals(painter, frame, project)

    def _draw_distance(self, painter: QPainter, frame: Frame, known: KnownDistance, *, checks: bool) -> None:
        text = self.desk.quantities.length(known.length_m, 2)
        if checks:
            text = self.tr("check {length}").format(length=text)
        style = Qt.PenStyle.DashLine if checks else Qt.PenStyle.SolidLine
        draw_measured(
            painter, frame.point(known.start_px), frame.point(known.end_px), text, style=style, faint=not known.used
        )


def draw_target(painter: QPainter, at: QPointF, text: str, *, chosen: bool, used: bool) -> None:
    """Draw a control point: a circle with a crosshair, and its name."""
    of = colours()
    colour = of.control_point if used else of.muted
    painter.setBrush(Qt.BrushStyle.NoBrush)
    if chosen:
        painter.setPen(pen(of.trace_doubtful, 7.0, alpha=150))
        painter.drawEllipse(at, _RADIUS, _RADIUS)
    for shade, width in ((of.base, 3.6), (colour, 1.8)):
        painter.setPen(pen(shade, width))
        if not used and shade == colour:
            painter.setPen(pen(shade, width, Qt.PenStyle.DotLine))
        painter.drawEllipse(at, _RADIUS, _RADIUS)
        for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1)):
            painter.drawLine(at + QPointF(x, y) * 4, at + QPointF(x, y) * (_RADIUS + 4))
    font = painter.font()
    font.setBold(True)
    painter.save()
    painter.setFont(font)
    metrics = painter.fontMetrics()
    where = at + QPointF(_RADIUS + 5, -_RADIUS)
    box = QRectF(metrics.boundingRect(text)).translated(where).adjusted(-3, -1, 3, 1)
    behind = QColor(of.base)
    behind.setAlpha(200)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(behind)
    painter.drawRoundedRect(box, 3, 3)
    painter.setPen(QColor(colour))
    painter.drawText(where, text)
    painter.restore()


def draw_measured(
    painter: QPainter,
    start: QPointF,
    end: QPointF,
    text: str,
    *,
    style: Qt.PenStyle = Qt.PenStyle.SolidLine,
    faint: bool = False,
) -> None:
    """Draw a dimension line between two points of the screen, with its length in the middle."""
    of = colours()
    colour = of.muted if faint else of.control_point
    way = end - start
    size = float(np.hypot(way.x(), way.y()))
    across = QPointF(-way.y(), way.x()) / max(size, 1e-9)
    for shade, width, kind in ((of.base, 3.6, Qt.PenStyle.SolidLine), (colour, 1.6, style)):
        painter.setPen(pen(shade, width, kind))
        painter.drawLine(start, end)
        painter.setPen(pen(shade, width))
        for point in (start, end):
            painter.drawLine(point - across * 6, point + across * 6)
    if text:
        metrics = painter.fontMetrics()
        box = QRectF(0, 0, metrics.horizontalAdvance(text) + 10, metrics.height() + 2)
        # Beside the line, not on it, so that what is measured stays in view.
        side = across if across.y() <= 0 else -across
        beside = abs(side.x()) * box.width() / 2 + abs(side.y()) * box.height() / 2 + 5
        box.moveCenter((start + end) / 2 + side * beside)
        painter.setPen(pen(of.border, 1.0))
        painter.setBrush(QColor(of.base))
        painter.drawRoundedRect(box, 3, 3)
        painter.setPen(QColor(colour))
        painter.drawText(box, int(Qt.AlignmentFlag.AlignCenter), text)


def _draw_residuals(painter: QPainter, frame: Frame, project: Project) -> None:
    """Draw an arrow from each click towards where its known position falls, all lengthened alike."""
    from bobdesk.project import derive

    fit = derive.calibration_fit(project).value
    if fit is None or not fit.points:
        return
    longest = max(residual.norm_px for residual in fit.points) * frame.scale
    if longest < 1e-6 * frame.scale or fit.degrees_of_freedom == 0:
        return
    factor = max(1.0, _LONGEST_ARROW / longest)
    if factor >= 1.5:
        words = QCoreApplication.translate("ControlPointsLayer", "Residuals lengthened {factor} times")
        _draw_words(painter, words.format(factor=QLocale().toString(round(factor))), frame)
    for point, residual in zip(project.control_points, fit.points, strict=True):
        start = frame.point((point.x_px, point.y_px))
        way = QPointF(-residual.dx_px, -residual.dy_px) * frame.scale * factor
        size = float(np.hypot(way.x(), way.y()))
        if size < 3.0 or not frame.sees(start):
            continue
        along = way / size
        across = QPointF(-along.y(), along.x())
        tip = start + way
        painter.setPen(pen(colours().error, 2.0))
        painter.drawLine(start, tip)
        painter.setBrush(QColor(colours().error))
        painter.drawPolygon(QPolygonF([tip, tip - along * 7 + across * 3.5, tip - along * 7 - across * 3.5]))


def _draw_words(painter: QPainter, words: str, frame: Frame) -> None:
    """Write a line at the lower left corner of the view."""
    of = colours()
    box = QRectF(painter.fontMetrics().boundingRect(words)).adjusted(-6, -3, 6, 3)
    box.moveBottomLeft(QPointF(12, frame.height - 14))
    painter.setPen(pen(of.border, 1.0))
    painter.setBrush(QColor(of.base))
    painter.drawRoundedRect(box, 3, 3)
    painter.setPen(QColor(of.muted))
    painter.drawText(box, int(Qt.AlignmentFlag.AlignCenter), words)

"""Start, finish and cut on the digitised line; what lies outside them is faded."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPolygonF

from bobdesk.arrays import FloatArray
from bobdesk.project.project import Project
from bobdesk.ui.plan_view.layers.layer import Layer
from bobdesk.ui.plan_view.near import distances_along, place_at
from bobdesk.ui.plan_view.space import Frame, digitised_points
from bobdesk.ui.plan_view.strokes import draw_line, pen
from bobdesk.ui.theme import colours

_POLE = 22.0


class FlagsLayer(Layer):
    """The flags of the project's extent."""

    name = "flags"

    def concerns(self, before: Project, after: Project) -> bool:
        """Return whether line or extent are others."""
        return (before.trace, before.source, before.extent) != (after.trace, after.source, after.extent)

    def draw(self, painter: QPainter, frame: Frame) -> None:
        """Paint what is cut off, then the flags."""
        project = self.desk.session.project
        points = digitised_points(project)
        if points is None or len(points) < 2:
            return
        whole = float(distances_along(points)[-1])
        extent = project.extent
        end = whole if extent.end is None else min(extent.end, whole)
        finish = whole if extent.finish is None else min(extent.finish, whole)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for first, last in ((0.0, extent.start), (end, whole)):
            if last > first:
                _fade(painter, frame, points, first, last)
        draw_flag(painter, frame.point(place_at(points, extent.start)[0]), colours().start, self.tr("Start"))
        draw_flag(
            painter, frame.point(place_at(points, finish)[0]), colours().finish, self.tr("Finish"), chequered=True
        )
        if extent.cut_off is not None and extent.cut_off < whole:
            place, way = place_at(points, extent.cut_off)
            draw_cut(painter, frame.point(place), (way[0], way[1] * frame.y_sign), self.tr("Cut"))


def draw_flag(painter: QPainter, at: QPointF, colour: str, text: str, *, chequered: bool = False) -> None:
    """Draw a flag whose pole stands at a point of the screen, with a word beside it."""
    of = colours()
    top = at - QPointF(0, _POLE)
    painter.setPen(pen(of.base, 4.0))
    painter.drawLine(at, top)
    painter.setPen(pen(colour, 1.8))
    painter.drawLine(at, top)
    painter.setBrush(QColor(colour))
    if chequered:
        box = QRectF(top.x(), top.y(), 14, 10)
        painter.setPen(pen(colour, 1.0))
        painter.setBrush(QColor(of.base))
        painter.drawRect(box)
        painter.setBrush(QColor(colour))
        for x, y in ((0, 0), (7, 5)):
            painter.drawRect(QRectF(box.x() + x, box.y() + y, 7, 5))
    else:
        painter.drawPolygon(QPolygonF([top, top + QPointF(14, 5), top + QPointF(0, 10)]))
    painter.setBrush(QColor(of.base))
    painter.setPen(pen(colour, 2.0))
    painter.drawEllipse(at, 3.5, 3.5)
    _write(painter, top + QPointF(18, 10), text)


def draw_cut(painter: QPainter, at: QPointF, way: tuple[float, float], text: str) -> None:
    """Draw a double stroke across the line, with a word beside it."""
    of = colours()
    along, across = QPointF(*way), QPointF(-way[1], way[0])
    for colour, width in ((of.base, 5.0), (of.error, 2.2)):
        painter.setPen(pen(colour, width))
        for shift in (-2.5, 2.5):
            middle = at + along * shift
            painter.drawLine(middle - across * 11, middle + across * 11)
    _write(painter, at + QPointF(14, -10), text)


def _write(painter: QPainter, at: QPointF, text: str) -> None:
    """Write a word that can be read on any picture."""
    of = colours()
    font = painter.font()
    font.setBold(True)
    painter.save()
    painter.setFont(font)
    metrics = painter.fontMetrics()
    box = QRectF(metrics.boundingRect(text)).translated(at).adjusted(-4, -2, 4, 2)
    shade = QColor(of.base)
    shade.setAlpha(215)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(shade)
    painter.drawRoundedRect(box, 3, 3)
    painter.setPen(QColor(of.text))
    painter.drawText(at, text)
    painter.restore()


def _fade(painter: QPainter, frame: Frame, points: FloatArray, first: float, last: float) -> None:
    """Cover a part of the line with a pale, broken one."""
    marks = distances_along(points)
    inside = (marks > first) & (marks < last)
    ends = np.array([place_at(points, first)[0], place_at(points, last)[0]])
    part = np.concatenate([ends[:1], points[inside], ends[1:]])
    painter.setPen(pen(colours().base, 4.0, alpha=190))
    draw_line(painter, frame.to_screen(part), frame)
    painter.setPen(pen(colours().muted, 1.4, Qt.PenStyle.DotLine))
    draw_line(painter, frame.to_screen(part), frame)

"""How a strip is drawn, on the screen, in a picture or in an SVG alike."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPen, QPolygonF
from PySide6.QtWidgets import QApplication

from bobdesk.arrays import FloatArray
from bobdesk.ui.strips.contents import Band, Bundle, Curve, Level, Marks, decimated, shade, stepped
from bobdesk.ui.strips.station_axis import ticks

LEFT, RIGHT, TOP, BOTTOM, AXIS = 66.0, 14.0, 21.0, 5.0, 20.0
_PIXELS_A_TICK_X, _PIXELS_A_TICK_Y = 90.0, 26.0
_FEW_POINTS = 200


@dataclass(frozen=True)
class Geometry:
    """Where stations and values lie on a strip.

    Attributes
    ----------
    area
        The plot, pixels.
    low, high
        Stations at its left and right, m.
    bottom, top
        Values, in shown units, at its lower and upper edge.
    """

    area: QRectF
    low: float
    high: float
    bottom: float
    top: float

    def x(self, station: float) -> float:
        """Return the pixel of a station."""
        return self.area.left() + (station - self.low) / (self.high - self.low) * self.area.width()

    def y(self, shown: float) -> float:
        """Return the pixel of a value in shown units."""
        return self.area.bottom() - (shown - self.bottom) / (self.top - self.bottom) * self.area.height()

    def station(self, x: float) -> float:
        """Return the station at a pixel, m."""
        return self.low + (x - self.area.left()) / self.area.width() * (self.high - self.low)

    def value(self, y: float) -> float:
        """Return the value at a pixel, in shown units."""
        return self.bottom + (self.area.bottom() - y) / self.area.height() * (self.top - self.bottom)

    @property
    def metres_per_pixel(self) -> float:
        """Metres of the line per pixel."""
        return (self.high - self.low) / max(self.area.width(), 1.0)


@dataclass(frozen=True)
class Words:
    """Texts of a strip and how numbers are written."""

    title: str
    unit: str
    note: str
    empty: str
    number: Callable[[float, int], str]
    along: float
    along_unit: str
    has_axis: bool


def plot_area(width: float, height: float, *, has_axis: bool) -> QRectF:
    """Return where the plot lies in a strip of a size."""
    below = AXIS if has_axis else BOTTOM
    return QRectF(LEFT, TOP, max(width - LEFT - RIGHT, 10.0), max(height - TOP - below, 10.0))


def draw_frame(painter: QPainter, on: Geometry, words: Words, width: float, *, full: bool) -> None:
    """Draw grid, axes and title; a strip without contents (not `full`) has no numbers at its left."""
    small = _font(0.88)
    painter.setFont(small)
    metrics = QFontMetricsF(small)
    if full:
        _draw_values(painter, on, words, metrics)
    positions, digits = ticks(on.low * words.along, on.high * words.along, round(on.area.width() / _PIXELS_A_TICK_X))
    for shown in positions.tolist():
        x = round(on.x(shown / words.along)) + 0.5
        painter.setPen(QPen(shade("grid", 110), 1.0))
        painter.drawLine(QPointF(x, on.area.top()), QPointF(x, on.area.bottom()))
        if words.has_axis:
            painter.setPen(shade("muted"))
            box = QRectF(x - 60, on.area.bottom() + 3, 120, AXIS - 3)
            painter.drawText(
                box, Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop, words.number(shown, digits)
            )
    if words.has_axis:
        painter.setPen(shade("muted"))
        box = QRectF(2, on.area.bottom() + 3, LEFT - 10, AXIS - 3)
        painter.drawText(box, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignTop, words.along_unit)
    _draw_title(painter, words, width)


def _draw_values(painter: QPainter, on: Geometry, words: Words, metrics: QFontMetricsF) -> None:
    found, digits = ticks(on.bottom, on.top, max(2, round(on.area.height() / _PIXELS_A_TICK_Y)))
    for shown in found.tolist():
        y = round(on.y(shown)) + 0.5
        painter.setPen(QPen(shade("grid"), 1.0))
        painter.drawLine(QPointF(on.area.left(), y), QPointF(on.area.right(), y))
        text = words.number(shown, digits)
        half = metrics.height() / 2
        if y - half < on.area.top() - 12 or y + half > on.area.bottom() + 10:
            continue
        painter.setPen(shade("muted"))
        box = QRectF(2, y - half, LEFT - 10, metrics.height())
        painter.drawText(box, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, text)


def _draw_title(painter: QPainter, words: Words, width: float) -> None:
    plain = _font(1.0)
    bold = QFont(plain)
    bold.setBold(True)
    painter.setFont(bold)
    painter.setPen(shade("text"))
    there = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
    painter.drawText(QRectF(LEFT, 1, width, TOP - 3), there, words.title)
    at = LEFT + QFontMetricsF(bold).horizontalAdvance(words.title) + 6
    painter.setFont(_font(0.92))
    painter.setPen(shade("muted"))
    painter.drawText(QRectF(at, 1, width, TOP - 3), there, words.unit)
    at += QFontMetricsF(painter.font()).horizontalAdvance(words.unit) + 14
    room = width - RIGHT - at
    note = QFontMetricsF(painter.font()).elidedText(words.note, Qt.TextElideMode.ElideLeft, max(room, 0.0))
    box = QRectF(at, 1, max(room, 0.0), TOP - 3)
    painter.drawText(box, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, note)
    painter.setFont(plain)


def draw_empty(painter: QPainter, on: Geometry, sentence: str) -> None:
    """Say why there is nothing to see."""
    if not sentence:
        return
    painter.setFont(_font(1.0))
    there = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
    box = painter.boundingRect(on.area, int(there), sentence).adjusted(-10, -3, 10, 3)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(shade("base", 225))
    painter.drawRoundedRect(box, 4, 4)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(shade("muted"))
    painter.drawText(on.area, int(there), sentence)


def draw_band(painter: QPainter, on: Geometry, band: Band, to_shown: Callable[[FloatArray], FloatArray]) -> None:
    """Fill the area between two curves."""
    columns = int(on.area.width())
    x, lower = decimated(band.stations, to_shown(band.low), on.low, on.high, columns)
    x_upper, upper = decimated(band.stations, to_shown(band.high), on.low, on.high, columns)
    outline = QPolygonF([*_points(on, x, lower), *reversed(_points(on, x_upper, upper))])
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(shade(band.colour, band.alpha))
    painter.drawPolygon(outline)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    if band.has_edges:
        painter.setPen(QPen(shade(band.colour, 200), 1.0, Qt.PenStyle.DotLine))
        painter.drawPolyline(QPolygonF(_points(on, x, lower)))
        painter.drawPolyline(QPolygonF(_points(on, x_upper, upper)))


def draw_bundle(painter: QPainter, on: Geometry, bundle: Bundle, to_shown: Callable[[FloatArray], FloatArray]) -> None:
    """Draw many faint curves."""
    painter.setPen(QPen(shade(bundle.colour, bundle.alpha), 1.0))
    for values in to_shown(bundle.values):
        x, y = decimated(bundle.stations, values, on.low, on.high, int(on.area.width()))
        painter.drawPolyline(QPolygonF(_points(on, x, y)))


def draw_curve(painter: QPainter, on: Geometry, curve: Curve, to_shown: Callable[[FloatArray], FloatArray]) -> None:
    """Draw a curve; values that are not finite leave gaps."""
    x, y = decimated(curve.stations, to_shown(curve.values), on.low, on.high, int(on.area.width()))
    if curve.steps:
        x, y = stepped(x, y)
    painter.setPen(curve.pen())
    good = np.isfinite(y)
    if good.all():
        _draw_line(painter, _points(on, x, y), curve.width)
        return
    edges = np.flatnonzero(np.diff(np.concatenate([[False], good, [False]]).astype(np.int8)))
    for first, last in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        _draw_line(painter, _points(on, x[first:last], y[first:last]), curve.width)


def _draw_line(painter: QPainter, points: list[QPointF], width: float) -> None:
    # Qt joins the corners of a broad line at a hundred times the cost of drawing its pieces; where there
    # are many they are so short that no join is seen.
    if width == 1.0 or len(points) < _FEW_POINTS:
        painter.drawPolyline(QPolygonF(points))
    else:
        painter.drawLines([QLineF(one, other) for one, other in pairwise(points)])


def draw_level(painter: QPainter, on: Geometry, level: Level, shown: float) -> None:
    """Draw a horizontal line with its label at the right."""
    y = on.y(shown)
    if not on.area.top() - 1 <= y <= on.area.bottom() + 1:
        return
    painter.setPen(QPen(shade(level.colour), 1.2, level.style))
    painter.drawLine(QPointF(on.area.left(), y), QPointF(on.area.right(), y))
    if level.label:
        painter.setFont(_font(0.88))
        metrics = QFontMetricsF(painter.font())
        width, height = metrics.horizontalAdvance(level.label) + 8, metrics.height()
        above = y - height - 1 >= on.area.top()
        box = QRectF(on.area.right() - width, y - height - 1 if above else y + 2, width, height)
        painter.fillRect(box, shade("base", 150))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, level.label)


def draw_marks(painter: QPainter, on: Geometry, marks: Marks, to_shown: Callable[[FloatArray], FloatArray]) -> None:
    """Draw points as diamonds."""
    painter.setPen(QPen(shade(marks.colour), 1.4))
    painter.setBrush(shade("base"))
    size = marks.size
    for station, value in zip(marks.stations.tolist(), to_shown(marks.values).tolist(), strict=True):
        x, y = on.x(station), on.y(value)
        corners = [QPointF(x, y - size), QPointF(x + size, y), QPointF(x, y + size), QPointF(x - size, y)]
        painter.drawPolygon(QPolygonF(corners))
    painter.setBrush(Qt.BrushStyle.NoBrush)


def _points(on: Geometry, x: FloatArray, y: FloatArray) -> list[QPointF]:
    across = on.area.left() + (x - on.low) * (on.area.width() / (on.high - on.low))
    # Far outside the plot a line is as good as at its edge; Qt's lines may not be endless.
    far = 4 * on.area.height()
    up = on.area.bottom() - (y - on.bottom) * (on.area.height() / (on.top - on.bottom))
    up = np.clip(up, on.area.top() - far, on.area.bottom() + far)
    return list(map(QPointF, across.tolist(), up.tolist()))


def _font(size: float) -> QFont:
    # Pictures and SVG have no font of their own.
    font = QApplication.font()
    font.setPointSizeF(max(5.0, size * font.pointSizeF()))
    return font

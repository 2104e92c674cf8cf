"""A chart of a few curves, drawn the same on the screen and into a file."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QLocale, QPointF, QRectF, QSize, QSizeF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPen, QPolygonF

from bobdesk.arrays import FloatArray
from bobdesk.ui.plots.decimated import decimated
from bobdesk.ui.plots.legend import height_for_all, legend_of
from bobdesk.ui.theme import colours

_GAP, _TICK = 8.0, 5.0
_MARKED_UP_TO = 60
_ROOM_SHARE = 0.04
# Colour never stands alone: neighbours in the legend differ in their line, too.
STYLES = (
    Qt.PenStyle.SolidLine,
    Qt.PenStyle.DashLine,
    Qt.PenStyle.DashDotLine,
    Qt.PenStyle.DotLine,
    Qt.PenStyle.DashDotDotLine,
)


@dataclass(frozen=True, eq=False)
class Series:
    """A curve.

    Attributes
    ----------
    name
        In the legend.
    x, y : (n,)
        NaN in y is a gap.
    number
        Which of the colours and line styles it has; the same thing has the same number everywhere.
    """

    name: str
    x: FloatArray
    y: FloatArray
    number: int


@dataclass(frozen=True, eq=False)
class Chart:
    """Curves with their axes.

    Attributes
    ----------
    title, x_label, y_label
        "" for none.
    series
        In the order of the legend.
    ticks
        Places on the x axis that have names, or () for an axis of numbers.
    """

    title: str
    x_label: str
    y_label: str
    series: tuple[Series, ...]
    ticks: tuple[tuple[float, str], ...] = ()


def colour_of_number(number: int) -> str:
    """Return the colour of a series."""
    return colours().runs[number % len(colours().runs)]


def style_of_number(number: int) -> Qt.PenStyle:
    """Return the line of a series; five styles and eight colours tell forty apart."""
    return STYLES[number % len(STYLES)]


def draw_chart(painter: QPainter, whole: QRectF, chart: Chart) -> None:
    """Draw a chart into a rectangle, in the painter's font and the colours in force."""
    of = colours()
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.fillRect(whole, QColor(of.base))
    metrics = QFontMetricsF(painter.font())
    line = metrics.height()
    area = whole.adjusted(_GAP, _GAP, -_GAP, -_GAP)
    if chart.title:
        area = _titled(painter, area, chart.title)
    area = _beside_legend(painter, area, chart.series)
    bottom = line * (2.0 if chart.x_label else 1.0) + _TICK + _GAP
    top = line + _GAP if chart.y_label else _GAP
    low, high = _range(chart.series)
    y_ticks = nice_ticks(low, high, max(2, int((area.height() - bottom - top) / (2.4 * line))))
    digits = decimals_of(y_ticks)
    texts = [shown(tick, digits) for tick in y_ticks]
    left = max(metrics.horizontalAdvance(text) for text in texts) + _TICK + _GAP
    plot = area.adjusted(left, top, -_GAP, -bottom)
    if plot.width() < 20 or plot.height() < 20:
        painter.restore()
        return
    x_low, x_high = _x_range(chart)

    def place(x: float, y: float) -> QPointF:
        return QPointF(
            plot.left() + (x - x_low) / (x_high - x_low) * plot.width(),
            plot.bottom() - (y - low) / (high - low) * plot.height(),
        )

    for tick, text in zip(y_ticks, texts, strict=True):
        y = place(x_low, tick).y()
        painter.setPen(QPen(QColor(of.grid), 1))
        painter.drawLine(QPointF(plot.left(), y), QPointF(plot.right(), y))
        painter.setPen(QColor(of.muted))
        painter.drawText(
            QRectF(area.left(), y - line / 2, left - _TICK - 2, line),
            Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter,
            text,
        )
    _x_ticks(painter, chart, plot, x_low, x_high)
    painter.setPen(QColor(of.muted))
    if chart.y_label:
        painter.drawText(QRectF(area.left(), area.top(), area.width(), line), Qt.AlignmentFlag.AlignLeft, chart.y_label)
    if chart.x_label:
        below = QRectF(plot.left(), area.bottom() - line, plot.width(), line)
        painter.drawText(below, Qt.AlignmentFlag.AlignHCenter, chart.x_label)
    painter.setPen(QPen(QColor(of.muted), 1))
    painter.drawLine(plot.bottomLeft(), plot.bottomRight())
    painter.setClipRect(plot.adjusted(-6, -6, 6, 6))
    for series in chart.series:
        _draw_series(painter, series, place)
    painter.restore()


def size_with_legend(chart: Chart, font: QFont, size: QSize) -> QSize:
    """Return the size in which a chart shows its whole legend: the given one, or a higher one."""
    metrics = QFontMetricsF(font)
    above = 2 * _GAP + (metrics.height() + _GAP if chart.title else 0)
    area = QSizeF(size.width() - 2 * _GAP, size.height() - above)
    needed = height_for_all([each.name for each in chart.series], metrics, area)
    return QSize(size.width(), math.ceil(needed + above))


def _titled(painter: QPainter, area: QRectF, title: str) -> QRectF:
    painter.save()
    bold = QFont(painter.font())
    bold.setBold(True)
    painter.setFont(bold)
    metrics = QFontMetricsF(bold)
    painter.setPen(QColor(colours().text))
    text = metrics.elidedText(title, Qt.TextElideMode.ElideRight, area.width())
    painter.drawText(QRectF(area.left(), area.top(), area.width(), metrics.height()), Qt.AlignmentFlag.AlignLeft, text)
    painter.restore()
    return area.adjusted(0, metrics.height() + _GAP, 0, 0)


def _beside_legend(painter: QPainter, area: QRectF, series: Sequence[Series]) -> QRectF:
    """Draw the legend into an area and return what is left of it."""
    legend = legend_of([each.name for each in series], QFontMetricsF(painter.font()), area.size())
    if legend is None:
        return area
    at, rest = legend.beside(area)
    legend.draw(painter, at, [_pen(each) for each in series])
    return rest


def _draw_series(painter: QPainter, series: Series, place: object) -> None:
    assert callable(place)
    painter.setPen(_pen(series))
    x, y = series.x, series.y
    good = np.isfinite(y)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], good, [False]]).astype(np.int8)))
    for first, last in zip(edges[::2], edges[1::2], strict=True):
        piece = decimated(x[first:last], y[first:last])
        painter.drawPolyline(QPolygonF([place(float(a), float(b)) for a, b in zip(*piece, strict=True)]))
    if len(x) <= _MARKED_UP_TO:
        painter.setPen(QPen(QColor(colours().base), 1))
        painter.setBrush(QColor(colour_of_number(series.number)))
        for a, b in zip(x[good], y[good], strict=True):
            painter.drawEllipse(place(float(a), float(b)), 3.5, 3.5)
        painter.setBrush(Qt.BrushStyle.NoBrush)


def _pen(series: Series) -> QPen:
    return QPen(QColor(colour_of_number(series.number)), 1.6, style_of_number(series.number))


def _x_ticks(painter: QPainter, chart: Chart, plot: QRectF, low: float, high: float) -> None:
    metrics = QFontMetricsF(painter.font())
    if chart.ticks:
        ticks = [(at, name) for at, name in chart.ticks if low <= at <= high]
        room = plot.width() / max(len(ticks), 1) - 4
    else:
        numbers = nice_ticks(low, high, max(2, int(plot.width() / (9 * metrics.averageCharWidth()))))
        digits = decimals_of(numbers)
        ticks = [(number, shown(number, digits)) for number in numbers if low <= number <= high]
        room = plot.width()
    ends = -math.inf
    for at, name in ticks:
        x = plot.left() + (at - low) / (high - low) * plot.width()
        painter.setPen(QPen(QColor(colours().muted), 1))
        painter.drawLine(QPointF(x, plot.bottom()), QPointF(x, plot.bottom() + _TICK))
        text = metrics.elidedText(name, Qt.TextElideMode.ElideMiddle, max(room, 24.0))
        width = metrics.horizontalAdvance(text) + 2
        left = min(max(x - width / 2, plot.left() - 20), plot.right() - width + 8)
        if left > ends:
            box = QRectF(left, plot.bottom() + _TICK, width, metrics.height())
            painter.drawText(box, Qt.AlignmentFlag.AlignHCenter, text)
            ends = left + width + 4


def _range(series: Sequence[Series]) -> tuple[float, float]:
    good = [each.y[np.isfinite(each.y)] for each in series]
    lows = [float(each.min()) for each in good if len(each)]
    highs = [float(each.max()) for each in good if len(each)]
    if not lows:
        return 0.0, 1.0
    low, high = min(lows), max(highs)
    flat = high - low < 1e-9 * max(abs(high), abs(low), 1e-6)
    room = (0.1 * abs(high) or 1.0) if flat else _ROOM_SHARE * (high - low)
    return low - room, high + room


def _x_range(chart: Chart) -> tuple[float, float]:
    xs = [float(x) for each in chart.series for x in each.x[[0, -1]] if len(each.x)] or [0.0, 1.0]
    xs += [at for at, _ in chart.ticks]
    low, high = min(xs), max(xs)
    if chart.ticks:
        room = 0.06 * (high - low) or 0.5
        return low - room, high + room
    return (low, high) if high > low else (low - 0.5, high + 0.5)


def nice_ticks(low: float, high: float, most: int) -> list[float]:
    """Return the round numbers in a range, some `most` of them at most, and two at least."""
    step = 10.0 ** math.floor(math.log10((high - low) / most))
    for factor in (1, 2, 5, 10):
        if (high - low) / (factor * step) <= most:
            step *= factor
            break
    while math.floor(high / step) <= math.ceil(low / step):
        step /= 2
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [index * step for index in range(first, last + 1)]


def decimals_of(ticks: Sequence[float]) -> int:
    """Return how many decimals tell the numbers of an axis apart."""
    step = ticks[1] - ticks[0] if len(ticks) > 1 else 1.0
    return min(max(0, math.ceil(-math.log10(step) - 1e-6)), 9)


def shown(value: float, digits: int) -> str:
    """Return a number with the signs of the user's country, and a real minus."""
    return QLocale().toString(round(value, digits) + 0.0, "f", digits).replace("-", "−")

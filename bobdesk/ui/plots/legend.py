"""The legend of a chart: beside the curves where it fits there, else below them in columns; no name is cut."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QCoreApplication, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen

from bobdesk.ui.theme import colours

GAP = 8.0
# After as many, colours and lines begin anew, and a name would not tell which curve it belongs to.
MOST_NAMED = 40
# What the curves keep of the height where a legend below them is large, and of the width beside one.
PLOT_HEIGHT = 280.0
_BELOW_SHARE = 0.45
_BESIDE_SHARE, _NARROW_SHARE, _NARROW = 0.36, 0.5, 640.0
_SAMPLE, _BETWEEN, _NARROWEST_COLUMN = 28.0, 4.0, 170.0


@dataclass(frozen=True, eq=False)
class Legend:
    """Where the names stand.

    Attributes
    ----------
    names
        Top left corner and lines of each that is shown, in the order of the curves.
    more
        How many are not, which the last line says.
    size
        Of all of it.
    is_below
        Below the curves, not at their right.
    """

    names: tuple[tuple[QPointF, tuple[str, ...]], ...]
    more: int
    size: QSizeF
    is_below: bool

    def beside(self, area: QRectF) -> tuple[QPointF, QRectF]:
        """Return where the legend stands in an area, and what is left of that for the curves."""
        if self.is_below:
            return (
                QPointF(area.left(), area.bottom() - self.size.height()),
                area.adjusted(0, 0, 0, -self.size.height() - GAP),
            )
        return QPointF(area.right() - self.size.width(), area.top()), area.adjusted(0, 0, -self.size.width() - GAP, 0)

    def draw(self, painter: QPainter, at: QPointF, pens: Sequence[QPen]) -> None:
        """Draw it with its top left corner at a point, with a sample of each curve's pen."""
        metrics = QFontMetricsF(painter.font())
        line = metrics.height()
        for (corner, lines), pen in zip(self.names, pens, strict=False):
            place = at + corner
            middle = place.y() + (line + _BETWEEN) / 2
            painter.setPen(pen)
            painter.drawLine(QPointF(place.x() + GAP, middle), QPointF(place.x() + GAP + _SAMPLE, middle))
            painter.setPen(QColor(colours().text))
            for number, text in enumerate(lines):
                self._write(painter, text, place + QPointF(2 * GAP + _SAMPLE, number * line + _BETWEEN / 2))
        if self.more:
            painter.setPen(QColor(colours().muted))
            self._write(painter, _more(self.more), at + QPointF(GAP, self.size.height() - line))

    def _write(self, painter: QPainter, text: str, at: QPointF) -> None:
        metrics = QFontMetricsF(painter.font())
        # Measured by the letters' own advance, a text may be a pixel wider than it is drawn.
        box = QRectF(at, QSizeF(metrics.horizontalAdvance(text) + 4, metrics.height()))
        painter.drawText(box, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, text)


def legend_of(names: Sequence[str], metrics: QFontMetricsF, area: QSizeF) -> Legend | None:
    """Return the legend that shows most names in an area, and leaves the curves room; None for one curve alone."""
    if len(names) < 2:
        return None
    share = _NARROW_SHARE if area.width() < _NARROW else _BESIDE_SHARE
    widest = _widest(names, metrics)
    beside = _in_columns(names, metrics, QSizeF(min(widest, share * area.width()), area.height()), 1, is_below=False)
    if widest <= share * area.width() and not _is_cut(beside, names):
        return beside
    room = max(_BELOW_SHARE * area.height(), area.height() - PLOT_HEIGHT)
    below = _below(names, metrics, QSizeF(area.width(), room))
    return below if below.more <= beside.more else beside


def height_for_all(names: Sequence[str], metrics: QFontMetricsF, area: QSizeF) -> float:
    """Return the height in which a legend below leaves the curves what they have of an area, and names them all."""
    legend = legend_of(names, metrics, area)
    if legend is None or not (legend.is_below or _is_cut(legend, names)):
        return area.height()
    return area.height() + _below(names, metrics, QSizeF(area.width(), math.inf)).size.height() + GAP


def wrapped(text: str, metrics: QFontMetricsF, width: float) -> tuple[str, ...]:
    """Return a text in lines of a width, parted at commas; what is wider alone at spaces, else anywhere."""
    lines = [""]
    for part in re.findall(r".+?(?:, |$)", text):
        if _fits(lines[-1] + part, metrics, width):
            lines[-1] += part
            continue
        lines.append("")
        for word in [part] if _fits(part, metrics, width) else re.findall(r"\S+ *", part):
            if not _fits(lines[-1] + word, metrics, width):
                lines.append("")
            for piece in [word] if _fits(word, metrics, width) else word:
                if not _fits(lines[-1] + piece, metrics, width):
                    lines.append("")
                lines[-1] += piece
    return tuple(line.rstrip() for line in lines if line.strip()) or ("",)


def _fits(text: str, metrics: QFontMetricsF, width: float) -> bool:
    return metrics.horizontalAdvance(text.rstrip()) <= width


def _is_cut(legend: Legend, names: Sequence[str]) -> bool:
    return len(legend.names) < min(len(names), MOST_NAMED)


def _widest(names: Sequence[str], metrics: QFontMetricsF) -> float:
    widest = max(metrics.horizontalAdvance(name) for name in names)
    return max(widest + _SAMPLE + 3 * GAP, metrics.horizontalAdvance(_more(len(names))) + GAP) + 1


def _below(names: Sequence[str], metrics: QFontMetricsF, room: QSizeF) -> Legend:
    """Return names in as many columns as show most of them, and these in the least height."""
    most = max(1, int(room.width() / _NARROWEST_COLUMN))
    tried = [_in_columns(names, metrics, room, columns, is_below=True) for columns in range(1, most + 1)]
    return min(tried, key=lambda legend: (legend.more, legend.size.height()))


def _in_columns(names: Sequence[str], metrics: QFontMetricsF, room: QSizeF, columns: int, *, is_below: bool) -> Legend:
    """Return names row by row, as far as the height goes."""
    each = room.width() / columns
    line = metrics.height()
    shown: list[tuple[QPointF, tuple[str, ...]]] = []
    top = 0.0
    named = names[:MOST_NAMED]
    for first in range(0, len(named), columns):
        row = [wrapped(name, metrics, each - _SAMPLE - 3 * GAP) for name in named[first : first + columns]]
        bottom = top + max(map(len, row)) * line + _BETWEEN
        is_last = first + columns >= len(names)
        if bottom + (0 if is_last else line) > room.height():
            break
        shown += [(QPointF(column * each, top), lines) for column, lines in enumerate(row)]
        top = bottom
    more = len(names) - len(shown)
    return Legend(tuple(shown), more, QSizeF(room.width(), top + (line if more else 0)), is_below)


def _more(count: int) -> str:
    return QCoreApplication.translate("ChartLegend", "and {count} more").format(count=count)

"""The way of a run on a logarithmic axis that never shows nothing."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFontMetricsF,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from bobdesk.arrays import FloatArray
from bobdesk.ui.plots.convergence_data import ConvergenceData
from bobdesk.ui.theme import colours

_LEFT, _RIGHT, _TOP, _BOTTOM = 46, 10, 18, 20
_DECADES_SHOWN = 14
_STYLES = {
    "objective": Qt.PenStyle.SolidLine,
    "length term": Qt.PenStyle.DotLine,
    "height term": Qt.PenStyle.DotLine,
    "other terms": Qt.PenStyle.DotLine,
    "length": Qt.PenStyle.SolidLine,
    "drop": Qt.PenStyle.SolidLine,
    "optimality": Qt.PenStyle.DashLine,
    "step": Qt.PenStyle.DashDotLine,
    "scale": Qt.PenStyle.DashDotDotLine,
}


def colour_of_series(name: str) -> str:
    """Return the colour of a series; what belongs together shares one and differs in line style."""
    of = colours()
    return {
        "objective": of.text,
        "length term": of.runs[0],
        "height term": of.runs[1],
        "other terms": of.muted,
        "length": of.runs[0],
        "drop": of.runs[1],
        "optimality": of.runs[2],
        "step": of.runs[3],
        "scale": of.runs[4],
    }[name]


def style_of_series(name: str) -> Qt.PenStyle:
    """Return the line style of a series."""
    return _STYLES[name]


class ConvergencePlot(QWidget):
    """Draws chosen series against the number of the iterate.

    The wheel zooms at the mouse, dragging with the right or middle button pans, and either holds the view; a click
    or a drag with the left button, or the arrow keys, choose an iterate.

    Signals
    -------
    chosen
        Number of the iterate that the user wants to see (int).
    held
        Whether the user has zoomed or panned, so that the view no longer follows the run.
    """

    chosen = Signal(int)
    held = Signal(bool)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("convergence_plot")
        self.setAccessibleName(self.tr("Convergence of the run"))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setMouseTracking(True)
        self._data: ConvergenceData | None = None
        self._stages: tuple[str, ...] = ()
        self._series: tuple[str, ...] = ("objective", "length", "drop", "optimality")
        self._view: tuple[float, float] | None = None
        self._cursor: int | None = None
        self._panned_from: tuple[float, tuple[float, float]] | None = None
        self._scrubs = False

    def sizeHint(self) -> QSize:
        """Be as high as in the drawing of the panel."""
        return QSize(380, 190)

    @property
    def data(self) -> ConvergenceData | None:
        """What is drawn."""
        return self._data

    @property
    def cursor_number(self) -> int | None:
        """Number of the iterate that is marked."""
        return self._cursor

    @property
    def follows(self) -> bool:
        """Whether all iterates are shown as they come."""
        return self._view is None

    def show_data(self, data: ConvergenceData | None, stages: Iterable[str], *, may_scrub: bool) -> None:
        """Draw a run, or the same one with more iterates.

        Parameters
        ----------
        may_scrub
            Whether iterates can be chosen.
        """
        if data is not self._data:
            self._cursor = None
            self._set_view(None)
        self._data, self._stages, self._scrubs = data, tuple(stages), may_scrub
        self.update()

    def show_series(self, names: Iterable[str]) -> None:
        """Draw these series."""
        self._series = tuple(names)
        self.update()

    def mark(self, number: int | None) -> None:
        """Mark an iterate, or none."""
        self._cursor = number
        self.update()

    def follow(self) -> None:
        """Show all iterates as they come."""
        self._set_view(None)
        self.update()

    def hold(self) -> None:
        """Keep showing what is shown now."""
        if self._view is None and self._data is not None and self._data.count > 1:
            self._set_view((float(self._data.numbers[0]), float(self._data.numbers[-1])))

    def range_of(self) -> tuple[float, float]:
        """Return the lowest and highest decade that are shown."""
        data = self._data
        if data is None or not data.count:
            return -3.0, 3.0
        first, last = self._rows()
        ranges = [data.range_of(name, first, last) for name in self._series]
        found = [one for one in ranges if one is not None]
        if not found:
            return -3.0, 3.0
        high = math.ceil(max(high for _, high in found) + 0.05)
        low = max(math.floor(min(low for low, _ in found) - 0.05), high - _DECADES_SHOWN)
        return (float(low), float(max(high, low + 2)))

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw axes, stages, curves and the marked iterate."""
        painter = QPainter(self)
        self.draw(painter, QRectF(self.rect()))
        painter.end()

    def draw(self, painter: QPainter, whole: QRectF) -> None:
        """Draw everything into a rectangle, of a screen or of a file."""
        of = colours()
        painter.fillRect(whole, QColor(of.base))
        painter.setPen(QPen(QColor(of.border)))
        painter.drawRect(whole.adjusted(0.5, 0.5, -0.5, -0.5))
        area = whole.adjusted(_LEFT, _TOP, -_RIGHT, -_BOTTOM)
        data = self._data
        if data is None or not data.count:
            painter.setPen(QColor(of.muted))
            painter.drawText(whole, Qt.AlignmentFlag.AlignCenter, self.tr("The way of a run appears here."))
            return
        low, high = self.range_of()
        self._draw_axes(painter, area, low, high)
        first, last = self._rows()
        painter.save()
        painter.setClipRect(area.adjusted(-1, -1, 1, 1))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        x_low, x_high = self._x_range()
        for name in self._series:
            x, y = data.curve(name, first, last, max(int(area.width()), 2))
            self._draw_curve(painter, area, name, (x - x_low) / (x_high - x_low), (y - low) / (high - low))
        if self._cursor is not None:
            self._draw_cursor(painter, area, (self._cursor - x_low) / (x_high - x_low), low, high)
        painter.restore()

    def _draw_curve(self, painter: QPainter, area: QRectF, name: str, x: FloatArray, y: FloatArray) -> None:
        pen = QPen(QColor(colour_of_series(name)), 1.0, style_of_series(name))
        pen.setCosmetic(True)
        painter.setPen(pen)
        across = area.left() + x * area.width()
        # What is 0, or off the axis, lies on its edge: a curve never vanishes.
        down = area.bottom() - np.clip(y, 0.0, 1.0) * area.height()
        good = np.isfinite(y) | np.isposinf(y)
        for part in _runs_of(good):
            points = list(map(QPointF, across[part].tolist(), down[part].tolist()))
            if len(points) == 1:
                painter.drawEllipse(points[0], 1.5, 1.5)
            else:
                painter.drawPolyline(QPolygonF(points))

    def _draw_axes(self, painter: QPainter, area: QRectF, low: float, high: float) -> None:
        of = colours()
        metrics = QFontMetricsF(painter.font())
        font = painter.font()
        font.setPointSizeF(max(font.pointSizeF() * 0.85, 7.0))
        painter.setFont(font)
        metrics = QFontMetricsF(font)
        step = max(1, math.ceil((high - low) * 1.3 * metrics.height() / max(area.height(), 1.0)))
        decade = math.ceil(low)
        while decade <= high:
            y = area.bottom() - (decade - low) / (high - low) * area.height()
            painter.setPen(QPen(QColor(of.grid), 0.6))
            painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y))
            painter.setPen(QColor(of.muted))
            box = QRectF(2, y - metrics.height() / 2, area.left() - 8, metrics.height())
            painter.drawText(box, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, f"1e{decade:d}")
            decade += step
        x_low, x_high = self._x_range()
        for number in _round_numbers(x_low, x_high, max(2, int(area.width() // 70))):
            x = area.left() + (number - x_low) / (x_high - x_low) * area.width()
            painter.setPen(QPen(QColor(of.grid), 0.6))
            painter.drawLine(QPointF(x, area.bottom()), QPointF(x, area.bottom() + 3))
            painter.setPen(QColor(of.muted))
            text = self.locale().toString(int(number))
            wide = metrics.horizontalAdvance(text)
            at = min(max(x - wide / 2, area.left()), area.right() - wide)
            painter.drawText(QPointF(at, area.bottom() + 4 + metrics.ascent()), text)
        self._draw_stages(painter, area, metrics)

    def _draw_stages(self, painter: QPainter, area: QRectF, metrics: QFontMetricsF) -> None:
        data = self._data
        if data is None:
            return
        of = colours()
        x_low, x_high = self._x_range()
        starts = data.stage_starts
        ends = [data.numbers[row] for row, _ in starts[1:]] + [data.numbers[-1]]
        free = area.left()
        for (row, stage), end in list(zip(starts, ends, strict=True))[:200]:
            x = area.left() + (data.numbers[row] - x_low) / (x_high - x_low) * area.width()
            if not area.left() - 1 <= x <= area.right():
                continue
            if row:
                painter.setPen(QPen(QColor(of.muted), 0.8, Qt.PenStyle.DotLine))
                painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()))
            text = self.stage_text(self._stages[stage]) if stage < len(self._stages) else ""
            room = area.left() + (end - x_low) / (x_high - x_low) * area.width() - x
            if x >= free and metrics.horizontalAdvance(text) <= room:
                painter.setPen(QColor(of.muted))
                painter.drawText(QPointF(x + 2, area.top() - 5), text)
                free = x + metrics.horizontalAdvance(text) + 8

    def stage_text(self, stage: str) -> str:
        """Return the name of a stage for the user."""
        return {
            "smoothest profile": self.tr("smoothest profile"),
            "shortest line": self.tr("shortest line"),
            "length": self.tr("meet the length"),
            "published": self.tr("as published"),
            "result": self.tr("result"),
        }.get(stage, stage)

    def _draw_cursor(self, painter: QPainter, area: QRectF, share: float, low: float, high: float) -> None:
        of = colours()
        data = self._data
        if data is None or self._cursor is None:
            return
        x = area.left() + share * area.width()
        painter.setPen(QPen(QColor(of.text), 1.0, Qt.PenStyle.DashLine))
        painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()))
        row = data.nearest(self._cursor)
        for name in self._series:
            value = float(data.logs(name, row, row + 1)[0])
            if not math.isnan(value):
                y = area.bottom() - min(max((value - low) / (high - low), 0.0), 1.0) * area.height()
                painter.setPen(QPen(QColor(of.base), 1.0))
                painter.setBrush(QColor(colour_of_series(name)))
                painter.drawEllipse(QPointF(x, y), 3.5, 3.5)
        painter.setBrush(Qt.BrushStyle.NoBrush)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Choose an iterate, or begin to pan."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._choose_at(event.position().x())
        elif self._data is not None and self._data.count > 1:
            self._panned_from = (event.position().x(), self._x_range())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Choose or pan while a button is held."""
        if event.buttons() & Qt.MouseButton.LeftButton:
            self._choose_at(event.position().x())
        elif self._panned_from is not None:
            at, (low, high) = self._panned_from
            moved = (at - event.position().x()) / max(self._width(), 1.0) * (high - low)
            self._set_view((low + moved, high + moved))
            self.update()

    def mouseReleaseEvent(self, _event: QMouseEvent) -> None:
        """End panning."""
        self._panned_from = None

    def mouseDoubleClickEvent(self, _event: QMouseEvent) -> None:
        """Show everything again."""
        self.follow()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom at the mouse while the plot has the focus; else the panel scrolls."""
        if not self.hasFocus() or self._data is None or self._data.count < 2:
            event.ignore()
            return
        low, high = self._x_range()
        share = min(max((event.position().x() - _LEFT) / max(self._width(), 1.0), 0.0), 1.0)
        at = low + share * (high - low)
        factor = 0.8 ** (event.angleDelta().y() / 120)
        wide = max((high - low) * factor, 4.0)
        self._set_view((at - share * wide, at + (1 - share) * wide))
        self.update()
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Go from iterate to iterate."""
        data = self._data
        by = {
            Qt.Key.Key_Left: -1,
            Qt.Key.Key_Right: 1,
            Qt.Key.Key_PageUp: -20,
            Qt.Key.Key_PageDown: 20,
            Qt.Key.Key_Home: -(10**9),
            Qt.Key.Key_End: 10**9,
        }.get(Qt.Key(event.key()))
        if by is None or data is None or not data.count or not self._scrubs:
            super().keyPressEvent(event)
            return
        row = data.count - 1 if self._cursor is None else data.nearest(self._cursor)
        row = min(max(row + by, 0), data.count - 1)
        self.chosen.emit(int(data.numbers[row]))

    def _choose_at(self, x: float) -> None:
        data = self._data
        if data is None or not data.count or not self._scrubs:
            return
        low, high = self._x_range()
        number = low + (x - _LEFT) / max(self._width(), 1.0) * (high - low)
        self.chosen.emit(int(data.numbers[data.nearest(number)]))

    def _width(self) -> float:
        return float(self.width() - _LEFT - _RIGHT)

    def _set_view(self, view: tuple[float, float] | None) -> None:
        was = self._view is not None
        self._view = view
        if was != (view is not None):
            self.held.emit(view is not None)

    def _x_range(self) -> tuple[float, float]:
        if self._view is not None:
            return self._view
        data = self._data
        if data is None or data.count < 2:
            return 0.0, 1.0
        return float(data.numbers[0]), float(data.numbers[-1])

    def _rows(self) -> tuple[int, int]:
        """Return the rows that are shown, and one more on each side."""
        data = self._data
        if data is None:
            return 0, 0
        low, high = self._x_range()
        first = max(int(np.searchsorted(data.numbers, low)) - 1, 0)
        last = min(int(np.searchsorted(data.numbers, high, side="right")) + 1, data.count)
        return (first, last) if last > first else (0, data.count)


def _runs_of(good: np.ndarray) -> list[slice]:
    """Return the stretches of an array of booleans that are true."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], good, [False]]).astype(np.int8)))
    return [slice(int(start), int(end)) for start, end in zip(edges[::2], edges[1::2], strict=True)]


def _round_numbers(low: float, high: float, most: int) -> list[float]:
    step = 10.0 ** math.floor(math.log10(max((high - low) / most, 1.0)))
    for factor in (1, 2, 5, 10):
        if (high - low) / (factor * step) <= most:
            step *= factor
            break
    first = math.ceil(low / step) * step
    return [first + index * step for index in range(int((high - first) / step + 1e-9) + 1)]

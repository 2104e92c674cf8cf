"""A table of colours with its numbers in the cells, drawn the same on the screen and into a file."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from PySide6.QtCore import QPoint, QRect, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QPainter, QPen

from bobdesk.ui.theme import colours

# From nothing to the most, on paper and at night.
_LIGHT, _DARK = (255, 247, 236), (179, 61, 20)
_NIGHT_LIGHT, _NIGHT_DARK = (52, 46, 42), (255, 158, 92)
_MARGIN, _GAP = 12, 8
_WIDEST_LABEL, _NARROWEST_CELL, _WIDEST_CELL = 480, 56, 260


@dataclass(frozen=True)
class HeatCell:
    """A cell.

    Attributes
    ----------
    text
        The number, or why there is none.
    share
        Of the most, 0 to 1; None where there is no number.
    tip
        What is said of it when asked.
    """

    text: str
    share: float | None
    tip: str = ""


@dataclass(frozen=True, eq=False)
class HeatMap:
    """A table of colours.

    Attributes
    ----------
    title
        "" for none.
    down
        A label for each row.
    across
        Lines of a label for each column.
    cells
        By row and column.
    """

    title: str
    down: tuple[str, ...]
    across: tuple[tuple[str, ...], ...]
    cells: dict[tuple[int, int], HeatCell]


class HeatMapLayout:
    """Where the parts of a table of colours are, in a font."""

    def __init__(self, heat_map: HeatMap, font: QFont) -> None:
        self.map = heat_map
        self._font = font
        self._metrics = QFontMetrics(font)
        self._bold = QFont(font)
        self._bold.setBold(True)

    @cached_property
    def size(self) -> QSize:
        """What it needs."""
        return QSize(
            self._left + self._cell.width() * len(self.map.across) + _MARGIN,
            self._top + self._cell.height() * len(self.map.down) + _MARGIN,
        )

    @cached_property
    def _cell(self) -> QSize:
        texts = [cell.text for cell in self.map.cells.values()]
        texts += [line for lines in self.map.across for line in lines]
        widest = max((self._metrics.horizontalAdvance(text) for text in texts), default=0) + 18
        return QSize(min(max(widest, _NARROWEST_CELL), _WIDEST_CELL), self._metrics.height() + 14)

    @cached_property
    def _left(self) -> int:
        widest = max((self._metrics.horizontalAdvance(label) for label in self.map.down), default=0)
        return _MARGIN + min(widest + 2, _WIDEST_LABEL) + _GAP

    @cached_property
    def _top(self) -> int:
        lines = max((len(lines) for lines in self.map.across), default=0)
        title = self._metrics.height() + _GAP if self.map.title else 0
        return _MARGIN + title + lines * self._metrics.height() + _GAP

    def cell_at(self, point: QPoint) -> tuple[int, int] | None:
        """Return row and column of the cell at a point."""
        column = (point.x() - self._left) // self._cell.width()
        row = (point.y() - self._top) // self._cell.height()
        return (row, column) if (row, column) in self.map.cells else None

    def rectangle(self, row: int, column: int) -> QRect:
        """Return where a cell is."""
        at = QPoint(self._left + column * self._cell.width(), self._top + row * self._cell.height())
        return QRect(at, self._cell).adjusted(1, 1, -1, -1)

    def draw(self, painter: QPainter) -> None:
        """Draw it with its top left corner at the origin, in the colours in force."""
        of = colours()
        metrics, high = self._metrics, self._metrics.height()
        painter.save()
        painter.setFont(self._bold)
        painter.setPen(QColor(of.text))
        if self.map.title:
            painter.drawText(_MARGIN, _MARGIN + metrics.ascent(), self.map.title)
        painter.setFont(self._font)

        def text(box: QRect, words: str, align: Qt.AlignmentFlag) -> None:
            painter.drawText(box, align, metrics.elidedText(words, Qt.TextElideMode.ElideMiddle, box.width()))

        for column, lines in enumerate(self.map.across):
            left = self._left + column * self._cell.width()
            for index, words in enumerate(lines):
                top = self._top - _GAP // 2 - (len(lines) - index) * high
                text(QRect(left + 3, top, self._cell.width() - 6, high), words, Qt.AlignmentFlag.AlignCenter)
        for row, words in enumerate(self.map.down):
            box = QRect(
                _MARGIN, self._top + row * self._cell.height(), self._left - _MARGIN - _GAP, self._cell.height()
            )
            painter.setPen(QColor(of.text))
            text(box, words, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        for (row, column), cell in self.map.cells.items():
            box = self.rectangle(row, column)
            if cell.share is None:
                painter.setPen(QPen(QColor(of.muted), 1, Qt.PenStyle.DashLine))
                painter.drawRect(box.adjusted(0, 0, -1, -1))
                painter.setPen(QColor(of.text))
            else:
                colour = _colour(cell.share, of.is_dark)
                painter.fillRect(box, colour)
                painter.setPen(_ink(colour))
            text(box, cell.text, Qt.AlignmentFlag.AlignCenter)
        painter.restore()


def _colour(share: float, is_dark: bool) -> QColor:
    first, last = (_NIGHT_LIGHT, _NIGHT_DARK) if is_dark else (_LIGHT, _DARK)
    return QColor(*(round(a + share * (b - a)) for a, b in zip(first, last, strict=True)))


def _ink(background: QColor) -> QColor:
    """Return black or white, whichever has the larger contrast (WCAG's relative luminance)."""
    levels = (background.redF(), background.greenF(), background.blueF())
    parts = [level / 12.92 if level <= 0.04045 else ((level + 0.055) / 1.055) ** 2.4 for level in levels]
    luminance = 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]
    return QColor(Qt.GlobalColor.black if (luminance + 0.05) ** 2 > 1.05 * 0.05 else Qt.GlobalColor.white)

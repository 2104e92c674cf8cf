"""A picture of a study: for each figure a table of colours, with its numbers in the cells."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from bobdesk.track.study import STUDY_COLUMNS
from bobdesk.ui.plots import palette
from bobdesk.ui.qt import application_without_screen

# Column and title.
_PANELS = (
    ("length_percent", "Deviation of the length (%)"),
    ("drop_percent", "Deviation of the height difference (%)"),
    ("z_rms_m", "Error of the elevation, RMS (m)"),
    ("max_gradient", "Largest gradient"),
)
_CELL, _HIGH, _LEFT, _TOP, _GAP, _MARGIN = 92, 30, 190, 84, 34, 24
_LARGEST = 16_000
_NOTHING = 5e-6
_LIGHT, _DARK = (255, 247, 236), (179, 61, 20)


@dataclass(frozen=True)
class _Panel:
    title: str
    rows: list[str]
    columns: list[tuple[str, str, str]]
    values: dict[tuple[str, tuple[str, str, str]], str]


def draw_study(rows: Sequence[Sequence[str]], *, kind: str) -> bytes:
    """Draw the rows of a study and return the bytes of the picture.

    Parameters
    ----------
    rows
        As in the table.
    kind
        ".png" or ".svg".

    Raises
    ------
    InputError
        If Qt cannot start.
    """
    application_without_screen()
    from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QRect, QSize
    from PySide6.QtGui import QImage, QPainter
    from PySide6.QtSvg import QSvgGenerator

    panels = [panel for column, title in _PANELS if (panel := _panel(rows, column, title)) is not None]
    width, heights = _size(panels)
    size = QSize(min(width, _LARGEST), min(sum(heights) + _MARGIN, _LARGEST))
    content = QByteArray()
    buffer = QBuffer(content)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    device: Any
    if kind == ".svg":
        device = QSvgGenerator()
        device.setOutputDevice(buffer)
        device.setSize(size)
        device.setViewBox(QRect(0, 0, size.width(), size.height()))
    else:
        device = QImage(size, QImage.Format.Format_RGB32)
    painter = QPainter(device)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.fillRect(QRect(0, 0, size.width(), size.height()), palette.PAPER)
    top = _MARGIN
    for panel, height in zip(panels, heights, strict=True):
        _draw(painter, panel, top)
        top += height
    painter.end()
    if kind == ".png":
        device.save(buffer, "PNG")
    buffer.close()
    return bytes(content.data())


def _panel(rows: Sequence[Sequence[str]], column: str, title: str) -> _Panel | None:
    """Return the panel of a column, or None where no row has a figure in it."""
    at = {name: index for index, name in enumerate(STUDY_COLUMNS)}
    if not any(row[at[column]] for row in rows):
        return None
    several = len({row[at["plan"]] for row in rows}) > 1
    down: dict[str, None] = {}
    across: dict[tuple[str, str, str], None] = {}
    values = {}
    for row in rows:
        count = f"{row[at['wanted_segments']] or row[at['segments']]} segments"
        name = f"{row[at['plan']]}, {count}" if several else count
        known = row[at["known"]]
        weight = row[at["height_weight"]]
        key = (row[at["method"]], f"b = {weight}" if weight else "", "" if known in ("", "none") else f"known {known}")
        down[name] = across[key] = None
        values[name, key] = row[at[column]]
    return _Panel(title, list(down), list(across), values)


def _size(panels: list[_Panel]) -> tuple[int, list[int]]:
    width = max((_LEFT + _CELL * len(panel.columns) for panel in panels), default=_LEFT) + _MARGIN
    return max(width, 480), [_TOP + _HIGH * len(panel.rows) + _GAP for panel in panels]


def _draw(painter: Any, panel: _Panel, top: int) -> None:
    from PySide6.QtCore import QRect, Qt
    from PySide6.QtGui import QColor, QFont, QFontMetrics, QPen

    font = QFont()
    font.setPixelSize(13)
    bold = QFont(font)
    bold.setPixelSize(16)
    bold.setBold(True)
    painter.setPen(QColor(palette.INK))
    painter.setFont(bold)
    painter.drawText(_MARGIN, top + 18, panel.title)
    painter.setFont(font)
    metrics = QFontMetrics(font)

    def text(box: QRect, words: str, align: Any) -> None:
        painter.drawText(box, align, metrics.elidedText(words, Qt.TextElideMode.ElideRight, box.width()))

    for index, names in enumerate(panel.columns):
        for line, words in enumerate(names):
            box = QRect(_LEFT + _CELL * index + 3, top + 26 + 17 * line, _CELL - 6, 17)
            text(box, words, Qt.AlignmentFlag.AlignCenter)
    numbers = [abs(number) for value in panel.values.values() if (number := _number(value)) is not None]
    low, high = min(numbers, default=0.0), max(numbers, default=0.0)
    for line, name in enumerate(panel.rows):
        y = top + _TOP + _HIGH * line
        painter.setPen(QColor(palette.INK))
        text(
            QRect(_MARGIN, y, _LEFT - _MARGIN - 12, _HIGH),
            name,
            Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter,
        )
        for index, key in enumerate(panel.columns):
            value = panel.values.get((name, key))
            if value is None:
                continue
            box = QRect(_LEFT + _CELL * index + 1, y + 1, _CELL - 2, _HIGH - 2)
            number = _number(value)
            share = 0.0 if number is None or high <= low else (abs(number) - low) / (high - low)
            fill = QColor(*(round(a + share * (b - a)) for a, b in zip(_LIGHT, _DARK, strict=True)))
            if number is None:
                painter.setPen(QPen(QColor(palette.FAINT), 1, Qt.PenStyle.DashLine))
                painter.drawRect(box)
                painter.setPen(QColor(palette.INK))
            else:
                painter.fillRect(box, fill)
                painter.setPen(QColor(palette.PAPER if share > 0.6 else palette.INK))
            text(
                box,
                "failed" if number is None else f"{number:.4g}" if abs(number) >= _NOTHING else "0",
                Qt.AlignmentFlag.AlignCenter,
            )


def _shown(number: float | None) -> str:
    if number is None:
        return "failed"
    return f"{number:.4g}" if abs(number) >= _NOTHING else "0"


def _number(text: str) -> float | None:
    number = float(text) if text else math.nan
    return number if math.isfinite(number) else None

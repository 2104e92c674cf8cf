"""A picture of a study: for each figure a table of colours with its numbers, and its curves."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from bobdesk.ui.qt import application_without_screen

if TYPE_CHECKING:
    from PySide6.QtCore import QSize
    from PySide6.QtGui import QFont, QPainter

_FIGURES = ("length_percent", "drop_percent", "z_rms_m", "max_gradient")
_OVER = ("segments", "height_weight", "known")
_CHART = (760, 300)
_MARGIN = 12
_LARGEST = 16_000
_LETTERS_PX = 13


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
    from PySide6.QtCore import QRectF, QSize

    from bobdesk.track.study_pivot import curves, figures_in, labels_on
    from bobdesk.ui.plots.chart import draw_chart, size_with_legend
    from bobdesk.ui.plots.heat_map import HeatMapLayout
    from bobdesk.ui.plots.study_drawings import chart, figure_titles, heat_map
    from bobdesk.ui.theme import on_paper

    font = picture_font()
    there = figures_in(rows)
    top, wide = _MARGIN, 480
    parts: list[tuple[int, Callable[[QPainter], object]]] = []
    for figure in (each for each in _FIGURES if each in there):
        table = HeatMapLayout(
            heat_map(
                rows,
                ("plan", "segments") if len(labels_on(rows, "plan")) > 1 else ("segments",),
                ("method", "height_weight", "known"),
                figure,
                title=figure_titles()[figure],
            ),
            font,
        )
        parts.append((top, table.draw))
        top, wide = top + table.size.height() + _MARGIN, max(wide, table.size.width())
        for axis in _OVER:
            if len(curves(rows, axis, figure)[0]) < 2:
                continue
            drawn = chart(rows, axis, figure, title="")
            room = size_with_legend(drawn, font, QSize(*_CHART))
            area = QRectF(0, 0, room.width(), room.height())
            parts.append((top, partial(draw_chart, whole=area, chart=drawn)))
            top, wide = top + room.height() + _MARGIN, max(wide, room.width())
    size = QSize(min(wide + _MARGIN, _LARGEST), min(top + _MARGIN, _LARGEST))

    def draw(painter: QPainter) -> None:
        for y, part in parts:
            painter.save()
            painter.translate(0, y)
            part(painter)
            painter.restore()

    with on_paper():
        return picture_bytes(draw, size, kind)


def picture_font() -> QFont:
    """Return the font of pictures, the same at every resolution of the screen."""
    from PySide6.QtGui import QFont

    font = QFont()
    font.setPixelSize(_LETTERS_PX)
    return font


def picture_bytes(draw: Callable[[QPainter], object], size: QSize, kind: str, *, sharpness: int = 1) -> bytes:
    """Have something drawn on paper, and return the bytes of the picture.

    Parameters
    ----------
    kind
        ".png" or ".svg".
    sharpness
        Pixels of a PNG for each of the size.
    """
    from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QRect
    from PySide6.QtGui import QColor, QImage, QPainter
    from PySide6.QtSvg import QSvgGenerator

    from bobdesk.ui.theme import colours

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
        device = QImage(size * sharpness, QImage.Format.Format_RGB32)
        device.setDevicePixelRatio(sharpness)
    painter = QPainter(device)
    painter.setFont(picture_font())
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.fillRect(QRect(0, 0, size.width(), size.height()), QColor(colours().base))
    draw(painter)
    painter.end()
    if kind == ".png":
        device.save(buffer, "PNG")
    buffer.close()
    return bytes(content.data())

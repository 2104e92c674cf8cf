"""The program's own icons: one SVG each in resources/icons, recoloured to the palette."""

from __future__ import annotations

from PySide6.QtCore import QByteArray, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QGuiApplication, QIcon, QPainter, QPixmap
from PySide6.QtSvg import QSvgRenderer

from bobdesk.ui.resources import resource
from bobdesk.ui.theme import colours

_SIZES = (16, 20, 24, 32, 48)


def icon(name: str, colour: str | None = None) -> QIcon:
    """Return the icon of a file in resources/icons in the colours in force, or in one colour.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    """
    drawing = resource("icons", f"{name}.svg").read_text(encoding="utf-8")
    of = colours()
    found = QIcon()
    for ink, mode, state in (
        (colour or of.text, QIcon.Mode.Normal, QIcon.State.Off),
        (colour or of.accent, QIcon.Mode.Normal, QIcon.State.On),
        (of.border, QIcon.Mode.Disabled, QIcon.State.Off),
        (of.border, QIcon.Mode.Disabled, QIcon.State.On),
    ):
        renderer = QSvgRenderer(QByteArray(drawing.replace("currentColor", ink).encode()))
        for size in _SIZES:
            found.addPixmap(_drawn(renderer, size), mode, state)
    return found


def _drawn(renderer: QSvgRenderer, size: int) -> QPixmap:
    ratio = QGuiApplication.instance().devicePixelRatio()  # type: ignore[union-attr]
    pixmap = QPixmap(QSize(round(size * ratio), round(size * ratio)))
    pixmap.setDevicePixelRatio(ratio)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    renderer.render(painter, QRectF(0, 0, size, size))
    painter.end()
    return pixmap


def dot(colour: str) -> QPixmap:
    """Return a dot of a colour, as it stands before a name."""
    ratio = QGuiApplication.primaryScreen().devicePixelRatio()
    pixmap = QPixmap(round(12 * ratio), round(12 * ratio))
    pixmap.setDevicePixelRatio(ratio)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(colour))
    painter.drawEllipse(1, 1, 10, 10)
    painter.end()
    return pixmap

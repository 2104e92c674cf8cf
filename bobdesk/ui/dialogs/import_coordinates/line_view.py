"""The line of a file, as large as fits."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from bobdesk.arrays import FloatArray
from bobdesk.ui.line_picture import paint_line
from bobdesk.ui.theme import colours

_MARGIN = 14.0


class LineView(QWidget):
    """Draws at most a few hundred points, and a sentence while there are none."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._points: FloatArray = np.zeros((0, 2))
        self.setAccessibleName(self.tr("The line in plan"))
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def sizeHint(self) -> QSize:
        """Ask for a handy size."""
        return QSize(280, 210)

    def show_line(self, points: FloatArray | None) -> None:
        """Show points (n, 2), y up, or none."""
        self._points = np.zeros((0, 2)) if points is None else points
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw it."""
        of = colours()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setBrush(QColor(of.base))
        painter.setPen(QPen(QColor(of.border), 1))
        place = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        painter.drawRoundedRect(place, 4, 4)
        if len(self._points) < 2:
            painter.setPen(QColor(of.muted))
            painter.drawText(
                place.adjusted(12, 12, -12, -12),
                Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap,
                self.tr("The line shows here when the file can be read."),
            )
        else:
            inner = place.adjusted(_MARGIN, _MARGIN, -_MARGIN, -_MARGIN)
            for at, colour in ((0, of.start), (-1, of.finish)):
                self._mark(painter, inner, at, colour)
            paint_line(painter, inner, self._points, of.trace)
        painter.end()

    def _mark(self, painter: QPainter, inner: QRectF, at: int, colour: str) -> None:
        """Draw a round start and a square finish, so that the direction is seen."""
        low, high = self._points.min(axis=0), self._points.max(axis=0)
        size = high - low
        sides = zip((inner.width(), inner.height()), size.tolist(), strict=True)
        factor = min((side / extent for side, extent in sides if extent > 0), default=0.0)
        x, y = ((self._points[at] - (low + high) / 2) * (factor, -factor)).tolist()
        where = QPointF(inner.center().x() + x, inner.center().y() + y)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(colour))
        if at == 0:
            painter.drawEllipse(where, 5, 5)
        else:
            painter.drawRect(QRectF(where.x() - 4.5, where.y() - 4.5, 9, 9))

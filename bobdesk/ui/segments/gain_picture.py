"""The small picture of fit against number of segments, in which one sees where more stop paying."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QApplication, QSizePolicy, QToolTip, QWidget

from bobdesk.arrays import FloatArray
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.strips.contents import shade
from bobdesk.ui.strips.station_axis import ticks

_LEFT, _RIGHT, _TOP, _BOTTOM = 10.0, 10.0, 18.0, 20.0


class GainPicture(QWidget):
    """Share of the best possible fit that 1, 2, … segments reach.

    Signals
    -------
    count_chosen
        A number of segments that was clicked.
    """

    count_chosen = Signal(int)

    def __init__(self, quantities: Quantities, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._quantities = quantities
        self._shares: FloatArray = np.empty(0)
        self._count = 0
        self._hovered: int | None = None
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(self.tr("Fit against number of segments"))
        self.setToolTip(self.tr("How well so many segments fit the curvature; click to want that many"))

    @property
    def shares(self) -> FloatArray:
        """Share of the best fit, 0 to 1, for 1, 2, … segments."""
        return self._shares

    def show_gain(self, gain: FloatArray, count: int) -> None:
        """Show the gain of 1, 2, … segments, (n,), and how many there are now."""
        best = float(gain.max()) if len(gain) else 0.0
        self._shares = gain / best if best > 0 else np.zeros(len(gain))
        self._count = count
        self.setAccessibleDescription(self._sentence(count))
        self.update()

    def sizeHint(self) -> QSize:
        """Return a size at which the bend of the curve is seen."""
        return QSize(260, 92)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw the curve, the number in force and the one under the mouse."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        area = self._area()
        painter.setPen(QPen(shade("border"), 1))
        painter.setBrush(shade("base"))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), 4, 4)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        font = QApplication.font()
        font.setPointSizeF(0.88 * font.pointSizeF())
        painter.setFont(font)
        painter.setPen(shade("muted"))
        top = QRectF(_LEFT, 2, area.width(), _TOP - 2)
        shown = self._hovered or self._count
        painter.drawText(top, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, self._sentence(shown))
        if len(self._shares) < 2:
            painter.end()
            return
        for number in ticks(1, len(self._shares), 6)[0].astype(int).tolist():
            if number >= 1:
                box = QRectF(self._x(number) - 20, area.bottom() + 3, 40, _BOTTOM - 4)
                painter.drawText(box, Qt.AlignmentFlag.AlignHCenter, str(number))
        painter.setPen(QPen(shade("grid"), 1))
        painter.drawLine(area.bottomLeft(), area.bottomRight())
        points = [QPointF(self._x(number), self._y(share)) for number, share in enumerate(self._shares.tolist(), 1)]
        painter.setPen(QPen(shade("accent"), 1.6))
        painter.drawPolyline(QPolygonF(points))
        for number, colour in ((self._count, "curve"), (self._hovered, "accent")):
            if number is not None and 1 <= number <= len(points):
                painter.setPen(QPen(shade(colour), 1, Qt.PenStyle.DashLine))
                painter.drawLine(
                    QPointF(points[number - 1].x(), area.top()), QPointF(points[number - 1].x(), area.bottom())
                )
                painter.setPen(QPen(shade("base"), 1))
                painter.setBrush(shade(colour))
                painter.drawEllipse(points[number - 1], 4, 4)
                painter.setBrush(Qt.BrushStyle.NoBrush)
        if self.hasFocus():
            painter.setPen(QPen(shade("accent"), 1.5))
            painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), 4, 4)
        painter.end()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Say how good the number under the mouse is."""
        self._hover(self._number_at(event.position().x()))
        if self._hovered is not None:
            QToolTip.showText(event.globalPosition().toPoint(), self._sentence(self._hovered), self)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Wait for the release."""
        event.accept()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Want the number under the mouse."""
        number = self._number_at(event.position().x())
        if event.button() == Qt.MouseButton.LeftButton and number is not None:
            self.count_chosen.emit(number)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Choose by arrows and Enter."""
        by = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}.get(Qt.Key(event.key()))
        if by is not None and len(self._shares):
            self._hover(min(max((self._hovered or self._count) + by, 1), len(self._shares)))
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space) and self._hovered is not None:
            self.count_chosen.emit(self._hovered)
        else:
            super().keyPressEvent(event)

    def leaveEvent(self, _event: object) -> None:
        """Look at no number."""
        self._hover(None)

    def _hover(self, number: int | None) -> None:
        if number != self._hovered:
            self._hovered = number
            self.update()

    def _sentence(self, number: int) -> str:
        if not len(self._shares):
            return self.tr("fit against number of segments")
        share = float(self._shares[min(max(number, 1), len(self._shares)) - 1])
        one, more = (
            self.tr("1 segment reaches {share} % of the best fit"),
            self.tr("{count} segments reach {share} % of the best fit"),
        )
        text = one if number == 1 else more
        return text.format(count=number, share=self._quantities.number(100 * share, 1))

    def _area(self) -> QRectF:
        return QRectF(_LEFT, _TOP, max(self.width() - _LEFT - _RIGHT, 10), max(self.height() - _TOP - _BOTTOM, 10))

    def _x(self, number: int) -> float:
        area = self._area()
        return area.left() + (number - 1) / max(len(self._shares) - 1, 1) * area.width()

    def _y(self, share: float) -> float:
        area = self._area()
        return area.bottom() - share * (area.height() - 4)

    def _number_at(self, x: float) -> int | None:
        area = self._area()
        if len(self._shares) < 2:
            return None
        number = 1 + round((x - area.left()) / area.width() * (len(self._shares) - 1))
        return number if 1 <= number <= len(self._shares) else None

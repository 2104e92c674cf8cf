"""A tinted bar with an icon: a notice, what can be recovered, a conflict in a dialog."""

from __future__ import annotations

from typing import Literal

from PySide6.QtCore import QEvent, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from bobdesk.ui.icons import icon
from bobdesk.ui.notices import Weight
from bobdesk.ui.theme import colours

_ICONS: dict[Weight, Literal["info", "warning", "error"]] = {"note": "info", "warning": "warning", "error": "error"}
_ICON_SIZE = 20
_ROUND = 5.0


class Banner(QFrame):
    """Draws ground, border and icon in the colours of its weight; the `row` is filled by others."""

    def __init__(self, weight: Weight, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._weight = weight
        self._icon = QLabel(self)
        self._icon.setFixedSize(QSize(_ICON_SIZE, _ICON_SIZE))
        self._icon.setAccessibleName(self._weight_name())
        beside = QVBoxLayout()
        beside.setContentsMargins(0, 2, 0, 0)
        beside.addWidget(self._icon)
        beside.addStretch(1)
        self.row = QHBoxLayout(self)
        self.row.setContentsMargins(10, 5, 8, 5)
        self.row.setSpacing(8)
        self.row.addLayout(beside)
        self._draw_icon()

    @property
    def weight(self) -> Weight:
        """How heavy it weighs."""
        return self._weight

    def changeEvent(self, event: QEvent) -> None:
        """Follow the palette."""
        if event.type() == QEvent.Type.PaletteChange:
            self._draw_icon()
        super().changeEvent(event)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw ground and border."""
        of = colours()
        ground, line = {
            "note": (of.accent_soft, of.accent),
            "warning": (of.warning_soft, of.warning_border),
            "error": (of.error_soft, of.error),
        }[self._weight]
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setBrush(QColor(ground))
        painter.setPen(QPen(QColor(line), 1))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), _ROUND, _ROUND)
        painter.end()

    def _draw_icon(self) -> None:
        self._icon.setPixmap(icon(_ICONS[self._weight]).pixmap(_ICON_SIZE, _ICON_SIZE))
        self._icon.setAlignment(Qt.AlignmentFlag.AlignCenter)

    def _weight_name(self) -> str:
        return {"note": self.tr("Note"), "warning": self.tr("Warning"), "error": self.tr("Error")}[self._weight]

"""Text beside a label in a form: wrapped where it must be, never cut off, never squeezed to a word a line."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QLabel, QWidget

_WIDEST_IN_LETTERS = 22


class ValueLabel(QLabel):
    """Asks for the width of its text up to some words; what is longer is wrapped and gets the height for it."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWordWrap(True)
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        # A new policy would forget that wrapped text is higher where it is narrower.
        policy = self.sizePolicy()
        policy.setHorizontalPolicy(policy.Policy.Expanding)
        self.setSizePolicy(policy)

    def setText(self, text: str) -> None:
        """Show text."""
        if text != self.text():
            super().setText(text)
            self._fit(self.width())

    def minimumSizeHint(self) -> QSize:
        """Need the whole text on one line, up to a width."""
        metrics = self.fontMetrics()
        widest = metrics.averageCharWidth() * _WIDEST_IN_LETTERS
        return QSize(min(metrics.horizontalAdvance(self.text()) + 4, widest), metrics.height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Be as high as the text needs: form layouts forget it in some rows."""
        super().resizeEvent(event)
        self._fit(event.size().width())

    def _fit(self, width: int) -> None:
        height = max(0, self.heightForWidth(width))
        if height != self.minimumHeight():
            self.setMinimumHeight(height)

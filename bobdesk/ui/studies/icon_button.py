"""A button with a picture in the colours in force."""

from __future__ import annotations

from PySide6.QtCore import QEvent
from PySide6.QtWidgets import QPushButton, QWidget

from bobdesk.ui.icons import icon


class IconButton(QPushButton):
    """Says what it does in words, picture and tip.

    Parameters
    ----------
    icon_name
        Of a file in resources/icons, without ".svg"; "" for none.
    """

    def __init__(self, text: str, tip: str, icon_name: str, parent: QWidget | None = None) -> None:
        super().__init__(text, parent)
        self._icon_name = icon_name
        self.setAccessibleName(text)
        self.setAccessibleDescription(tip)
        self.setToolTip(tip)
        self._draw()

    def changeEvent(self, event: QEvent) -> None:
        """Draw the picture in the colours of another palette."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_icon_name"):
            self._draw()

    def _draw(self) -> None:
        if self._icon_name:
            self.setIcon(icon(self._icon_name))

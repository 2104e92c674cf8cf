"""A part that is folded away until it is wanted."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QSizePolicy, QToolButton, QVBoxLayout, QWidget


class Fold(QWidget):
    """A line to click, and a column below it.

    Signals
    -------
    toggled
        Whether the column is shown.
    """

    toggled = Signal(bool)

    def __init__(self, text: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.setSpacing(4)
        self._line = QToolButton(self)
        self._line.setText(text)
        self._line.setAccessibleName(text)
        self._line.setToolTip(text)
        self._line.setCheckable(True)
        self._line.setAutoRaise(True)
        self._line.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self._line.setArrowType(Qt.ArrowType.RightArrow)
        self._line.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Fixed)
        self._line.toggled.connect(self._on_toggled)
        outer.addWidget(self._line)
        self._inside = QWidget(self)
        self.column = QVBoxLayout(self._inside)
        self.column.setContentsMargins(10, 0, 0, 0)
        self.column.setSpacing(6)
        self._inside.hide()
        outer.addWidget(self._inside)

    @property
    def is_open(self) -> bool:
        """Whether the column is shown."""
        return self._line.isChecked()

    def set_open(self, on: bool) -> None:
        """Show the column or fold it away."""
        self._line.setChecked(on)

    def _on_toggled(self, on: bool) -> None:
        self._line.setArrowType(Qt.ArrowType.DownArrow if on else Qt.ArrowType.RightArrow)
        self._inside.setVisible(on)
        self.toggled.emit(on)

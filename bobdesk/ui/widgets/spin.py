"""Spin boxes that tell a number when it is whole, and leave the wheel to the panel they stand in."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QDoubleSpinBox, QSpinBox, QWidget


class Spin(QDoubleSpinBox):
    """A spin box for a real number.

    Parameters
    ----------
    name
        For screen readers.
    """

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(name)
        self.setKeyboardTracking(False)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)

    def show_value(self, value: float) -> None:
        """Show a number without telling it."""
        if abs(value - self.value()) >= 0.5 * 10.0 ** -self.decimals():
            with QSignalBlocker(self):
                self.setValue(value)

    def show_unit(self, unit: str) -> None:
        """Show a unit behind the number; what is being typed is left alone."""
        if self.suffix() != f" {unit}":
            self.setSuffix(f" {unit}")

    def show_range(self, lowest: float, highest: float) -> None:
        """Allow other numbers without telling of one."""
        with QSignalBlocker(self):
            self.setRange(lowest, highest)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Turn only while the box has the focus; else the panel scrolls."""
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()


class WholeSpin(QSpinBox):
    """A spin box for a whole number."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(name)
        self.setKeyboardTracking(False)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)

    def show_range(self, lowest: int, highest: int) -> None:
        """Allow other numbers without telling of one."""
        with QSignalBlocker(self):
            self.setRange(lowest, highest)

    def show_value(self, value: int) -> None:
        """Show a number without telling it."""
        with QSignalBlocker(self):
            self.setValue(value)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Turn only while the box has the focus; else the panel scrolls."""
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()

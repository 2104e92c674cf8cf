"""Spin boxes that tell a number when it is whole, and leave the wheel to the panel they stand in."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QSignalBlocker, Qt
from PySide6.QtGui import QValidator, QWheelEvent
from PySide6.QtWidgets import QDoubleSpinBox, QSpinBox, QToolTip, QWidget

from bobdesk.errors import InputError
from bobdesk.ui.widgets.typed_number import number_to_edit, typed_number

# What a number on its way to being typed may hold, in any country.
_SIGNS = frozenset("+-−.,'’٫٬eE")


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

    def say_what_is_wrong(self) -> bool:
        """Show beside the box why its text cannot be taken; return whether there is something."""
        return _say(self, self.tr("a number from {lowest} to {highest} is needed"))

    def validate(self, text: str, position: int) -> tuple[QValidator.State, str, int]:
        """Take what can be read as one number; Qt itself would read 12.5 as 125 where dots part thousands."""
        return _state(self, text), text, position

    def valueFromText(self, text: str) -> float:
        """Return the number in a text that was found good."""
        bare = _bare(self, text)
        return typed_number(bare) if bare else self.minimum()

    def fixup(self, _text: str) -> str:
        """Say why the number from before comes back."""
        self.say_what_is_wrong()
        return ""

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

    def validate(self, text: str, position: int) -> tuple[QValidator.State, str, int]:
        """Take what can be read as one whole number."""
        return _state(self, text), text, position

    def valueFromText(self, text: str) -> int:
        """Return the number in a text that was found good."""
        bare = _bare(self, text)
        return round(typed_number(bare)) if bare else self.minimum()

    def fixup(self, _text: str) -> str:
        """Say why the number from before comes back."""
        _say(self, self.tr("a whole number from {lowest} to {highest} is needed"))
        return ""

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Turn only while the box has the focus; else the panel scrolls."""
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()


def _bare(box: QDoubleSpinBox | QSpinBox, text: str) -> str:
    """Return a box's text without its unit; empty for the words that stand for the lowest number."""
    if text == box.specialValueText():
        return ""
    return text.strip().removeprefix(box.prefix().strip()).removesuffix(box.suffix().strip()).strip()


def _state(box: QDoubleSpinBox | QSpinBox, text: str) -> QValidator.State:
    bare = _bare(box, text)
    if not bare and box.specialValueText():
        return QValidator.State.Acceptable
    try:
        value = typed_number(bare)
    except InputError:
        typing = all(sign.isdigit() or sign.isspace() or sign in _SIGNS for sign in bare)
        return QValidator.State.Intermediate if typing else QValidator.State.Invalid
    # Half a digit that is not shown is no reason to refuse the bound itself.
    near = 0.5 * 10.0 ** -box.decimals() if isinstance(box, QDoubleSpinBox) else 0.0
    fits = box.minimum() - near <= value <= box.maximum() + near
    if isinstance(box, QSpinBox):
        fits = fits and value == round(value)
    return QValidator.State.Acceptable if fits else QValidator.State.Intermediate


def _say(box: QDoubleSpinBox | QSpinBox, needed: str) -> bool:
    bare = _bare(box, box.text())
    if _state(box, box.text()) == QValidator.State.Acceptable:
        return False
    sentence = needed.format(lowest=number_to_edit(box.minimum(), 12), highest=number_to_edit(box.maximum(), 12))
    try:
        typed_number(bare)
    except InputError as error:
        sentence = str(error)
    if box.isVisible():
        QToolTip.showText(box.mapToGlobal(QPoint(0, box.height())), sentence, box)
    return True

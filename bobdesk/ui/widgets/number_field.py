"""A field for one number of any size, in the user's units."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QLineEdit, QWidget

from bobdesk.errors import InputError
from bobdesk.ui.widgets.typed_number import number_to_edit, typed_number


class NumberField(QLineEdit):
    """Tells a number once it is typed in whole; what is no number is told, and the old one comes back.

    Parameters
    ----------
    refuse
        Takes the sentence about what was typed.

    Signals
    -------
    entered
        Another number than before, in the unit in which it is shown.
    """

    entered = Signal(object)

    def __init__(self, name: str, refuse: Callable[[str], object], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._refuse = refuse
        self._value: float | None = None
        self.setAccessibleName(name)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.editingFinished.connect(self._on_finished)

    @property
    def value(self) -> float | None:
        """The number shown, None if there is none."""
        return self._value

    def show_value(self, value: float | None, *, digits: int = 10) -> None:
        """Show a number with so many digits that count; what is being typed is left alone."""
        self._value = value
        if not (self.hasFocus() and (self.isModified() or self._says(value))):
            self.setText(number_to_edit(value, digits))
            self.setModified(False)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Bring the old number back with Esc."""
        if event.key() == Qt.Key.Key_Escape and self.isModified():
            self._restore()
            return
        super().keyPressEvent(event)

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Select all, to be typed over."""
        super().focusInEvent(event)
        if event.reason() != Qt.FocusReason.MouseFocusReason:
            self.selectAll()

    def changeEvent(self, event: QEvent) -> None:
        """Follow the signs of another country."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.LocaleChange:
            self.show_value(self._value)

    def _says(self, value: float | None) -> bool:
        """Return whether the text already means a number, in whatever way it was typed."""
        try:
            return bool(self.text().strip()) and typed_number(self.text()) == value
        except InputError:
            return False

    def _restore(self) -> None:
        self.setText(number_to_edit(self._value))
        self.setModified(False)

    def _on_finished(self) -> None:
        if not self.isModified():
            return
        self.setModified(False)
        text = self.text()
        if not text.strip():
            self._restore()
            return
        try:
            value = typed_number(text)
        except InputError as error:
            self._restore()
            self._refuse(str(error))
            return
        if value != self._value:
            self.entered.emit(value)
        self._restore()

"""A field for a figure that may be unknown: it tells a number while one types."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QLineEdit, QWidget

from bobdesk.errors import InputError
from bobdesk.ui.widgets.typed_number import number_to_edit, typed_number

_REST_MS = 250


class TargetField(QLineEdit):
    """A number, or nothing.

    Parameters
    ----------
    refuse
        Takes the sentence about text that is no number, once the field is left.

    Signals
    -------
    entered
        Another number than before (float), or None for an empty field; shortly after the last key.
    """

    entered = Signal(object)

    def __init__(self, name: str, refuse: Callable[[str], object], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._refuse = refuse
        self._value: float | None = None
        self.setAccessibleName(name)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.setPlaceholderText(self.tr("unknown"))
        self._rest = QTimer(self)
        self._rest.setSingleShot(True)
        self._rest.setInterval(_REST_MS)
        self._rest.timeout.connect(self._try)
        self.textEdited.connect(lambda _text: self._rest.start())
        self.editingFinished.connect(self._on_finished)

    def show_value(self, value: float | None, *, digits: int = 10) -> None:
        """Show a number; what is being typed is left alone."""
        self._value = value
        if not (self.hasFocus() and self.isModified()):
            self.setText(number_to_edit(value, digits))
            self.setModified(False)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Leave the number that was told last with Esc."""
        if event.key() == Qt.Key.Key_Escape and self.isModified():
            self._rest.stop()
            self._restore()
            return
        super().keyPressEvent(event)

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Select all, to be typed over."""
        super().focusInEvent(event)
        if event.reason() != Qt.FocusReason.MouseFocusReason:
            self.selectAll()

    def _read(self) -> float | None:
        return typed_number(self.text()) if self.text().strip() else None

    def _try(self) -> None:
        try:
            value = self._read()
        except InputError:
            return
        if value != self._value:
            self._value = value
            self.entered.emit(value)

    def _on_finished(self) -> None:
        self._rest.stop()
        if not self.isModified():
            return
        try:
            self._read()
        except InputError as error:
            self._restore()
            self._refuse(str(error))
            return
        self._try()
        self._restore()

    def _restore(self) -> None:
        self.setText(number_to_edit(self._value))
        self.setModified(False)

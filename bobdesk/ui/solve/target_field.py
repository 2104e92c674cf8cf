"""A field for a figure that may be unknown: it tells a number while one types."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QWidget

from bobdesk.errors import InputError
from bobdesk.ui.widgets.number_field import NumberField
from bobdesk.ui.widgets.typed_number import typed_number

_REST_MS = 250


class TargetField(NumberField):
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

    def __init__(self, name: str, refuse: Callable[[str], object], parent: QWidget | None = None) -> None:
        super().__init__(name, refuse, parent)
        self.setPlaceholderText(self.tr("unknown"))
        self._rest = QTimer(self)
        self._rest.setSingleShot(True)
        self._rest.setInterval(_REST_MS)
        self._rest.timeout.connect(self._try)
        self._is_edited = False
        self.textEdited.connect(self._on_edited)

    def _on_edited(self) -> None:
        self._is_edited = True
        self._rest.start()

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
            # Taken: from here on Undo means the document, and what it shows comes into the field.
            self.setModified(False)

    def _on_finished(self) -> None:
        self._rest.stop()
        if not self._is_edited:
            return
        self._is_edited = False
        try:
            self._read()
        except InputError as error:
            self._restore()
            self._refuse(str(error))
            return
        self._try()
        self._restore()

    def _restore(self) -> None:
        self._rest.stop()
        super()._restore()

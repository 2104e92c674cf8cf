"""What Undo and Redo mean while the keyboard is in a field: one rule for every field of the window.

Text that the document has not taken yet is taken back letter by letter; everything else is a step of the
document. A field whose text is taken with every letter (property `takes_each_letter`) has no text of its own.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from PySide6.QtCore import QEvent, QObject, SignalInstance, Slot
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QAbstractSpinBox, QApplication, QComboBox, QLineEdit, QPlainTextEdit, QTextEdit, QWidget
from shiboken6 import isValid

from bobdesk.ui.widgets.number_field import NumberField

TAKES_EACH_LETTER = "takes_each_letter"


class TypingUndo(QObject):
    """Follows the keyboard from field to field of one window.

    Fields of Qt keep the keys of Undo for themselves, whether they have something to take back or not; here
    they reach the window's actions, which ask `undo` and `redo` first.

    Parameters
    ----------
    keys
        Returns the keys of Undo, and those of Redo.
    windows
        Returns the keys that are the window's in a field, too: on some systems Ctrl+E leads to a field's end.
    """

    def __init__(
        self,
        window: QWidget,
        keys: Callable[[], tuple[Iterable[QKeySequence], Iterable[QKeySequence]]],
        windows: Callable[[], Iterable[QKeySequence]] = tuple,
    ) -> None:
        super().__init__(window)
        self._window = window
        self._keys = keys
        self._windows = windows
        self._field: QWidget | None = None
        self._line: QLineEdit | None = None
        self._is_typing = False
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        application.focusChanged.connect(self._on_focus)

    @property
    def is_typing(self) -> bool:
        """Whether a field holds text that the document has not taken."""
        return self._is_typing and self._line is not None and isValid(self._line)

    def undo(self) -> bool:
        """Take back what is being typed; return whether there was something."""
        if self.is_typing and self._line is not None and self._line.isUndoAvailable() and self._line.isModified():
            self._line.undo()
            return True
        self._is_typing = False
        return False

    def redo(self) -> bool:
        """Type again what was taken back; return whether there was something."""
        if self.is_typing and self._line is not None and self._line.isRedoAvailable():
            self._line.redo()
            return True
        return False

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        """Leave the keys of Undo and Redo to the window's actions."""
        if event.type() not in (QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress) or not isinstance(event, QKeyEvent):
            return False
        pressed = QKeySequence(event.keyCombination())
        if event.type() == QEvent.Type.ShortcutOverride and pressed in self._windows():
            event.ignore()
            return True
        undo_keys, redo_keys = self._keys()
        is_undo, is_redo = pressed in undo_keys, pressed in redo_keys
        if not (is_undo or is_redo):
            return False
        if event.type() == QEvent.Type.ShortcutOverride:
            event.ignore()
        elif is_undo:
            # The action has not taken the key, so the document has nothing to undo; what is typed still has.
            self.undo()
        else:
            self.redo()
        return True

    @Slot(QWidget, QWidget)
    def _on_focus(self, _before: QWidget | None, field: QWidget | None) -> None:
        self._let_go()
        if field is None or field.window() is not self._window or not _is_typed_into(field):
            return
        self._field = field
        field.installEventFilter(self)
        self._line = None if field.property(TAKES_EACH_LETTER) else _line_of(field)
        if self._line is not None:
            self._is_typing = self._line.isModified() and isinstance(field, QLineEdit)
            self._line.textEdited.connect(self._on_edited)
            for taken in _taken(field):
                taken.connect(self._on_taken)

    def _let_go(self) -> None:
        field, line = self._field, self._line
        self._field, self._line, self._is_typing = None, None, False
        if field is not None and isValid(field):
            field.removeEventFilter(self)
            if line is not None and isValid(line):
                line.textEdited.disconnect(self._on_edited)
                for taken in _taken(field):
                    taken.disconnect(self._on_taken)

    @Slot(str)
    def _on_edited(self, _text: str) -> None:
        self._is_typing = True

    @Slot()
    def _on_taken(self) -> None:
        self._is_typing = False


def text_field() -> QLineEdit | QPlainTextEdit | QTextEdit | None:
    """Return the field that the keyboard is in, if text can be typed there."""
    focus = QApplication.focusWidget()
    if focus is None or not _is_typed_into(focus):
        return None
    return focus if isinstance(focus, (QPlainTextEdit, QTextEdit)) else _line_of(focus)


def _taken(field: QWidget) -> tuple[SignalInstance, ...]:
    """Return the signals of a field that say that its text was taken."""
    if isinstance(field, NumberField):
        return field.editingFinished, field.entered
    if isinstance(field, (QLineEdit, QAbstractSpinBox)):
        return (field.editingFinished,)
    line = _line_of(field)
    return () if line is None else (line.editingFinished,)


def _is_typed_into(field: QWidget) -> bool:
    if isinstance(field, (QPlainTextEdit, QTextEdit)):
        return not field.isReadOnly()
    line = _line_of(field)
    return line is not None and not line.isReadOnly()


def _line_of(field: QWidget) -> QLineEdit | None:
    if isinstance(field, QLineEdit):
        return field
    return field.lineEdit() if isinstance(field, (QAbstractSpinBox, QComboBox)) else None

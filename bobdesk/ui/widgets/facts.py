"""Rows of a name and a value in two columns; both wrap, and no text is ever cut off."""

from __future__ import annotations

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtWidgets import QLabel, QLayoutItem, QSizePolicy, QWidget

from bobdesk.ui.widgets.items_layout import ItemsLayout

_GAP, _ROW_GAP = 12, 5
_NAMES_SHARE = 0.45
_NARROWEST = 160


class Facts(QWidget):
    """A table of facts about something, to be read and copied."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._pairs = _PairsLayout(self)
        self._names: dict[QLabel, QLabel] = {}
        policy = QSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)

    def add(self, text: str) -> QLabel:
        """Add a row and return the label of its value."""
        name, value = QLabel(text, self), QLabel(self)
        name.setProperty("kind", "muted")
        value.setAccessibleName(text)
        value.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        for label in (name, value):
            label.setWordWrap(True)
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop)
            self._pairs.addWidget(label)
        self._names[value] = name
        return value

    def show_row(self, value: QLabel, shown: bool) -> None:
        """Show or hide the row of a value."""
        self._names[value].setVisible(shown)
        value.setVisible(shown)


class _PairsLayout(ItemsLayout):
    def expandingDirections(self) -> Qt.Orientation:
        return Qt.Orientation.Horizontal

    def sizeHint(self) -> QSize:
        return QSize(_NARROWEST, self.heightForWidth(_NARROWEST))

    def minimumSize(self) -> QSize:
        return QSize(_NARROWEST, 0)

    def placed(self, rect: QRect, *, move: bool) -> int:
        rows = [
            (name, value)
            for name, value in zip(self._items[::2], self._items[1::2], strict=False)
            if not value.isEmpty()
        ]
        names = max((_one_line(name) for name, _ in rows), default=0)
        names = min(names, int(_NAMES_SHARE * rect.width()))
        x, values = rect.x() + names + _GAP, max(1, rect.width() - names - _GAP)
        y = rect.y()
        for name, value in rows:
            height = max(name.heightForWidth(names), value.heightForWidth(values))
            if move:
                name.setGeometry(QRect(rect.x(), y, names, height))
                value.setGeometry(QRect(x, y, values, height))
            y += height + _ROW_GAP
        return max(0, y - _ROW_GAP - rect.y())


def _one_line(item: QLayoutItem) -> int:
    label = item.widget()
    return label.fontMetrics().horizontalAdvance(label.text()) + 2 if isinstance(label, QLabel) else 0

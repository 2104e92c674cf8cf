"""The command palette: every action by a few typed letters."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import (
    QAbstractListModel,
    QByteArray,
    QEvent,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QRect,
    QSize,
    Qt,
)
from PySide6.QtGui import QColor, QFont, QIcon, QKeyEvent, QKeySequence, QPainter
from PySide6.QtWidgets import (
    QDialog,
    QLabel,
    QLineEdit,
    QListView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QVBoxLayout,
    QWidget,
)

from bobdesk.ui.actions.action import Action
from bobdesk.ui.actions.action_set import ActionSet
from bobdesk.ui.dialogs.fuzzy import fuzzy_score
from bobdesk.ui.dialogs.menu_names import MenuNames
from bobdesk.ui.settings import Settings
from bobdesk.ui.theme import colours

PALETTE_ACTION = "command-palette"
_RECENT = "palette-recent"
_MOST_RECENT = 8
_RECENT_BONUS = 4.0
_NOT_NOW = 2.0  # of equals, what can be done comes first
_WIDTH = 600
_HEIGHT = 420
_ROW_PADDING = 14
_Index = QModelIndex | QPersistentModelIndex


class _Rows(QAbstractListModel):
    """The actions that answer, best first."""

    def __init__(self, actions: ActionSet, parent: QObject) -> None:
        super().__init__(parent)
        self._actions = actions
        self._menus = MenuNames(self)
        self.rows: list[Action] = []

    def show_rows(self, rows: list[Action]) -> None:
        self.beginResetModel()
        self.rows = rows
        self.endResetModel()

    def rowCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008 - Qt's own signature
        return 0 if parent.isValid() else len(self.rows)

    def data(self, index: _Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        row = self.rows[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return row.plain_text
        if role == Qt.ItemDataRole.DecorationRole:
            return self._actions[row.name].icon()
        if role == Qt.ItemDataRole.ToolTipRole:
            return row.tip or row.plain_text
        if role == Qt.ItemDataRole.AccessibleTextRole:
            parts = (row.plain_text, self.menu_of(row), self.key_of(row), "" if self.can(row) else self.tr("not now"))
            return ", ".join(part for part in parts if part)
        return None

    def menu_of(self, row: Action) -> str:
        return self._menus.text(row.menu)

    def key_of(self, row: Action) -> str:
        keys = self._actions.keys_of(row)
        return _native(keys[0]) if keys else ""

    def can(self, row: Action) -> bool:
        return self._actions[row.name].isEnabled()


class _Delegate(QStyledItemDelegate):
    """Draws icon and name at the left, menu and key at the right."""

    def __init__(self, model: _Rows, parent: QObject) -> None:
        super().__init__(parent)
        self._model = model

    def sizeHint(self, option: QStyleOptionViewItem, _index: _Index) -> QSize:
        return QSize(200, option.fontMetrics.height() + _ROW_PADDING)

    def paint(self, painter: QPainter, option: Any, index: _Index) -> None:
        of = colours()
        row = self._model.rows[index.row()]
        can = self._model.can(row)
        place: QRect = option.rect
        is_selected = bool(option.state & QStyle.StateFlag.State_Selected)
        painter.save()
        if is_selected:
            painter.fillRect(place, QColor(of.accent_soft))
            painter.fillRect(QRect(place.left(), place.top(), 3, place.height()), QColor(of.accent))
        inner = place.adjusted(14, 0, -14, 0)
        drawing = self._model.data(index, Qt.ItemDataRole.DecorationRole)
        mode = QIcon.Mode.Normal if can else QIcon.Mode.Disabled
        drawing.paint(painter, QRect(inner.left(), inner.center().y() - 8, 18, 18), mode=mode)
        inner.setLeft(inner.left() + 30)
        middle = Qt.AlignmentFlag.AlignVCenter
        small = QFont(option.font)
        small.setPointSizeF(small.pointSizeF() * 0.92)
        painter.setFont(small)
        painter.setPen(QColor(of.muted))
        key = self._model.key_of(row)
        painter.drawText(inner, middle | Qt.AlignmentFlag.AlignRight, key)
        inner.setRight(inner.right() - 120)
        menu = self._model.menu_of(row) if can else self.tr("{menu} · not now").format(menu=self._model.menu_of(row))
        painter.drawText(inner, middle | Qt.AlignmentFlag.AlignRight, menu)
        inner.setRight(inner.right() - painter.fontMetrics().horizontalAdvance(menu) - 12)
        painter.setFont(option.font)
        painter.setPen(QColor(of.text if can else of.muted))
        name = painter.fontMetrics().elidedText(row.plain_text, Qt.TextElideMode.ElideRight, inner.width())
        painter.drawText(inner, middle | Qt.AlignmentFlag.AlignLeft, name)
        painter.restore()


class CommandPalette(QDialog):
    """Type, choose with the arrows, Enter; what was used lately comes first, what is not possible now is grey."""

    def __init__(self, actions: ActionSet, settings: Settings, parent: QWidget | None = None) -> None:
        super().__init__(parent, Qt.WindowType.Dialog | Qt.WindowType.FramelessWindowHint)
        self.setObjectName("command-palette")
        self.setWindowTitle(self.tr("Command palette"))
        self.setModal(True)
        self._actions, self._settings = actions, settings
        actions.refresh()
        self.field = QLineEdit()
        self.field.setPlaceholderText(self.tr("What do you want to do?"))
        self.field.setAccessibleName(self.tr("Command"))
        self.field.setToolTip(self.tr("A few letters of an action's name"))
        self.field.setClearButtonEnabled(True)
        self.field.installEventFilter(self)
        font = self.field.font()
        font.setPointSizeF(font.pointSizeF() * 1.15)
        self.field.setFont(font)
        self.field.setTextMargins(6, 4, 6, 4)
        self._model = _Rows(actions, self)
        self.list = QListView()
        self.list.setModel(self._model)
        self.list.setItemDelegate(_Delegate(self._model, self))
        self.list.setAccessibleName(self.tr("Actions"))
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.list.setUniformItemSizes(True)
        self.list.setFrameShape(QListView.Shape.NoFrame)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._nothing = QLabel(self.tr("No action is called like this."))
        self._nothing.setProperty("kind", "muted")
        self._nothing.setAlignment(Qt.AlignmentFlag.AlignCenter)
        column = QVBoxLayout(self)
        column.setContentsMargins(9, 9, 9, 9)
        column.addWidget(self.field)
        column.addWidget(self.list, 1)
        column.addWidget(self._nothing, 1)
        self.resize(_WIDTH, _HEIGHT)
        self.field.textChanged.connect(self._search)
        self.list.clicked.connect(lambda _index: self._run())
        self._search("")
        self._place()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Let the arrows move in the list while the field has the keyboard."""
        if watched is self.field and isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
                self._run()
                return True
            steps = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1, Qt.Key.Key_PageUp: -8, Qt.Key.Key_PageDown: 8}
            if event.key() in steps:
                self._step(steps[Qt.Key(event.key())])
                return True
        return super().eventFilter(watched, event)

    def paintEvent(self, _event: object) -> None:
        """Draw a border: the window has none of its own."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(colours().panel))
        painter.setPen(QColor(colours().border))
        painter.drawRect(self.rect().adjusted(0, 0, -1, -1))
        painter.end()

    @property
    def shown(self) -> tuple[str, ...]:
        """Names of the actions that are listed, first the best."""
        return tuple(row.name for row in self._model.rows)

    def _search(self, typed: str) -> None:
        recent = self._recent()
        found: list[tuple[float, int, Action]] = []
        for order, row in enumerate(self._actions.table):
            if row.name == PALETTE_ACTION:
                continue
            score = fuzzy_score(typed, row.plain_text)
            if score is None:
                beside = fuzzy_score(typed, f"{self._model.menu_of(row)} {row.plain_text} {row.tip}")
                score = None if beside is None or len(typed) < 3 else beside - 30.0
            if score is None:
                continue
            if not self._model.can(row):
                score -= _NOT_NOW
            if row.name in recent:
                score += _RECENT_BONUS * (1 + (_MOST_RECENT - recent.index(row.name)) / _MOST_RECENT)
            found.append((-score, order, row))
        self._model.show_rows([row for _score, _order, row in sorted(found, key=lambda one: one[:2])])
        self.list.setVisible(bool(found))
        self._nothing.setVisible(not found)
        if found:
            self.list.setCurrentIndex(self._model.index(0))

    def _step(self, by: int) -> None:
        count = self._model.rowCount()
        if count:
            at = self.list.currentIndex().row() + by
            at = at % count if abs(by) == 1 else max(0, min(count - 1, at))
            self.list.setCurrentIndex(self._model.index(at))

    def _run(self) -> None:
        index = self.list.currentIndex()
        if not index.isValid() or index.row() >= len(self._model.rows):
            return
        row = self._model.rows[index.row()]
        if not self._model.can(row):
            return
        names = [row.name, *(name for name in self._recent() if name != row.name)][:_MOST_RECENT]
        self._settings.set_bytes(_RECENT, QByteArray("\n".join(names).encode()))
        self.accept()
        self._actions[row.name].trigger()

    def _recent(self) -> list[str]:
        text = bytes(self._settings.bytes_of(_RECENT).data()).decode(errors="replace")
        return text.split("\n") if text else []

    def _place(self) -> None:
        """Stand at the top of the window that it was called from."""
        parent = self.parentWidget()
        if parent is not None:
            window = parent.window()
            self.resize(min(_WIDTH, window.width()), min(_HEIGHT, window.height()))
            self.move(window.mapToGlobal(window.rect().center()).x() - self.width() // 2, window.y() + 90)


def _native(key: str) -> str:
    sequence = QKeySequence(key, QKeySequence.SequenceFormat.PortableText)
    return sequence.toString(QKeySequence.SequenceFormat.NativeText)

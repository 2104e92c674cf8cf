"""The shortcut sheet: every action with its key, by menu; keys are changed in place."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QFont, QKeyEvent, QKeySequence
from PySide6.QtWidgets import (
    QAbstractItemView,
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QHeaderView,
    QKeySequenceEdit,
    QLabel,
    QLineEdit,
    QPushButton,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from bobdesk.ui.actions.action import Action
from bobdesk.ui.actions.action_set import ActionSet
from bobdesk.ui.banner import Banner
from bobdesk.ui.dialogs.menu_names import MenuNames
from bobdesk.ui.dialogs.shortcut_changes import conflict, give, give_all_usual, give_usual, native
from bobdesk.ui.settings import Settings

_NAME = Qt.ItemDataRole.UserRole


class KeyField(QKeySequenceEdit):
    """Takes one key with its modifiers; Esc goes away without a change.

    Signals
    -------
    given_up
        Esc, or the keyboard went elsewhere.
    """

    given_up = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMaximumSequenceLength(1)

    def event(self, event: QEvent) -> bool:
        """Take Esc before it becomes the key."""
        if isinstance(event, QKeyEvent) and event.type() in (QEvent.Type.KeyPress, QEvent.Type.ShortcutOverride):
            is_esc = event.key() == Qt.Key.Key_Escape and event.modifiers() == Qt.KeyboardModifier.NoModifier
            if is_esc:
                event.accept()
                if event.type() == QEvent.Type.KeyPress:
                    self.given_up.emit()
                return True
        return super().event(event)


class ShortcutSheet(QDialog):
    """A tree of menus and their actions, made from the table of actions."""

    def __init__(self, actions: ActionSet, settings: Settings, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("shortcuts")
        self.setWindowTitle(self.tr("Keyboard shortcuts"))
        self._actions, self._settings = actions, settings
        self._items: dict[str, QTreeWidgetItem] = {}
        self._field: KeyField | None = None
        self._offered: tuple[Action, str] | None = None
        self._make_search()
        self._make_tree()
        self._make_conflict()
        self._make_buttons()
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 14, 16, 14)
        column.setSpacing(10)
        column.addWidget(self.search)
        column.addWidget(self.tree, 1)
        column.addWidget(self._banner)
        column.addLayout(self._row)
        self.resize(640, 620)
        settings.changed.connect(self._on_setting)
        self._fill()

    def item(self, name: str) -> QTreeWidgetItem:
        """Return the line of an action."""
        return self._items[name]

    def edit(self, name: str) -> KeyField:
        """Have the key of an action typed in its place."""
        self._end_edit()
        item = self._items[name]
        self.tree.setCurrentItem(item)
        self.tree.scrollToItem(item)
        field = KeyField()
        row = self._actions.row_of(name)
        keys = self._actions.keys_of(row)
        if keys:
            field.setKeySequence(QKeySequence(keys[0], QKeySequence.SequenceFormat.PortableText))
        field.setAccessibleName(self.tr("Key for {action}").format(action=row.plain_text))
        field.setToolTip(self.tr("Press the key; Esc leaves it as it is"))
        field.editingFinished.connect(lambda: self._typed(name, field))
        field.given_up.connect(self._give_up)
        self._field = field
        self.tree.setItemWidget(item, 1, field)
        field.setFocus()
        return field

    def offer(self, name: str, key: str) -> None:
        """Give a key, or ask first if another action has it."""
        row = self._actions.row_of(name)
        other = conflict(self._actions, row, key)
        if other is None:
            give(self._actions, self._settings, row, key)
            return
        self._offered = (row, key)
        sentence = self.tr("{key} is the key of “{other}”. Give it to “{action}” instead?")
        self._question.setText(sentence.format(key=native(key), other=other.plain_text, action=row.plain_text))
        self._banner.show()
        self._take.setFocus()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Enter and F2 on a line change its key, Delete takes it away."""
        if watched is self.tree and isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            name = self._current()
            if name is not None and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_F2):
                self.edit(name)
                return True
            if name is not None and event.key() == Qt.Key.Key_Delete:
                self._remove()
                return True
        return super().eventFilter(watched, event)

    def _make_search(self) -> None:
        self.search = QLineEdit()
        self.search.setPlaceholderText(self.tr("Search by name or key"))
        self.search.setAccessibleName(self.tr("Search"))
        self.search.setToolTip(self.tr("Part of a name, or a key such as Ctrl+S"))
        self.search.setClearButtonEnabled(True)
        self.search.textChanged.connect(self._filter)

    def _make_tree(self) -> None:
        self.tree = QTreeWidget()
        self.tree.setColumnCount(2)
        self.tree.setHeaderLabels([self.tr("Action"), self.tr("Key")])
        self.tree.setAccessibleName(self.tr("Actions and their keys"))
        self.tree.setToolTip(self.tr("Double-click an action, or press Enter on it, to change its key"))
        self.tree.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.tree.setExpandsOnDoubleClick(False)
        self.tree.setStyleSheet("QTreeView::item { padding: 3px 0; }")
        self.tree.header().setStretchLastSection(False)
        self.tree.header().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        self.tree.header().resizeSection(1, 190)
        self.tree.installEventFilter(self)
        self.tree.itemDoubleClicked.connect(self._on_double_click)
        self.tree.currentItemChanged.connect(lambda _now, _before: self._refresh_buttons())

    def _make_conflict(self) -> None:
        self._banner = Banner("warning")
        self._question = QLabel()
        self._question.setWordWrap(True)
        self._question.setTextFormat(Qt.TextFormat.PlainText)
        self._take = self._button(self.tr("Give it"), self.tr("Take the key from the other action"), self._take_over)
        keep = self._button(self.tr("Leave it"), self.tr("Change nothing"), self._leave)
        self._banner.row.addWidget(self._question, 1)
        self._banner.row.addWidget(self._take)
        self._banner.row.addWidget(keep)
        self._banner.hide()

    def _make_buttons(self) -> None:
        self.change_button = self._button(
            self.tr("Change key"), self.tr("Type another key for this action (Enter)"), self._change
        )
        self.remove_button = self._button(
            self.tr("Remove key"), self.tr("Have no key for this action (Delete)"), self._remove
        )
        self.usual_button = self._button(
            self.tr("Usual key"), self.tr("Give this action the key that it came with"), self._usual
        )
        self.all_button = self._button(
            self.tr("All usual keys"), self.tr("Give every action the key that it came with"), self._all_usual
        )
        close = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        close.rejected.connect(self.reject)
        self._row = QHBoxLayout()
        for button in (self.change_button, self.remove_button, self.usual_button, self.all_button):
            self._row.addWidget(button)
        self._row.addStretch(1)
        self._row.addWidget(close)

    def _button(self, text: str, tip: str, do: object) -> QPushButton:
        button = QPushButton(text)
        button.setToolTip(tip)
        button.setAutoDefault(False)
        button.clicked.connect(do)
        return button

    def _fill(self) -> None:
        menus = MenuNames(self)
        groups: dict[str, QTreeWidgetItem] = {}
        for row in self._actions.table:
            if row.menu not in groups:
                group = QTreeWidgetItem(self.tree, [menus.text(row.menu)])
                group.setFlags(Qt.ItemFlag.ItemIsEnabled)
                group.setFirstColumnSpanned(True)
                font = QFont(self.tree.font())
                font.setBold(True)
                group.setFont(0, font)
                groups[row.menu] = group
            item = QTreeWidgetItem(groups[row.menu], [row.plain_text])
            item.setIcon(0, self._actions[row.name].icon())
            item.setData(0, _NAME, row.name)
            item.setToolTip(0, row.tip or row.plain_text)
            self._items[row.name] = item
        for group in groups.values():
            group.setExpanded(True)
        self._show_keys()
        self._refresh_buttons()

    def _show_keys(self) -> None:
        for row in self._actions.table:
            item = self._items[row.name]
            keys = "   ".join(native(key) for key in self._actions.keys_of(row))
            item.setText(1, keys)
            own = self._settings.key_of(row.name) is not None
            font = QFont(self.tree.font())
            font.setBold(own)
            item.setFont(1, font)
            where = self.tr("Acts while the plan has the keyboard. ") if row.scope == "canvas" else ""
            usual = ", ".join(native(key) for key in row.keys) or self.tr("none")
            changed = self.tr("Changed by you; usual key: {key}.").format(key=usual) if own else ""
            item.setToolTip(1, (where + changed).strip())

    def _filter(self, typed: str) -> None:
        wanted = typed.casefold().split()
        for at in range(self.tree.topLevelItemCount()):
            group = self.tree.topLevelItem(at)
            assert group is not None
            any_shown = False
            for index in range(group.childCount()):
                item = group.child(index)
                assert item is not None
                text = f"{group.text(0)} {item.text(0)} {item.text(1)}".casefold()
                shown = all(word in text for word in wanted)
                item.setHidden(not shown)
                any_shown = any_shown or shown
            group.setHidden(not any_shown)

    def _current(self) -> str | None:
        item = self.tree.currentItem()
        name = None if item is None else item.data(0, _NAME)
        return name if isinstance(name, str) else None

    def _refresh_buttons(self) -> None:
        name = self._current()
        self.change_button.setEnabled(name is not None)
        self.remove_button.setEnabled(name is not None and bool(self._items[name].text(1)))
        self.usual_button.setEnabled(name is not None and self._settings.key_of(name) is not None)
        self.all_button.setEnabled(any(self._settings.key_of(row.name) is not None for row in self._actions.table))

    def _on_double_click(self, item: QTreeWidgetItem) -> None:
        name = item.data(0, _NAME)
        if isinstance(name, str):
            self.edit(name)

    def _typed(self, name: str, field: KeyField) -> None:
        if field is not self._field:
            return
        key = field.keySequence().toString(QKeySequence.SequenceFormat.PortableText)
        self._end_edit()
        if key and key not in self._actions.keys_of(self._actions.row_of(name)):
            self.offer(name, key)

    def _give_up(self) -> None:
        self._end_edit()
        self.tree.setFocus()

    def _end_edit(self) -> None:
        field, self._field = self._field, None
        self._leave()
        if field is not None:
            for item in self._items.values():
                if self.tree.itemWidget(item, 1) is field:
                    self.tree.removeItemWidget(item, 1)

    def _change(self) -> None:
        name = self._current()
        if name is not None:
            self.edit(name)

    def _remove(self) -> None:
        name = self._current()
        if name is not None:
            give(self._actions, self._settings, self._actions.row_of(name), "")

    def _usual(self) -> None:
        name = self._current()
        if name is not None:
            give_usual(self._actions, self._settings, self._actions.row_of(name))

    def _all_usual(self) -> None:
        give_all_usual(self._actions, self._settings)

    def _take_over(self) -> None:
        offered = self._offered
        self._leave()
        if offered is not None:
            give(self._actions, self._settings, *offered)

    def _leave(self) -> None:
        self._offered = None
        self._banner.hide()

    def _on_setting(self, name: str) -> None:
        if name.startswith("keys/"):
            self._show_keys()
            self._filter(self.search.text())
            self._refresh_buttons()

"""The actions of a window as Qt has them: made from the table once, kept up to date, with the user's keys."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMenu, QMenuBar, QWidget

from bobdesk.ui.actions.action import Action, MenuName, Role
from bobdesk.ui.icons import icon
from bobdesk.ui.settings import Settings

# Told of every action: Qt would guess from the English words of a text, and take "Settings of …" for the preferences.
_ROLES: dict[Role, QAction.MenuRole] = {
    "none": QAction.MenuRole.NoRole,
    "about": QAction.MenuRole.AboutRole,
    "preferences": QAction.MenuRole.PreferencesRole,
    "quit": QAction.MenuRole.QuitRole,
    "of the program": QAction.MenuRole.ApplicationSpecificRole,
}


class ActionSet(QObject):
    """QActions by name.

    Parameters
    ----------
    window, canvas
        Where the keys act.
    """

    def __init__(self, table: Iterable[Action], settings: Settings, window: QWidget, canvas: QWidget) -> None:
        super().__init__(window)
        self.table = tuple(table)
        self._settings = settings
        self._made: dict[str, QAction] = {}
        self._menus: dict[MenuName, QMenu] = {}
        for row in self.table:
            if row.name in self._made:
                raise ValueError(f"two actions are called {row.name}")
            self._made[row.name] = self._make(row, window, canvas)
        self.refresh_keys()
        self.refresh_icons()
        settings.changed.connect(self._on_setting)

    def __getitem__(self, name: str) -> QAction:
        """Return an action by its name."""
        return self._made[name]

    def refresh(self) -> None:
        """Ask every row whether it can be done and is checked now."""
        for row in self.table:
            made = self._made[row.name]
            made.setEnabled(row.enabled())
            if row.checked is not None:
                made.setChecked(row.checked())

    def refresh_icons(self) -> None:
        """Draw the icons in the colours of the palette, anew after it has changed."""
        for row in self.table:
            if row.icon:
                self._made[row.name].setIcon(icon(row.icon))

    def refresh_keys(self) -> None:
        """Give every action its keys."""
        for row in self.table:
            made = self._made[row.name]
            keys = self.keys_of(row)
            made.setShortcuts([QKeySequence(key, QKeySequence.SequenceFormat.PortableText) for key in keys])
            first = made.shortcut().toString(QKeySequence.SequenceFormat.NativeText)
            tip = row.tip or row.plain_text
            made.setToolTip(f"{tip} ({first})" if first else tip)
            made.setStatusTip(tip)

    def keys_of(self, row: Action) -> tuple[str, ...]:
        """Return the keys in force: the user's, or the usual ones."""
        own = self._settings.key_of(row.name)
        if own is None:
            return row.keys
        return (own,) if own else ()

    def row_of(self, name: str) -> Action:
        """Return the row of the table with this name."""
        return next(row for row in self.table if row.name == name)

    def add_menu(self, bar: QMenuBar, name: MenuName, title: str) -> None:
        """Add a menu with its actions, with separators between groups; none without actions."""
        # Whoever adds to a menu, leaving comes last.
        rows = sorted((row for row in self.table if row.menu == name), key=lambda row: row.group == "end")
        if rows:
            menu = bar.addMenu(title)
            menu.setToolTipsVisible(True)
            menu.aboutToShow.connect(self.refresh)
            self._menus[name] = menu
            self._fill(menu, rows)

    def menu_of(self, name: MenuName) -> QMenu:
        """Return a menu of the menu bar."""
        return self._menus[name]

    def context_menu(self, parent: QWidget) -> QMenu:
        """Return the plan view's context menu."""
        self.refresh()
        menu = QMenu(parent)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._fill(menu, [row for row in self.table if row.context and self._made[row.name].isEnabled()])
        return menu

    def _fill(self, menu: QMenu, rows: list[Action]) -> None:
        for before, row in zip([None, *rows], rows, strict=False):
            if before is not None and (before.group, before.menu) != (row.group, row.menu):
                menu.addSeparator()
            menu.addAction(self._made[row.name])

    def _make(self, row: Action, window: QWidget, canvas: QWidget) -> QAction:
        made = QAction(row.text, self)
        made.setObjectName(row.name)
        made.setMenuRole(_ROLES[row.role])
        if row.checked is None:
            made.triggered.connect(lambda _checked, row=row: self._do(row))
        else:
            made.setCheckable(True)
            made.triggered.connect(lambda checked, row=row: self._do(row, checked))
        if row.scope == "canvas":
            made.setShortcutContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
            canvas.addAction(made)
        else:
            window.addAction(made)
        return made

    def _do(self, row: Action, *checked: bool) -> None:
        if row.enabled():
            row.do(*checked)
        self.refresh()

    def _on_setting(self, name: str) -> None:
        if name.startswith("keys/"):
            self.refresh_keys()

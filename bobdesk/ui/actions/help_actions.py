"""The actions that explain the program and set it up."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QDialog, QWidget

from bobdesk.ui.actions.action import Action
from bobdesk.ui.actions.action_set import ActionSet
from bobdesk.ui.dialogs.command_palette import PALETTE_ACTION
from bobdesk.ui.settings import Settings
from bobdesk.ui.updates.updates import Updates


class HelpActions(QObject):
    """Shortcuts, command palette, preferences, newer versions, about.

    Parameters
    ----------
    actions
        Returns the window's actions, which are made from this table, too, and so do not exist yet.
    window
        Over which the dialogs stand.
    updates
        None where there is nobody to ask for newer versions: then that is not offered.
    """

    def __init__(
        self, actions: Callable[[], ActionSet], settings: Settings, window: QWidget, updates: Updates | None = None
    ) -> None:
        super().__init__(window)
        self._updates = updates
        self._actions, self._settings, self._window = actions, settings, window

    def table(self) -> tuple[Action, ...]:
        """Return the rows for the table of actions."""
        return (
            Action(
                "preferences",
                self.tr("&Preferences…"),
                self.show_preferences,
                ("Ctrl+,",),
                "settings",
                self.tr("Units, language, theme and saving"),
                menu="Edit",
                group="preferences",
                role="preferences",
            ),
            Action(
                "shortcuts",
                self.tr("&Keyboard shortcuts…"),
                self.show_shortcuts,
                ("?",),
                "keyboard",
                self.tr("Every action and its key, to look up and to change"),
                menu="Help",
                group="keys",
            ),
            Action(
                PALETTE_ACTION,
                self.tr("&Command palette…"),
                self.show_palette,
                ("Ctrl+Shift+P",),
                "palette",
                self.tr("Find any action by a few letters"),
                menu="Help",
                group="keys",
            ),
            *self._about_updates(),
            Action(
                "about",
                self.tr("&About BobDesk…"),
                self.show_about,
                (),
                "about",
                self.tr("Versions and licences"),
                menu="Help",
                group="about",
                role="about",
            ),
        )

    def _about_updates(self) -> tuple[Action, ...]:
        if self._updates is None:
            return ()
        return (
            Action(
                "check_for_updates",
                self.tr("Check for &updates…"),
                self._updates.ask,
                (),
                "info",
                self.tr("Ask whether there is a newer version; nothing is fetched or installed"),
                menu="Help",
                group="about",
                role="of the program",
            ),
        )

    def show_preferences(self) -> None:
        """Open the preferences."""
        from bobdesk.ui.dialogs.preferences import PreferencesDialog

        self._open(PreferencesDialog(self._settings, self._window, offers_updates=self._updates is not None))

    def show_shortcuts(self) -> None:
        """Open the shortcut sheet."""
        from bobdesk.ui.dialogs.shortcut_sheet import ShortcutSheet

        self._open(ShortcutSheet(self._actions(), self._settings, self._window))

    def show_palette(self) -> None:
        """Open the command palette."""
        from bobdesk.ui.dialogs.command_palette import CommandPalette

        self._open(CommandPalette(self._actions(), self._settings, self._window))

    def show_about(self) -> None:
        """Open the versions and licences."""
        from bobdesk.ui.dialogs.about import AboutDialog

        self._open(AboutDialog(self._window))

    def _open(self, dialog: QDialog) -> None:
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.open()

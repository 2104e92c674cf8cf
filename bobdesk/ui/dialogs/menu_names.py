"""What the menus are called in the user's language."""

from __future__ import annotations

from PySide6.QtCore import QObject

from bobdesk.ui.actions.action import MenuName


class MenuNames(QObject):
    """Names without mnemonics, for lists of actions."""

    def text(self, menu: MenuName) -> str:
        """Return a menu's name."""
        return {
            "File": self.tr("File"),
            "Edit": self.tr("Edit"),
            "View": self.tr("View"),
            "Plan": self.tr("Plan"),
            "Track": self.tr("Track"),
            "Segments": self.tr("Segments"),
            "Solve": self.tr("Solve"),
            "Window": self.tr("Window"),
            "Help": self.tr("Help"),
        }[menu]

"""The guide from within a dialog: a button, and the window's key for it."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QDialog, QDialogButtonBox


def offer_guide(dialog: QDialog, buttons: QDialogButtonBox) -> None:
    """Let a dialog of the program's window open the page that explains it.

    The dialog blocks that window alone: the guide, which belongs to no window, can be read and left beside it.
    """
    parent = dialog.parentWidget()
    guide = None if parent is None else parent.window().findChild(QAction, "guide")
    if guide is None:
        return
    dialog.setWindowModality(Qt.WindowModality.WindowModal)
    dialog.addAction(guide)
    help_button = buttons.addButton(QDialogButtonBox.StandardButton.Help)
    help_button.setToolTip(guide.toolTip())
    help_button.setAutoDefault(False)
    buttons.helpRequested.connect(guide.trigger)

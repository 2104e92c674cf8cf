"""Help: each action opens its dialog, which goes away whole."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QDialog, QWidget
from pytestqt.qtbot import QtBot

from bobdesk.ui.actions.action_set import ActionSet
from bobdesk.ui.actions.help_actions import HelpActions
from bobdesk.ui.desk import Desk


class WindowWithActions(QWidget):
    actions_by_name: ActionSet


@pytest.mark.parametrize("name", ["preferences", "shortcuts", "command-palette", "about"])
def test_each_opens_a_dialog_and_esc_closes_it(qtbot: QtBot, desk: Desk, name: str) -> None:
    window = WindowWithActions()
    qtbot.addWidget(window)
    window.actions_by_name = ActionSet(HelpActions(desk, window).table(), desk.settings, window, QWidget(window))
    window.show()
    qtbot.waitExposed(window)
    window.actions_by_name[name].trigger()
    dialog = QApplication.activeModalWidget()
    assert isinstance(dialog, QDialog)
    qtbot.keyClick(QApplication.focusWidget() or dialog, Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: not [one for one in window.findChildren(QDialog) if one.isVisible()])

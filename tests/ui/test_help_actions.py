"""Help: each action opens its dialog, which goes away whole."""

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QDialog, QWidget
from pytestqt.qtbot import QtBot

from bobdesk.ui.actions.action_set import ActionSet
from bobdesk.ui.actions.help_actions import HelpActions
from bobdesk.ui.settings import Settings


@pytest.mark.parametrize("name", ["preferences", "shortcuts", "command-palette", "about"])
def test_each_opens_a_dialog_and_esc_closes_it(qtbot: QtBot, tmp_path: Path, name: str) -> None:
    settings = Settings(tmp_path / "s.ini")
    window, canvas = QWidget(), QWidget()
    qtbot.addWidget(window)
    canvas.setParent(window)
    made: list[ActionSet] = []
    rows = HelpActions(lambda: made[0], settings, window).table()
    made.append(ActionSet(rows, settings, window, canvas))
    window.show()
    qtbot.waitExposed(window)
    made[0][name].trigger()
    dialog = QApplication.activeModalWidget()
    assert isinstance(dialog, QDialog)
    qtbot.keyClick(QApplication.focusWidget() or dialog, Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: not [one for one in window.findChildren(QDialog) if one.isVisible()])

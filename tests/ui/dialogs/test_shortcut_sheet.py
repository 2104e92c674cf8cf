"""The shortcut sheet: search, change in place, conflicts, reset."""

from typing import Any

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import QPushButton
from pytestqt.qtbot import QtBot

from bobdesk.ui.dialogs.shortcut_sheet import ShortcutSheet
from bobdesk.ui.settings import Settings

LEFT = Qt.MouseButton.LeftButton
CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def sheet(qtbot: QtBot, small: Any, settings: Settings) -> ShortcutSheet:
    made = ShortcutSheet(small.actions, settings, small.window)
    made.show()
    qtbot.waitExposed(made)
    return made


def keys_of(small: Any, name: str) -> list[str]:
    return [key.toString(QKeySequence.SequenceFormat.PortableText) for key in small.actions[name].shortcuts()]


def press(qtbot: QtBot, sheet: ShortcutSheet, name: str, key: Qt.Key, modifier: Qt.KeyboardModifier) -> None:
    field = sheet.edit(name)
    qtbot.keyClick(field, key, modifier)


def button(sheet: ShortcutSheet, text: str) -> QPushButton:
    return next(one for one in sheet.findChildren(QPushButton) if one.text() == text)


def test_it_lists_every_action_with_its_key(sheet: ShortcutSheet, small: Any) -> None:
    assert {row.name for row in small.actions.table} == set(sheet._items)
    assert sheet.item("redo").text(1) == "Ctrl+Y   Ctrl+Shift+Z"
    assert sheet.item("save").parent().text(0) == "File"


def test_search_by_name_and_by_key(qtbot: QtBot, sheet: ShortcutSheet) -> None:
    qtbot.keyClicks(sheet.search, "ctrl+shift")
    assert {name for name, item in sheet._items.items() if not item.isHidden()} == {"save-as", "redo"}
    sheet.search.clear()
    qtbot.keyClicks(sheet.search, "gap")
    assert [name for name, item in sheet._items.items() if not item.isHidden()] == ["close-gaps"]
    assert sheet.item("save").parent().isHidden()


def test_a_key_is_changed_in_place_and_acts_at_once(
    qtbot: QtBot, sheet: ShortcutSheet, small: Any, settings: Settings
) -> None:
    sheet.tree.setCurrentItem(sheet.item("close-gaps"))
    qtbot.keyClick(sheet.tree, Qt.Key.Key_Return)
    field = sheet.tree.itemWidget(sheet.item("close-gaps"), 1)
    qtbot.keyClick(field, Qt.Key.Key_G, CTRL)
    qtbot.waitUntil(lambda: keys_of(small, "close-gaps") == ["Ctrl+G"])
    assert sheet.item("close-gaps").text(1) == "Ctrl+G"
    assert settings.key_of("close-gaps") == "Ctrl+G"


def test_esc_leaves_the_key_as_it_is(qtbot: QtBot, sheet: ShortcutSheet, small: Any) -> None:
    field = sheet.edit("save")
    qtbot.keyClick(field, Qt.Key.Key_Escape)
    assert sheet.isVisible()
    assert sheet.tree.itemWidget(sheet.item("save"), 1) is None
    assert keys_of(small, "save") == ["Ctrl+S"]


@pytest.mark.parametrize("answer", ["Give it", "Leave it"])
def test_a_taken_key_is_asked_about(qtbot: QtBot, sheet: ShortcutSheet, small: Any, answer: str) -> None:
    press(qtbot, sheet, "close-gaps", Qt.Key.Key_Y, CTRL)
    qtbot.waitUntil(sheet._banner.isVisible)
    assert "Redo" in sheet._question.text()
    assert keys_of(small, "close-gaps") == []
    qtbot.mouseClick(button(sheet, answer), LEFT)
    taken = answer == "Give it"
    assert keys_of(small, "close-gaps") == (["Ctrl+Y"] if taken else [])
    assert keys_of(small, "redo") == (["Ctrl+Shift+Z"] if taken else ["Ctrl+Y", "Ctrl+Shift+Z"])
    assert not sheet._banner.isVisible()


def test_remove_and_the_usual_key(qtbot: QtBot, sheet: ShortcutSheet, small: Any, settings: Settings) -> None:
    sheet.tree.setCurrentItem(sheet.item("save"))
    assert not sheet.usual_button.isEnabled()
    qtbot.keyClick(sheet.tree, Qt.Key.Key_Delete)
    assert keys_of(small, "save") == []
    press(qtbot, sheet, "draw", Qt.Key.Key_S, CTRL)
    qtbot.waitUntil(lambda: keys_of(small, "draw") == ["Ctrl+S"])
    sheet.tree.setCurrentItem(sheet.item("save"))
    qtbot.mouseClick(sheet.usual_button, LEFT)
    assert (keys_of(small, "save"), keys_of(small, "draw")) == (["Ctrl+S"], [])
    qtbot.mouseClick(sheet.all_button, LEFT)
    assert keys_of(small, "draw") == ["A"]
    assert all(settings.key_of(row.name) is None for row in small.actions.table)

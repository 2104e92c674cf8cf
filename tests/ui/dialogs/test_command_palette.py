"""The command palette: by letters, arrows and Enter."""

from typing import Any

import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from bobdesk.ui.dialogs.command_palette import CommandPalette
from bobdesk.ui.dialogs.fuzzy import fuzzy_score
from bobdesk.ui.settings import Settings


@pytest.fixture
def palette(qtbot: QtBot, small: Any, settings: Settings) -> CommandPalette:
    made = CommandPalette(small.actions, settings, small.window)
    made.show()
    qtbot.waitExposed(made)
    return made


def test_letters_find_and_enter_does(qtbot: QtBot, palette: CommandPalette, small: Any, settings: Settings) -> None:
    qtbot.keyClicks(palette.field, "sa")
    assert palette.shown[:2] == ("save", "save-as")
    qtbot.keyClick(palette.field, Qt.Key.Key_Down)
    qtbot.keyClick(palette.field, Qt.Key.Key_Return)
    assert small.done == ["save-as"]
    assert not palette.isVisible()
    again = CommandPalette(small.actions, settings, small.window)
    assert again.shown[0] == "save-as"


def test_what_is_not_possible_is_listed_and_not_done(qtbot: QtBot, palette: CommandPalette, small: Any) -> None:
    qtbot.keyClicks(palette.field, "undo")
    assert palette.shown == ("undo",)
    qtbot.keyClick(palette.field, Qt.Key.Key_Return)
    assert small.done == []
    assert palette.isVisible()


def test_nothing_found_says_so_and_esc_closes(qtbot: QtBot, palette: CommandPalette) -> None:
    qtbot.keyClicks(palette.field, "xyzzy")
    assert palette.shown == ()
    assert not palette.list.isVisible()
    qtbot.keyClick(palette.field, Qt.Key.Key_Return)
    qtbot.keyClick(palette.field, Qt.Key.Key_Escape)
    assert not palette.isVisible()


def test_a_click_does_it_too(qtbot: QtBot, palette: CommandPalette, small: Any) -> None:
    place = palette.list.visualRect(palette.list.model().index(palette.shown.index("solve"), 0)).center()
    qtbot.mouseClick(palette.list.viewport(), Qt.MouseButton.LeftButton, pos=place)
    assert small.done == ["solve"]


def test_a_screen_reader_hears_menu_key_and_state(palette: CommandPalette) -> None:
    model = palette.list.model()
    said = [model.index(row, 0).data(Qt.ItemDataRole.AccessibleTextRole) for row in range(model.rowCount())]
    assert "Undo, Edit, Ctrl+Z, not now" in said


def test_scores() -> None:
    assert fuzzy_score("", "Save") == 0.0
    assert fuzzy_score("q", "Save") is None
    assert fuzzy_score("as save", "Save as") is not None
    assert (fuzzy_score("sa", "Save") or 0) > (fuzzy_score("sa", "Close gaps, also") or 0)
    assert (fuzzy_score("new", "New from picture") or 0) > (fuzzy_score("new", "Next part of the window") or 0)
    assert (fuzzy_score("cg", "Close gaps") or 0) > (fuzzy_score("cg", "Recording") or 0)

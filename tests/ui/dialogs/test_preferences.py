"""Preferences: applied at once, taken back by Cancel."""

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialogButtonBox
from pytestqt.qtbot import QtBot

from bobdesk.ui.dialogs import preferences
from bobdesk.ui.dialogs.preferences import PreferencesDialog, language_name, translated_languages
from bobdesk.ui.settings import Settings

LEFT = Qt.MouseButton.LeftButton
Button = QDialogButtonBox.StandardButton


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return Settings(tmp_path / "s.ini")


@pytest.fixture
def dialog(qtbot: QtBot, settings: Settings) -> PreferencesDialog:
    settings.theme, settings.autosave_minutes = "light", 5
    made = PreferencesDialog(settings)
    qtbot.addWidget(made)
    made.show()
    qtbot.waitExposed(made)
    return made


def click(qtbot: QtBot, dialog: PreferencesDialog, button: Button) -> None:
    qtbot.mouseClick(dialog.findChild(QDialogButtonBox).button(button), LEFT)


def change_all(qtbot: QtBot, dialog: PreferencesDialog) -> None:
    for box in (dialog.theme, dialog.length_unit, dialog.gradient_unit, dialog.language):
        box.setFocus()
        qtbot.keyClick(box, Qt.Key.Key_Down)
    dialog.autosave.setFocus()
    dialog.autosave.selectAll()
    qtbot.keyClicks(dialog.autosave, "17")
    qtbot.keyClick(dialog.autosave, Qt.Key.Key_Tab)


def state(settings: Settings) -> tuple[object, ...]:
    return (
        settings.theme,
        settings.length_unit,
        settings.gradient_unit,
        settings.language,
        settings.autosave_minutes,
    )


def test_what_is_chosen_is_there_at_once_and_ok_keeps_it(
    qtbot: QtBot, dialog: PreferencesDialog, settings: Settings
) -> None:
    told: list[str] = []
    settings.changed.connect(told.append)
    change_all(qtbot, dialog)
    assert state(settings) == ("dark", "ft", "degrees", "en", 17)
    assert set(told) == {"theme", "length_unit", "gradient_unit", "language", "autosave_minutes"}
    click(qtbot, dialog, Button.Ok)
    assert state(settings) == ("dark", "ft", "degrees", "en", 17)


@pytest.mark.parametrize("how", ["button", "key"])
def test_cancel_takes_all_back(qtbot: QtBot, dialog: PreferencesDialog, settings: Settings, how: str) -> None:
    before = state(settings)
    change_all(qtbot, dialog)
    if how == "button":
        click(qtbot, dialog, Button.Cancel)
    else:
        qtbot.keyClick(dialog, Qt.Key.Key_Escape)
    assert state(settings) == before
    assert not dialog.isVisible()


def test_the_usual_values_can_be_had_again(qtbot: QtBot, dialog: PreferencesDialog, settings: Settings) -> None:
    change_all(qtbot, dialog)
    click(qtbot, dialog, Button.RestoreDefaults)
    assert state(settings) == ("system", "m", "percent", "", 0)


def test_languages_are_those_that_there_are_texts_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "translations").mkdir()
    for name in ("bobdesk_de.qm", "bobdesk_zh_CN.qm", "readme.txt"):
        (tmp_path / "translations" / name).touch()
    monkeypatch.setattr(preferences, "resource", lambda *parts: tmp_path.joinpath(*parts))
    assert translated_languages() == ("de", "en", "zh_CN")
    assert language_name("de") == "Deutsch"
    assert language_name("en") == "English"


def test_every_control_has_name_and_tip(dialog: PreferencesDialog) -> None:
    for control in (dialog.theme, dialog.language, dialog.length_unit, dialog.gradient_unit, dialog.autosave):
        assert control.accessibleName()
        assert control.toolTip()

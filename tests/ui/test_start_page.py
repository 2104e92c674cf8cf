"""The start page: what can be begun, gone on with and recovered, by mouse and by keys."""

import json
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QLocale, Qt
from PySide6.QtWidgets import QLabel, QMessageBox, QPushButton
from pytestqt.qtbot import QtBot

from bobdesk.files.project_file import save_project
from bobdesk.files.recovery_store import Recoverable
from bobdesk.plan.polyline import Polyline
from bobdesk.progress import finish
from bobdesk.project.project import Project, SourceLine
from bobdesk.ui.recent_entries import RecentEntry, recent_entry, recent_entry_steps
from bobdesk.ui.samples import samples
from bobdesk.ui.settings import Settings
from bobdesk.ui.start_page import StartPage
from bobdesk.ui.when import Moments
from bobdesk.ui.window_parts import go_to_part

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return Settings(tmp_path / "s.ini")


@pytest.fixture
def page(qtbot: QtBot, settings: Settings, tmp_path: Path, shown: Callable[..., StartPage]) -> StartPage:
    for name in ("c", "b", "a"):
        settings.remember_recent(tmp_path / f"{name}.bobdesk")
    made = shown(StartPage(settings), 1000, 800)
    qtbot.waitExposed(made)
    made.activateWindow()
    return made


def entry(path: Path, state: str = "solved") -> RecentEntry:
    return RecentEntry(path, f"Track {path.stem}", time.time(), state, np.zeros((0, 2)))  # type: ignore[arg-type]


def project_with_line(name: str = "") -> Project:
    vertices = np.column_stack([np.linspace(0, 900, 500), 40 * np.sin(np.linspace(0, 9, 500))])
    return Project(name=name, source=SourceLine("a.csv", Polyline(vertices)))


def test_names_are_there_before_any_file_was_read(page: StartPage) -> None:
    assert [card.text() for card in page.grid.cards] == ["a", "b", "c"]


def test_the_three_buttons_by_mouse_and_key(qtbot: QtBot, page: StartPage) -> None:
    with qtbot.waitSignal(page.picture_wanted):
        qtbot.mouseClick(page.picture_button, LEFT)
    page.picture_button.setFocus()
    qtbot.keyClick(page.picture_button, Qt.Key.Key_Right)
    assert page.coordinates_button.hasFocus()
    with qtbot.waitSignal(page.coordinates_wanted):
        qtbot.keyClick(page.coordinates_button, Qt.Key.Key_Return)


def test_arrow_keys_go_through_the_cards_and_enter_opens(qtbot: QtBot, page: StartPage, settings: Settings) -> None:
    page.picture_button.setFocus()
    qtbot.keyClick(page.picture_button, Qt.Key.Key_Down)
    assert page.grid.cards[0].hasFocus()
    qtbot.keyClick(page.grid.cards[0], Qt.Key.Key_Right)
    assert page.grid.cards[1].hasFocus()
    with qtbot.waitSignal(page.project_wanted) as wanted:
        qtbot.keyClick(page.grid.cards[1], Qt.Key.Key_Return)
    assert wanted.args == [settings.recent[1]]
    qtbot.keyClick(page.grid.cards[1], Qt.Key.Key_Up)
    assert page.picture_button.hasFocus()


def test_a_missing_file_can_be_removed_from_the_list(qtbot: QtBot, page: StartPage, settings: Settings) -> None:
    first, second, third = settings.recent
    page.show_recent([entry(first), entry(second, "missing"), entry(third, "out of date")])
    card = page.grid.cards[1]
    assert "not found" in card.below
    link = next(one for one in page.grid.findChildren(QPushButton) if one.isVisible())
    with qtbot.waitSignal(page.forget_wanted) as wanted:
        qtbot.mouseClick(link, LEFT)
    settings.forget_recent(wanted.args[0])
    assert [card.entry.path for card in page.grid.cards] == [first, third]
    with qtbot.waitSignal(page.forget_wanted) as wanted:
        qtbot.keyClick(page.grid.cards[0], Qt.Key.Key_Delete)
    assert wanted.args == [first]


def test_a_narrow_window_has_fewer_columns(page: StartPage) -> None:
    wide = len({card.x() for card in page.grid.cards})
    page.resize(420, 800)
    assert (wide, len({card.x() for card in page.grid.cards})) == (3, 1)


def links_of(page: StartPage) -> list[QPushButton]:
    return [link for link in page.findChildren(QPushButton) if link.isVisible() and link is not page.first_track]


def test_the_first_track_is_a_link_to_the_guide(qtbot: QtBot, page: StartPage) -> None:
    with qtbot.waitSignal(page.guide_wanted) as wanted:
        qtbot.mouseClick(page.first_track, LEFT)
    assert wanted.args == ["first-track.md"]


def test_one_key_leads_through_the_parts_of_the_page(qtbot: QtBot, page: StartPage, tmp_path: Path) -> None:
    page.show_recoverable([Recoverable(tmp_path / "1", "Igls", None, time.time(), "")])
    qtbot.waitUntil(lambda: len(links_of(page)) == 2)
    page.sample_button.setFocus()
    for one in (links_of(page)[0], page.grid.cards[0], page.first_track, page.picture_button):
        go_to_part(page.parts(), 1)
        assert one.hasFocus()
    go_to_part(page.parts(), -1)
    assert page.first_track.hasFocus()


def test_recovering_and_discarding(qtbot: QtBot, page: StartPage, tmp_path: Path) -> None:
    items = [
        Recoverable(tmp_path / "1", "Alten<b>erg", None, time.time(), "Move boundary"),
        Recoverable(tmp_path / "2", "", None, time.time() - 1e6, ""),
    ]
    page.show_recoverable(items)
    links = links_of(page)
    assert [link.text() for link in links] == ["Recover", "Discard", "Recover", "Discard"]
    assert any(
        "Alten&lt;b&gt;erg" in label.text() and "Move boundary" in label.text() for label in page.findChildren(QLabel)
    )
    with qtbot.waitSignal(page.recover_wanted) as wanted:
        qtbot.mouseClick(links[2], LEFT)
    assert wanted.args == [items[1]]

    qtbot.mouseClick(links[1], LEFT)
    box = page.findChild(QMessageBox)
    assert "Alten<b>erg" in box.text()
    yes = next(button for button in box.buttons() if button.text() == "Discard")
    with qtbot.waitSignal(page.discard_wanted) as wanted:
        qtbot.mouseClick(yes, LEFT)
    assert wanted.args == [items[0]]
    page.show_recoverable([])
    assert not links_of(page)


def test_every_sample_has_a_title_and_is_wanted_by_its_folder(qtbot: QtBot, page: StartPage) -> None:
    menu = page.sample_menu()
    *finished, separator, practice = menu.actions()
    assert {action.objectName() for action in finished} == {sample.name for sample in samples()}
    assert separator.isSeparator()
    with qtbot.waitSignal(page.practice_wanted):
        practice.trigger()
    assert any("MIT" in action.text() for action in menu.actions())
    with qtbot.waitSignal(page.sample_wanted) as wanted:
        menu.actions()[0].trigger()
    assert wanted.args == [menu.actions()[0].objectName()]


def test_entries_say_what_their_files_say(tmp_path: Path) -> None:
    path = tmp_path / "x.bobdesk"
    save_project(project_with_line("Igls"), path)
    (tmp_path / "bad.bobdesk").write_bytes(b"PK\x03\x04 nothing")
    (tmp_path / "folder.bobdesk").mkdir()
    names = ("x", "bad", "none", "folder")
    found = finish(recent_entry_steps([tmp_path / f"{name}.bobdesk" for name in names]))
    assert [one.state for one in found] == ["line", "damaged", "missing", "damaged"]
    assert found[0].name == "Igls"
    assert found[0].line.shape == (200, 2)
    save_project(Project(), path)
    assert recent_entry(path).state == "empty"
    assert recent_entry(path).name == "x"


def test_a_damaged_document_is_no_crash(tmp_path: Path) -> None:
    path = tmp_path / "x.bobdesk"
    import zipfile

    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("project.json", json.dumps({"format": "bobdesk-project", "version": 99}))
    assert recent_entry(path).state == "damaged"


def test_moments_in_words(qapp: object) -> None:
    QLocale.setDefault(QLocale("en_GB"))
    now = time.mktime((2026, 11, 18, 15, 0, 0, 0, 0, -1))
    moments = Moments()
    day = 86_400
    assert moments.text(now, now=now) == "today 15:00"
    assert moments.text(now - day, now=now) == "yesterday"
    assert moments.text(now - 2 * day, now=now) == "Monday"
    assert moments.text(now - 6 * day, now=now) == "Thursday"
    assert moments.text(now - 15 * day, now=now) == "3 Nov"
    assert moments.text(now - 400 * day, now=now) == "14 Oct 2025"
    assert moments.text(float("inf"), now=now) == ""
    QLocale.setDefault(QLocale.system())

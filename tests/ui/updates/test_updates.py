"""Newer versions: told when the user asks, or wants it once a day; never without an address."""

import time

import pytest
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QCheckBox

from bobdesk import __version__
from bobdesk.ui.dialogs.preferences import PreferencesDialog
from bobdesk.ui.main_window import MainWindow
from bobdesk.ui.settings import Settings
from bobdesk.ui.updates import updates as module
from bobdesk.ui.updates.updates import Updates, updates_of
from tests.ui.updates.conftest import PAGE

DAY = 24 * 3600


@pytest.fixture
def told(desk):
    found = []
    desk.notices.told.connect(found.append)
    return found


@pytest.fixture
def updates(desk, server):
    made = Updates(desk, server.address, desk.session)
    yield made
    made.drop()


def ask(updates, until):
    updates.ask()
    until(lambda: not updates.is_busy)


def test_a_newer_version_is_told_with_its_page(updates, server, told, until, monkeypatch):
    opened = []
    monkeypatch.setattr(module.QDesktopServices, "openUrl", staticmethod(lambda url: opened.append(url.toString())))
    assert QDesktopServices is module.QDesktopServices
    server.tell("99.1")
    ask(updates, until)
    (notice,) = told
    assert notice.sentence == f"BobDesk 99.1 is out; this is {__version__}."
    assert notice.stays
    assert not opened
    notice.remedies[0].do()
    assert opened == [PAGE]


@pytest.mark.parametrize("version", [__version__, "0.0.1"])
def test_who_asks_is_told_that_this_is_the_newest(updates, server, told, until, version):
    server.tell(version)
    ask(updates, until)
    assert [notice.sentence for notice in told] == [f"This is the newest version of BobDesk, {__version__}."]


def test_who_asks_is_told_that_it_did_not_work(updates, server, told, until):
    server.answer = (500, {}, b"")
    ask(updates, until)
    assert [notice.weight for notice in told] == ["warning"]
    assert told[0].sentence.startswith("No newer version could be looked for: 127.0.0.1 ")


def test_nobody_is_asked_unless_the_user_wants_it(updates, desk, server):
    assert desk.settings.asks_for_updates is False
    updates.ask_if_due()
    assert not updates.is_busy
    assert not server.asked


def test_once_a_day_and_each_version_once(updates, desk, server, told, until):
    desk.settings.asks_for_updates = True
    server.tell("99.1")
    updates.ask_if_due()
    until(lambda: not updates.is_busy)
    assert len(told) == 1
    updates.ask_if_due()
    assert not updates.is_busy
    desk.settings.updates_asked = time.time() - DAY - 1
    updates.ask_if_due()
    until(lambda: not updates.is_busy)
    assert len(server.asked) == 2
    assert len(told) == 1
    ask(updates, until)
    assert len(told) == 2


def test_a_clock_that_was_put_back_does_not_end_it(updates, desk, server, until):
    desk.settings.asks_for_updates = True
    desk.settings.updates_asked = time.time() + 10 * DAY
    server.tell("0.0.1")
    updates.ask_if_due()
    until(lambda: not updates.is_busy)
    assert len(server.asked) == 1


def test_by_itself_nothing_is_said_of_failures_and_of_the_newest(updates, desk, server, told, until):
    desk.settings.asks_for_updates = True
    for answer in ((500, {}, b""), (200, {}, b"{}")):
        server.answer = answer
        desk.settings.updates_asked = 0
        updates.ask_if_due()
        until(lambda: not updates.is_busy)
    server.tell(__version__)
    desk.settings.updates_asked = 0
    updates.ask_if_due()
    until(lambda: not updates.is_busy)
    assert len(server.asked) == 3
    assert told == []


def test_the_window_offers_nothing_without_an_address(qtbot, tmp_path):
    window = MainWindow(Settings(tmp_path / "s.ini"), tmp_path / "data")
    qtbot.addWidget(window)
    assert updates_of(window.desk) is None
    assert "check_for_updates" not in [row.name for row in window.actions_by_name.table]
    window.close()


def test_the_window_asks_by_its_menu(qtbot, tmp_path, server, monkeypatch, until):
    monkeypatch.setattr(module, "feed_address", lambda: server.address)
    server.tell("99.1")
    window = MainWindow(Settings(tmp_path / "s.ini"), tmp_path / "data")
    qtbot.addWidget(window)
    found = []
    window.desk.notices.told.connect(found.append)
    window.actions_by_name["check_for_updates"].trigger()
    until(lambda: len(found) == 1)
    assert "99.1" in found[0].sentence
    window.close()


def test_preferences_have_it_only_where_it_is_offered(qtbot, tmp_path):
    settings = Settings(tmp_path / "s.ini")
    for offered in (False, True):
        dialog = PreferencesDialog(settings, offers_updates=offered)
        qtbot.addWidget(dialog)
        dialog.show()
        assert dialog.updates.isVisible() is offered
        assert isinstance(dialog.updates, QCheckBox)
        assert not dialog.updates.isChecked()
        dialog.updates.setChecked(True)
        assert settings.asks_for_updates is True
        dialog.reject()
        assert settings.asks_for_updates is False

"""Each test of the window has settings and data folders of its own, and leaves no thread, timer or window behind."""

from __future__ import annotations

import gc
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TypeVar

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QLocale, QObject, QTimer
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from bobdesk.ui.desk import Desk
from bobdesk.ui.documents import Documents
from bobdesk.ui.main_window import MainWindow
from bobdesk.ui.notices import Notices
from bobdesk.ui.plan_picture import PlanPicture
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.runner import Runner
from bobdesk.ui.selection import Selection
from bobdesk.ui.session import Session
from bobdesk.ui.settings import Settings
from bobdesk.ui.theme import apply_theme
from tests.ui.answers import Answers

Shown = TypeVar("Shown", bound=QWidget)
SAMPLE = Path(__file__).parent.parent.parent / "resources" / "samples" / "made_double" / "made_double.bobdesk"


@pytest.fixture(autouse=True)
def own_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Settings, recovery copies and locks lie below the test's own folder."""
    home = tmp_path / "home"
    home.mkdir()
    for name in ("HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME", "APPDATA", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(home))
    return home


@pytest.fixture(autouse=True)
def english(qapp: QApplication) -> Iterator[None]:
    """Numbers as in English, whatever the machine's language; the light palette."""
    before = QLocale()
    QLocale.setDefault(QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom))
    apply_theme(qapp, "light")
    yield
    QLocale.setDefault(before)


@pytest.fixture(autouse=True)
def nothing_left(qapp: QApplication) -> Iterator[None]:
    """Fail a test that leaves a thread, a running timer or a window behind."""
    threads = set(threading.enumerate())
    windows = set(QApplication.topLevelWidgets())
    yield
    _settle()
    gc.collect()
    _settle()
    left = [
        thread.name
        for thread in threading.enumerate()
        if thread not in threads and thread.is_alive() and not thread.name.startswith("ThreadPoolExecutor")
    ]
    assert not left, f"threads left behind: {left}"
    shown = [window for window in QApplication.topLevelWidgets() if window not in windows and window.isVisible()]
    assert not shown, f"windows left behind: {shown}"
    running = [
        timer
        for window in QApplication.topLevelWidgets()
        if window not in windows
        for timer in window.findChildren(QTimer)
        if timer.isActive()
    ]
    assert not running, f"timers left behind: {[timer.parent() for timer in running]}"


@pytest.fixture
def shown(qtbot: QtBot) -> Callable[[Shown, int, int], Shown]:
    """Return a function that shows a widget in a size and closes it after the test."""

    def show(widget: Shown, width: int, height: int) -> Shown:
        qtbot.addWidget(widget)
        widget.resize(width, height)
        widget.show()
        return widget

    return show


@pytest.fixture
def until(qtbot: QtBot) -> Callable[[Callable[[], bool]], None]:
    """Return a function that lets the window work until something is true, or fails after ten seconds."""

    def wait(true: Callable[[], bool]) -> None:
        qtbot.waitUntil(true, timeout=10_000)

    return wait


def _settle() -> None:
    for _ in range(3):
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        QCoreApplication.processEvents()


@pytest.fixture
def desk(qapp: QApplication, tmp_path: Path) -> Iterator[Desk]:
    """What the parts of a window share, without a window."""
    owner = QObject()
    session, runner, settings = Session(owner), Runner(owner), Settings(tmp_path / "settings.ini", owner)
    yield Desk(
        session=session,
        selection=Selection(owner),
        picture=PlanPicture(session, runner, owner),
        runner=runner,
        notices=Notices(owner),
        settings=settings,
        quantities=Quantities(settings, owner),
    )
    runner.close()
    owner.deleteLater()


@pytest.fixture
def window(qtbot: QtBot) -> QWidget:
    """A window for questions to appear over."""
    made = QWidget()
    qtbot.addWidget(made)
    return made


@pytest.fixture
def answers(desk: Desk, window: QWidget) -> Answers:
    """Questions with answers that the test gives."""
    return Answers(desk.settings, window)


@pytest.fixture
def documents(desk: Desk, answers: Answers, tmp_path: Path) -> Iterator[Documents]:
    """The document's way to the disk."""
    made = Documents(desk, answers, tmp_path / "data")
    yield made
    made.close(forget_copy=True)


@pytest.fixture
def said(desk: Desk) -> list[str]:
    """The sentences that were said to the user."""
    sentences: list[str] = []
    desk.notices.told.connect(lambda notice: sentences.append(notice.sentence))
    return sentences


@pytest.fixture
def whole_window(qtbot: QtBot, tmp_path: Path, until: Callable[[Callable[[], bool]], None]) -> MainWindow:
    """The main window with a finished track, active."""
    made = MainWindow(Settings(tmp_path / "settings.ini"), tmp_path / "data")

    def may_close(_window: QWidget) -> None:
        made._may_close = True

    qtbot.addWidget(made, before_close_func=may_close)
    made.resize(1300, 900)
    made.show()
    made.activateWindow()
    made.open_file(SAMPLE)
    until(lambda: made.desk.session.is_open and not made.desk.runner.jobs and made.isActiveWindow())
    return made

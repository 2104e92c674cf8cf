"""Faults: the work is kept, one dialog says so, and a storm of them stays one dialog."""

import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QPlainTextEdit, QWidget
from pytestqt.qtbot import QtBot

from bobdesk.ui.crash import CrashGuard
from bobdesk.ui.fault_report import without_home

LEFT = Qt.MouseButton.LeftButton


class Kept:
    def __init__(self) -> None:
        self.kept = 0
        self.left = 0
        self.fails = False

    def keep(self) -> None:
        self.kept += 1
        if self.fails:
            raise OSError("disk full")

    def leave(self) -> None:
        self.left += 1


@pytest.fixture
def kept() -> Kept:
    return Kept()


@pytest.fixture
def guard(qtbot: QtBot, kept: Kept) -> Iterator[CrashGuard]:
    window = QWidget()
    qtbot.addWidget(window)
    window.show()
    made = CrashGuard(kept.keep, kept.leave, window)
    yield made
    if made.dialog is not None:
        made.dialog.close()
    window.close()


def fault(guard: CrashGuard, error: Exception) -> None:
    try:
        raise error  # noqa: TRY301 - a fault has a traceback
    except Exception as caught:  # noqa: BLE001 - any
        guard.on_exception(type(caught), caught, caught.__traceback__)


def shown(qtbot: QtBot, guard: CrashGuard) -> None:
    qtbot.waitUntil(lambda: guard.dialog is not None and guard.dialog.isVisible())


def test_the_work_is_kept_and_one_goes_on(qtbot: QtBot, guard: CrashGuard, kept: Kept) -> None:
    fault(guard, ValueError("kaputt"))
    shown(qtbot, guard)
    assert kept.kept == 1
    dialog = guard.dialog
    assert dialog is not None
    details = dialog.findChild(QPlainTextEdit)
    assert not details.isVisible()
    qtbot.mouseClick(dialog.details_button, LEFT)
    assert details.isVisible()
    assert "ValueError: kaputt" in details.toPlainText()
    qtbot.mouseClick(dialog.copy_button, LEFT)
    copied = QGuiApplication.clipboard().text()
    assert "Python" in copied
    assert "ValueError: kaputt" in copied
    qtbot.keyClick(dialog, Qt.Key.Key_Return)
    assert guard.dialog is None
    assert kept.left == 0


def test_save_a_copy_and_quit(qtbot: QtBot, guard: CrashGuard, kept: Kept) -> None:
    fault(guard, ValueError("kaputt"))
    shown(qtbot, guard)
    assert guard.dialog is not None
    qtbot.mouseClick(guard.dialog.leave_button, LEFT)
    assert kept.left == 1


def test_a_storm_is_one_dialog(qtbot: QtBot, guard: CrashGuard) -> None:
    for _ in range(200):
        fault(guard, ValueError("again"))
    shown(qtbot, guard)
    first = guard.dialog
    assert first is not None
    fault(guard, KeyError("other"))
    qtbot.waitUntil(lambda: "KeyError" in first.report)
    assert guard.dialog is first
    assert len(first.report) < 20_000
    for _ in range(3):
        if guard.dialog is not None:
            guard.dialog.accept()
        fault(guard, ValueError("again"))
        QGuiApplication.processEvents()
    assert guard.dialog is None


def test_a_recovery_copy_that_fails_is_said_and_no_fault_of_its_own(
    qtbot: QtBot, guard: CrashGuard, kept: Kept
) -> None:
    kept.fails = True
    fault(guard, ValueError("kaputt"))
    shown(qtbot, guard)
    from PySide6.QtWidgets import QLabel

    assert guard.dialog is not None
    assert any("could not be written" in label.text() for label in guard.dialog.findChildren(QLabel))


def test_faults_of_threads_come_to_the_window(qtbot: QtBot, guard: CrashGuard) -> None:
    before = (sys.excepthook, threading.excepthook, sys.unraisablehook)
    guard.install()
    try:
        thread = threading.Thread(target=lambda: 1 / 0)
        thread.start()
        thread.join()
    finally:
        guard.uninstall()
    assert (sys.excepthook, threading.excepthook, sys.unraisablehook) == before
    shown(qtbot, guard)
    assert guard.dialog is not None
    assert "ZeroDivisionError" in guard.dialog.report


def test_a_report_does_not_name_the_home_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Path, "home", lambda: Path("/people/anna"))
    assert without_home('File "/people/anna/x.py", /people/annabel') == 'File "~/x.py", /people/annabel'

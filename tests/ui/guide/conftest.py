"""The program's window, which the guide belongs to."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from bobdesk.ui.main_window import MainWindow
from bobdesk.ui.settings import Settings


@pytest.fixture
def window(qtbot: QtBot, tmp_path: Path) -> Iterator[MainWindow]:
    """A window with settings and data of its own, shown."""
    made = MainWindow(Settings(tmp_path / "settings.ini"), tmp_path / "data")
    made.show()
    qtbot.waitExposed(made)
    yield made
    made.leave()
    made.deleteLater()

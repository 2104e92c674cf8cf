"""A small window with a table of actions, for the dialogs that list them."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtWidgets import QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from bobdesk.ui.actions.action import Action
from bobdesk.ui.actions.action_set import ActionSet
from bobdesk.ui.settings import Settings


class SmallWindow:
    """What was done, and the actions that did it."""

    def __init__(self, settings: Settings) -> None:
        self.done: list[str] = []
        self.window = QWidget()
        self.canvas = QWidget()
        QVBoxLayout(self.window).addWidget(self.canvas)

        def row(name: str, text: str, menu: str, *keys: str, scope: str = "window", can: bool = True) -> Action:
            return Action(
                name,
                text,
                lambda: self.done.append(name),
                keys,
                menu=menu,
                scope=scope,
                enabled=lambda: can,  # type: ignore[arg-type]
            )

        self.actions = ActionSet(
            [
                row("save", "&Save", "File", "Ctrl+S"),
                row("save-as", "Save &as…", "File", "Ctrl+Shift+S"),
                row("undo", "&Undo", "Edit", "Ctrl+Z", can=False),
                row("redo", "&Redo", "Edit", "Ctrl+Y", "Ctrl+Shift+Z"),
                row("draw", "&Draw", "Plan", "A", scope="canvas"),
                row("close-gaps", "Close &gaps", "Plan"),
                row("solve", "&Run", "Solve", "F5"),
            ],
            settings,
            self.window,
            self.canvas,
        )


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return Settings(tmp_path / "s.ini")


@pytest.fixture
def small(qtbot: QtBot, settings: Settings) -> Iterator[SmallWindow]:
    made = SmallWindow(settings)
    qtbot.addWidget(made.window)
    made.window.resize(700, 600)
    made.window.show()
    qtbot.waitExposed(made.window)
    yield made
    made.window.close()

"""The Window menu, and the steps."""

from __future__ import annotations

from typing import Protocol

from PySide6.QtCore import QObject

from bobdesk.project.steps import StepName
from bobdesk.ui.actions.action import Action


class Stage(Protocol):
    """What of the main window these actions move."""

    def go_to(self, step: StepName) -> None:
        """Show a step's panel."""

    def toggle_full_screen(self, on: bool) -> None:
        """Fill the screen, or not."""

    def is_full_screen(self) -> bool:
        """Whether the window fills the screen."""

    def reset_layout(self) -> None:
        """Put docks and bars back where they are at first."""

    def next_part(self, by: int = 1) -> None:
        """Move the keyboard to the next part of the window, or with -1 to the one before."""

    def has_document(self) -> bool:
        """Whether there is a document."""


class WindowActions(QObject):
    """Steps by number, full screen, layout."""

    def __init__(self, stage: Stage, parent: QObject) -> None:
        super().__init__(parent)
        self._stage = stage

    def table(self) -> tuple[Action, ...]:
        """Return the rows."""
        titles: tuple[tuple[StepName, str], ...] = (
            ("Plan", self.tr("Step 1: Plan")),
            ("Scale", self.tr("Step 2: Scale")),
            ("Centreline", self.tr("Step 3: Centreline")),
            ("Segments", self.tr("Step 4: Segments")),
            ("Solve", self.tr("Step 5: Solve")),
            ("Export", self.tr("Step 6: Export")),
        )
        steps = tuple(
            Action(
                f"step_{number}",
                text,
                lambda name=name: self._stage.go_to(name),
                (f"Ctrl+{number}",),
                "",
                self.tr("Show the panel of this step"),
                "Window",
                "steps",
                enabled=self._stage.has_document,
            )
            for number, (name, text) in enumerate(titles, start=1)
        )
        return (
            *steps,
            Action(
                "next_part",
                self.tr("Next &part of the window"),
                self._stage.next_part,
                ("F6",),
                "",
                self.tr("Move the keyboard to steps, tools, plan, strips, panel, and round again"),
                "Window",
                "layout",
            ),
            Action(
                "part_before",
                self.tr("Part of the window &before"),
                lambda: self._stage.next_part(-1),
                ("Shift+F6",),
                "",
                self.tr("Move the keyboard to the part of the window that it comes from"),
                "Window",
                "layout",
            ),
            Action(
                "full_screen",
                self.tr("&Full screen"),
                self._stage.toggle_full_screen,
                ("F11",),
                "full-screen",
                self.tr("Fill the whole screen"),
                "Window",
                "layout",
                checked=self._stage.is_full_screen,
            ),
            Action(
                "reset_layout",
                self.tr("&Reset the layout"),
                self._stage.reset_layout,
                (),
                "",
                self.tr("Put panels and bars back where they were at first"),
                "Window",
                "layout",
            ),
        )

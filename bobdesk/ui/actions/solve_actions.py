"""The Solve menu: run, rest, stop, and what becomes of the result."""

from __future__ import annotations

from typing import Protocol

from PySide6.QtCore import QObject

from bobdesk.project.steps import StepName
from bobdesk.ui.actions.action import Action
from bobdesk.ui.desk import Desk
from bobdesk.ui.solving import solving_of
from bobdesk.ui.window_views import WindowViews


class SolveStage(Protocol):
    """What of the main window these actions move."""

    def go_to(self, step: StepName) -> None:
        """Show a step's panel."""

    def export(self) -> None:
        """Show the export panel with its Save button in focus."""

    def has_document(self) -> bool:
        """Whether there is a document."""


class SolveActions(QObject):
    """Runs of the document.

    Parameters
    ----------
    views
        What fills the middle of the window.
    """

    def __init__(self, desk: Desk, stage: SolveStage, views: WindowViews, parent: QObject) -> None:
        super().__init__(parent)
        self._desk = desk
        self._stage = stage
        self._views = views
        self._solving = solving_of(desk)

    def table(self) -> tuple[Action, ...]:
        """Return the rows."""
        return (
            Action(
                "run",
                self.tr("&Run"),
                self.run,
                ("F5",),
                "run",
                self.tr("Find the gradients; while a run works, another one waits for its end"),
                "Solve",
                "run",
                enabled=self._stage.has_document,
            ),
            Action(
                "pause_run",
                self.tr("&Pause or resume"),
                self.pause,
                ("Ctrl+F5",),
                "pause",
                self.tr("Let the run rest, or go on"),
                "Solve",
                "run",
                enabled=lambda: self._solving.is_running,
            ),
            Action(
                "step_run",
                self.tr("One &step"),
                self.step,
                ("F10",),
                "step",
                self.tr("Do one iteration and rest"),
                "Solve",
                "run",
                enabled=lambda: (
                    self._stage.has_document() and (not self._solving.is_running or self._solving.is_paused)
                ),
            ),
            Action(
                "stop_run",
                self.tr("S&top and keep the best"),
                self._solving.stop,
                ("Shift+F5",),
                "stop",
                self.tr("End the run with its best iterate"),
                "Solve",
                "run",
                enabled=lambda: self._solving.is_running,
            ),
            Action(
                "delete_run",
                self.tr("&Delete the shown run"),
                self.delete_run,
                (),
                "delete",
                self.tr("Take the run that is shown from the list"),
                "Solve",
                "runs",
                enabled=lambda: self._desk.session.project.run is not None,
            ),
            Action(
                "in_space",
                self.tr("Show in &3D"),
                self._views.show_in_space,
                ("F9",),
                "layers",
                self.tr("Show the result in three dimensions in the place of the plan"),
                "View",
                "space",
                enabled=self._stage.has_document,
                checked=lambda: self._views.is_in_space,
            ),
            Action(
                "export",
                self.tr("&Export…"),
                self._stage.export,
                ("Ctrl+E",),
                "export",
                self.tr("Write the result as CSV, JSON, DXF and others; Enter repeats the last export"),
                "File",
                "import",
                enabled=lambda: self._desk.session.project.run is not None,
            ),
        )

    def run(self) -> None:
        """Show the panel, so that the run is seen, and solve."""
        self._stage.go_to("Solve")
        self._solving.run()

    def pause(self) -> None:
        """Rest, or go on."""
        if self._solving.is_paused:
            self._solving.resume()
        else:
            self._solving.pause()

    def step(self) -> None:
        """Do one iteration."""
        self._stage.go_to("Solve")
        self._solving.step()

    def delete_run(self) -> None:
        """Take the shown run away."""
        from bobdesk.project import edits

        index = self._desk.session.project.chosen_run
        if index is not None:
            self._desk.session.apply(self.tr("Delete run"), lambda project: edits.remove_run(project, index))

"""The windows beside the main one that the Solve menu opens."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from bobdesk.ui.actions.action import Action
from bobdesk.ui.desk import Desk

if TYPE_CHECKING:
    from bobdesk.ui.studies.beside_window import BesideWindow


class StudyActions(QObject):
    """Methods side by side, studies, the published tables.

    Parameters
    ----------
    data_folder
        Where finished rows of studies are kept.
    window
        With which the windows end.
    """

    def __init__(self, desk: Desk, data_folder: Path, window: QWidget) -> None:
        super().__init__(window)
        self._desk, self._data_folder, self._window = desk, data_folder, window
        self._made: dict[str, BesideWindow] = {}

    def table(self) -> tuple[Action, ...]:
        """Return the rows."""
        return (
            Action(
                "compare_methods",
                self.tr("Compare &methods…"),
                self.compare_methods,
                (),
                "layers",
                self.tr("Have all methods solve the project, and see them side by side"),
                "Solve",
                "studies",
                enabled=lambda: self._desk.session.is_open,
            ),
            Action(
                "study",
                self.tr("St&udy…"),
                self.study,
                (),
                "table",
                self.tr("Solve plans in every combination of segment counts, weights, methods and known elevations"),
                "Solve",
                "studies",
            ),
            Action(
                "published_tables",
                self.tr("&Published tables…"),
                self.published,
                (),
                "coordinates",
                self.tr("The tables of the paper beside what its method and ours make of the same targets"),
                "Solve",
                "studies",
            ),
        )

    def compare_methods(self) -> None:
        """Show all methods side by side."""
        from bobdesk.ui.studies.methods_window import MethodsWindow

        self._open("methods", lambda: MethodsWindow(self._desk, self._window))

    def study(self) -> None:
        """Show the study."""
        from bobdesk.ui.studies.study_window import StudyWindow

        self._open("study", lambda: StudyWindow(self._desk, self._data_folder / "studies", self._window))

    def published(self) -> None:
        """Show the published tables."""
        from bobdesk.ui.studies.published_window import PublishedWindow

        self._open("published", lambda: PublishedWindow(self._desk, self._window))

    def _open(self, name: str, make: Callable[[], BesideWindow]) -> None:
        if name not in self._made:
            self._made[name] = make()
        self._made[name].open()

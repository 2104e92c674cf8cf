"""The windows beside the main one that the Solve menu opens."""

from __future__ import annotations

from PySide6.QtCore import QObject

from bobdesk.ui.actions.action import Action
from bobdesk.ui.desk import Desk
from bobdesk.ui.studies.beside_windows import BesideWindows


class StudyActions(QObject):
    """Methods side by side, studies, the published tables."""

    def __init__(self, desk: Desk, windows: BesideWindows, parent: QObject) -> None:
        super().__init__(parent)
        self._desk, self._windows = desk, windows

    def table(self) -> tuple[Action, ...]:
        """Return the rows."""
        return (
            Action(
                "compare_methods",
                self.tr("Compare &methods…"),
                lambda: self._windows.open("methods"),
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
                lambda: self._windows.open("study"),
                (),
                "table",
                self.tr("Solve plans in every combination of segment counts, weights, methods and known elevations"),
                "Solve",
                "studies",
            ),
            Action(
                "published_tables",
                self.tr("&Published tables…"),
                lambda: self._windows.open("published"),
                (),
                "coordinates",
                self.tr("The tables of the paper beside what its method and ours make of the same targets"),
                "Solve",
                "studies",
            ),
        )

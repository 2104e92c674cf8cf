"""The actual track that results are compared with."""

from __future__ import annotations

from PySide6.QtCore import Signal

from bobdesk.project import edits
from bobdesk.project.project import Project
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part


class ActualPart(Part):
    """What is compared with, if anything.

    Signals
    -------
    wanted
        Take the actual track from a file.
    """

    wanted = Signal()

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Actual track, for comparison"))
        self.what = panel.add_label("", "muted", self.column)
        flow = panel.add_buttons(self.column)
        compare = panel.button(
            flow, self.tr("Compare with a file…"), self.tr("Take a measured line with elevations from a file"), "open"
        )
        compare.clicked.connect(self.wanted)
        self.remove_button = panel.button(flow, self.tr("Remove"), self.tr("Compare with nothing any more"), "delete")
        self.remove_button.clicked.connect(self._remove)

    def refresh(self, project: Project) -> None:
        """Show the actual track of a project."""
        actual = project.actual
        self.remove_button.setVisible(actual is not None)
        if actual is None:
            self.what.setText(self.tr("None. A measured line shows how far a result is from it."))
            return
        points = self.desk.quantities.number(len(actual.points), 0)
        self.what.setText(self.tr("{name}, points: {points}").format(name=actual.name, points=points))

    def _remove(self) -> None:

        self.desk.session.apply(self.tr("Remove actual track"), edits.compare_with_nothing)

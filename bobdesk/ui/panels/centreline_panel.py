"""The third step: from the digitised line to the centreline."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.panels.extent_part import ExtentPart
from bobdesk.ui.panels.line_origin_part import LineOriginPart
from bobdesk.ui.panels.smoothing_part import SmoothingPart
from bobdesk.ui.panels.vertices_part import VerticesPart
from bobdesk.ui.widgets.panel import Panel

_SHOWN = ("picture", "source", "trace", "extent", "fit", "calibration", "control_points", "known_distances")


class CentrelinePanel(Panel):
    """Digitised line, start and finish, smoothing, vertices.

    Signals
    -------
    vertices_wanted
        Show the selected vertices in the plan.
    """

    vertices_wanted = Signal()

    def __init__(self, desk: Desk, parent: QWidget | None = None) -> None:
        super().__init__(desk, parent)
        self.name_it(self.tr("Centreline"))
        self.origin = LineOriginPart(self)
        self.smoothing = SmoothingPart(self)
        self.extent = ExtentPart(self)
        self.vertices = VerticesPart(self)
        self.vertices.show_button.clicked.connect(self.vertices_wanted)
        self.column.addStretch(1)
        desk.session.changed.connect(self._on_changed)
        desk.quantities.changed.connect(self._refresh)
        self._refresh()

    def _on_changed(self, before: Project, after: Project) -> None:
        if any(getattr(before, name) is not getattr(after, name) for name in _SHOWN):
            self._refresh()

    def _refresh(self) -> None:
        project = self.desk.session.project
        has_plan = project.picture is not None or project.source is not None
        has_line = project.trace is not None or project.source is not None
        self.say(self._what_to_do(has_plan=has_plan, has_line=has_line))
        self.origin.setVisible(has_plan)
        self.smoothing.setVisible(has_line)
        if has_plan:
            self.origin.refresh(project)
        if has_line:
            self.smoothing.refresh(project)
        self.extent.refresh(project)
        self.vertices.refresh(project)

    def _what_to_do(self, *, has_plan: bool, has_line: bool) -> str:
        if has_line:
            return ""
        if not has_plan:
            return self.tr("A plan comes first: open a picture or coordinates.")
        return self.tr("There is no line yet. Trace it by two clicks, follow it with the live-wire, or draw it.")

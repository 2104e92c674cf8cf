"""The second step: how pixels become metres, and how well that is known."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from bobdesk.project import derive, edits
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.panels.control_points_part import ControlPointsPart
from bobdesk.ui.panels.distances_part import DistanceKind, DistancesPart
from bobdesk.ui.panels.scale_fit_part import ScaleFitPart
from bobdesk.ui.panels.scale_way_part import ScaleWayPart
from bobdesk.ui.panels.worst_item import worst_item
from bobdesk.ui.widgets.panel import Panel

_SHOWN = (
    "picture",
    "source",
    "control_points",
    "known_distances",
    "check_distances",
    "calibration",
    "target_sets",
    "chosen_targets",
)


class ScalePanel(Panel):
    """Way, control points, known distances, fit, check distances."""

    def __init__(self, desk: Desk, parent: QWidget | None = None) -> None:
        super().__init__(desk, parent)
        self.name_it(self.tr("Scale"))
        self.way = ScaleWayPart(self)
        self.points = ControlPointsPart(self)
        self.distances = DistancesPart(self, self._known_kind())
        self.fit = ScaleFitPart(self)
        self.checks = DistancesPart(self, self._check_kind())
        self.column.addStretch(1)
        desk.session.changed.connect(self._on_changed)
        desk.quantities.changed.connect(self._refresh)
        self._refresh()

    def _on_changed(self, before: Project, after: Project) -> None:
        if any(getattr(before, name) is not getattr(after, name) for name in _SHOWN):
            self._refresh()

    def _refresh(self) -> None:
        project = self.desk.session.project
        has_picture = project.source is None and project.picture is not None
        has_plan = has_picture or project.source is not None
        self.say("" if has_plan else self.tr("A plan comes first: open a picture or coordinates."))
        by_points = has_picture and project.calibration.way == "points"
        self.way.setVisible(has_plan)
        self.points.setVisible(has_picture and (by_points or bool(project.control_points)))
        self.distances.setVisible(has_picture and (by_points or bool(project.known_distances)))
        self.checks.setVisible(has_picture)
        if has_picture:
            self._refresh_parts(project)
            return
        self.fit.setVisible(False)
        if has_plan:
            self.way.refresh(project, None)

    def _refresh_parts(self, project: Project) -> None:

        found = derive.calibration(project)
        known = found.value if found.value is not None and found.value.scale_known else None
        per_pixel = None if known is None else known.metres_per_pixel
        self.way.refresh(project, found)
        self.points.refresh(project)
        fit = derive.calibration_fit(project).value
        self.distances.refresh(project, per_pixel, worst_item(fit) if project.calibration.way == "points" else None)
        self.checks.refresh(project, per_pixel)
        self.fit.refresh(project, known, fit)

    def _known_kind(self) -> DistanceKind:
        return DistanceKind(
            heading=self.tr("Known distances"),
            empty=self.tr("No known distance yet, such as a scale bar."),
            add_tip=self.tr("Click both ends of a distance that is known, and type its length"),
            items=lambda project: project.known_distances,
            change=edits.change_known_distance,
            remove=edits.remove_known_distance,
            change_label=self.tr("Change known distance"),
            remove_label=self.tr("Remove known distance"),
            can_be_off=True,
            tool="known_distance",
            icon="distance",
        )

    def _check_kind(self) -> DistanceKind:
        return DistanceKind(
            heading=self.tr("Check distances (not used in the fit)"),
            empty=self.tr("A distance that is known from elsewhere tells whether the scale is right."),
            add_tip=self.tr("Measure between two clicks, then keep it as a check distance"),
            items=lambda project: project.check_distances,
            change=edits.change_check_distance,
            remove=edits.remove_check_distance,
            change_label=self.tr("Change check distance"),
            remove_label=self.tr("Remove check distance"),
            can_be_off=False,
            tool="measure",
            icon="measure",
        )

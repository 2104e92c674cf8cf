"""The actual track's plan over the digitised one."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter

from bobdesk.arrays import frozen
from bobdesk.project.project import Project
from bobdesk.ui.plan_view.layers.derived_layer import DerivedLayer
from bobdesk.ui.plan_view.plan_lines import LineInPlan, line_in_plan
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import draw_line, pen
from bobdesk.ui.theme import colours


class ActualTrackLayer(DerivedLayer):
    """Moved, turned and scaled onto the centreline, for the two files rarely have one origin."""

    name = "actual_track"

    def inputs(self, project: Project) -> tuple[object, ...] | None:
        """Return what the line follows from, or None where there is no actual track."""
        line = super().inputs(project)
        return None if line is None or project.actual is None else (*line, project.actual)

    def work(self, project: Project) -> LineInPlan:
        """Return the actual track in plan units."""
        from bobdesk.track.placement import laid_over

        line = line_in_plan(project)
        if project.actual is None:
            return line
        return LineInPlan(frozen(laid_over(project.actual.points[:, :2], line.points)), line.stations)

    def draw_line(self, painter: QPainter, frame: Frame, line: LineInPlan) -> None:
        """Paint the line dashed, in the colour that the actual track has everywhere."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(pen(colours().measure, 1.6, Qt.PenStyle.DashLine))
        draw_line(painter, frame.to_screen(line.points), frame)

"""The centreline beside an edge that was digitised."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter

from bobdesk.project.project import Project
from bobdesk.ui.plan_view.layers.derived_layer import DerivedLayer
from bobdesk.ui.plan_view.plan_lines import LineInPlan
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import draw_line, pen
from bobdesk.ui.theme import colours


class CentrelineLayer(DerivedLayer):
    """Shown where it lies elsewhere than the digitised line."""

    name = "centreline"

    def inputs(self, project: Project) -> tuple[object, ...] | None:
        """Return what the line follows from, or None where it is the digitised line itself."""
        if project.extent.digitised == "centre" or not project.extent.offset:
            return None
        return super().inputs(project)

    def draw_line(self, painter: QPainter, frame: Frame, line: LineInPlan) -> None:
        """Paint the line in dots and dashes."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(pen(colours().preview, 2.0, Qt.PenStyle.DashDotLine))
        draw_line(painter, frame.to_screen(line.points), frame)

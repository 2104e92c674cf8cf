"""A layer whose line takes longer than a frame to work out: done in the background, and only while shown."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QGraphicsItem

from bobdesk.project.project import Project
from bobdesk.ui.derived import DerivedLater, line_inputs
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.layer import Layer
from bobdesk.ui.plan_view.plan_lines import LineInPlan, line_in_plan
from bobdesk.ui.plan_view.space import Frame


class DerivedLayer(Layer):
    """Draws a `LineInPlan`; until it is ready, the one before."""

    def __init__(self, desk: Desk, frame: Callable[[], Frame]) -> None:
        super().__init__(desk, frame)
        self._later: DerivedLater | None = None

    def concerns(self, before: Project, after: Project) -> bool:
        """Return whether this layer may have to be worked out for the first time."""
        return self._later is None

    def work(self, project: Project) -> LineInPlan:
        """Return what is drawn; called on a thread."""
        return line_in_plan(project)

    def inputs(self, project: Project) -> tuple[object, ...] | None:
        """Return what the line follows from, or None while it is not wanted."""
        return line_inputs(project)

    def title(self) -> str:
        """Return what is worked out, for the user."""
        return self.tr("Drawing the centreline in the plan")

    def draw_line(self, painter: QPainter, frame: Frame, line: LineInPlan) -> None:
        """Paint the line, in screen pixels."""

    def draw(self, painter: QPainter, frame: Frame) -> None:
        """Paint the line if it is ready; begin to work it out if nobody has."""
        if self._later is None:
            if self.inputs(self.desk.session.project) is None:
                return
            self._later = DerivedLater(self.desk, self.title(), self.work, self._wanted, self)
            self._later.changed.connect(self.repaint)
        line = self._later.value
        if line is not None:
            self.draw_line(painter, frame, line)

    def itemChange(self, change: QGraphicsItem.GraphicsItemChange, value: Any) -> Any:
        """Begin anew when the layer is shown again."""
        if change == QGraphicsItem.GraphicsItemChange.ItemVisibleHasChanged and self._later is not None:
            self._later.deleteLater()
            self._later = None
        return super().itemChange(change, value)

    def _wanted(self, project: Project) -> tuple[object, ...] | None:
        return self.inputs(project) if self.isVisible() else None

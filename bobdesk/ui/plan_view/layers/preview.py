"""The topmost layer: what the tool in hand previews."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtGui import QPainter

from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.layer import Layer
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.tools.tool import Tool


class PreviewLayer(Layer):
    """Lets the tool in hand paint."""

    name = "preview"

    def __init__(self, desk: Desk, frame: Callable[[], Frame], tool: Callable[[], Tool]) -> None:
        super().__init__(desk, frame)
        self._tool = tool

    def concerns(self, before: Project, after: Project) -> bool:
        """Return whether anything of the plan is another object."""
        return True

    def draw(self, painter: QPainter, frame: Frame) -> None:
        """Paint what the tool would do."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._tool().paint(painter, frame)

"""The line of a plan from coordinates."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtGui import QColor, QPainter

from bobdesk.project.project import Project, SourceLine
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.held_picture import HeldPicture
from bobdesk.ui.plan_view.layers.layer import Layer
from bobdesk.ui.plan_view.layers.trace import handles_shown
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import draw_line, pen
from bobdesk.ui.theme import colours


class SourceLineLayer(Layer):
    """Its vertices are dots and no handles: a file's coordinates are not moved by hand."""

    name = "source_line"

    def concerns(self, before: Project, after: Project) -> bool:
        """Return whether there are other coordinates."""
        return before.source is not after.source

    def __init__(self, desk: Desk, frame: Callable[[], Frame]) -> None:
        super().__init__(desk, frame)
        self._held = HeldPicture()

    def draw(self, painter: QPainter, frame: Frame) -> None:
        """Paint the line, and dots where they are far enough from each other."""
        source = self.desk.session.project.source
        if source is not None:
            self._held.paint(painter, frame, (source, colours()), lambda on: self._draw(on, frame, source))

    def _draw(self, painter: QPainter, frame: Frame, source: SourceLine) -> None:
        of = colours()
        screen = frame.to_screen(source.polyline.vertices)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(pen(of.trace, 2.0))
        draw_line(painter, screen, frame)
        inside = ((screen > 0) & (screen < [frame.width, frame.height])).all(axis=1)
        painter.setPen(pen(of.trace, 1.0))
        painter.setBrush(QColor(of.vertex))
        for x, y in screen[inside & handles_shown(screen / 2)].tolist():
            painter.drawEllipse(int(x) - 2, int(y) - 2, 4, 4)

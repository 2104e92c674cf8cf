"""What every layer of the plan view is: one item of the scene that paints in pixels of the screen."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QGraphicsObject, QStyleOptionGraphicsItem, QWidget

from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.space import Frame


class Layer(QGraphicsObject):
    """A layer looks at the desk when it paints, and says by `concerns` which changes it must show.

    Parameters
    ----------
    frame
        Tells what the view shows now.
    """

    name = ""
    usually_shown = True

    def __init__(self, desk: Desk, frame: Callable[[], Frame]) -> None:
        super().__init__()
        self.desk = desk
        self._frame = frame
        self._bounds = QRectF()
        desk.session.changed.connect(self._on_changed)

    def concerns(self, before: Project, after: Project) -> bool:
        """Return whether what this layer shows is another object than before."""
        return before is not after

    def draw(self, painter: QPainter, frame: Frame) -> None:
        """Paint, in screen pixels."""

    def set_bounds(self, bounds: QRectF) -> None:
        """Cover another part of the scene."""
        if bounds != self._bounds:
            self.prepareGeometryChange()
            self._bounds = bounds

    def boundingRect(self) -> QRectF:
        """Return the whole scene: the layer leaves out by itself what is not in view."""
        return self._bounds

    def paint(self, painter: QPainter, _option: QStyleOptionGraphicsItem, _widget: QWidget | None = None) -> None:
        """Hand over to `draw` in screen pixels."""
        painter.save()
        painter.resetTransform()
        self.draw(painter, self._frame())
        painter.restore()

    def repaint(self) -> None:
        """Paint anew with the next frame."""
        self.update()

    def _on_changed(self, before: Project, after: Project) -> None:
        if self.concerns(before, after):
            self.update()

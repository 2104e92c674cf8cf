"""The digitised line: its edges by how sure they are, its vertices as handles of one size."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from bobdesk.arrays import BoolArray, FloatArray
from bobdesk.plan.traced_line import Trace
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.layer import Layer
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import draw_line, pen, runs
from bobdesk.ui.theme import colours

_HANDLE = 7.0
# Handles that lie close together are smaller, so that they stay apart.
_SMALL_HANDLE, _ROOMY = 3.0, 10.0
_CLOSEST = 4.0
_SURE = 0.5


class TraceLayer(Layer):
    """Draws the trace; while a tool drags, the vertices that it proposes.

    Parameters
    ----------
    preview
        Returns the vertices (n, 2) that the tool in hand would make, or None.
    """

    name = "trace"

    def __init__(self, desk: Desk, frame: Callable[[], Frame], preview: Callable[[], FloatArray | None]) -> None:
        super().__init__(desk, frame)
        self._preview = preview
        desk.selection.vertices_changed.connect(self.repaint)

    def concerns(self, before: Project, after: Project) -> bool:
        """Return whether there is another line."""
        return before.trace is not after.trace or before.source is not after.source

    def draw(self, painter: QPainter, frame: Frame) -> None:
        """Paint edges, then handles."""
        project = self.desk.session.project
        trace = project.trace
        if trace is None or project.source is not None:
            return
        proposed = self._preview()
        screen = frame.to_screen(trace.points if proposed is None else proposed)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._draw_edges(painter, frame, screen, trace)
        self._draw_handles(painter, frame, screen)

    def _draw_edges(self, painter: QPainter, frame: Frame, screen: FloatArray, trace: Trace) -> None:
        of = colours()
        doubtful = doubtful_edges(trace) if len(screen) == len(trace.points) else np.zeros(len(screen) - 1, dtype=bool)
        painter.setPen(pen(of.trace, 2.0))
        if not doubtful.any():
            draw_line(painter, screen, frame)
            return
        for first, last in runs(~doubtful):
            draw_line(painter, screen[first : last + 1], frame)
        for first, last in runs(doubtful):
            painter.setPen(pen(of.trace_doubtful, 7.0, alpha=70))
            draw_line(painter, screen[first : last + 1], frame)
            painter.setPen(pen(of.trace_doubtful, 2.4, Qt.PenStyle.DashLine))
            draw_line(painter, screen[first : last + 1], frame)

    def _draw_handles(self, painter: QPainter, frame: Frame, screen: FloatArray) -> None:
        of = colours()
        inside = ((screen > -_HANDLE) & (screen < [frame.width + _HANDLE, frame.height + _HANDLE])).all(axis=1)
        chosen = np.zeros(len(screen), dtype=bool)
        chosen[[index for index in self.desk.selection.vertices if index < len(screen)]] = True
        plain = handles_shown(screen) & inside & ~chosen
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(pen(of.trace, 1.0))
        painter.setBrush(QColor(of.vertex))
        apart = np.median(np.hypot(*np.diff(screen, axis=0).T)) if plain.any() else 0.0
        painter.drawRects(_squares(screen[plain], _HANDLE - 1 if apart >= _ROOMY else _SMALL_HANDLE))
        painter.setBrush(QColor(of.trace_doubtful))
        painter.setPen(pen(of.finish if not of.is_dark else of.vertex, 1.0))
        painter.drawRects(_squares(screen[chosen & inside], _HANDLE + 1))


def doubtful_edges(trace: Trace) -> BoolArray:
    """Return which edges (n-1,) the picture hardly shows, or are suspect."""
    unsure = trace.confidence < _SURE
    doubtful = unsure[:-1] | unsure[1:]
    for first, last in trace.suspect.tolist():
        doubtful[first:last] = True
    return np.asarray(doubtful)


def handles_shown(screen: FloatArray) -> BoolArray:
    """Return which vertices (n,) are far enough from a neighbour on the screen to be shown as handles."""
    steps = np.hypot(np.diff(screen[:, 0]), np.diff(screen[:, 1]))
    apart = steps >= _CLOSEST
    shown = np.concatenate([[True], apart]) | np.concatenate([apart, [True]])
    return np.asarray(shown)


def _squares(centres: FloatArray, size: float) -> list[QRectF]:
    corners = np.round(centres - size / 2) + 0.5
    return [QRectF(x, y, size, size) for x, y in corners.tolist()]

"""The arrow keys move what is selected by a screen pixel, ten, or a tenth."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent

from bobdesk.ui.desk import Desk

_WAYS = {
    Qt.Key.Key_Left: (-1.0, 0.0),
    Qt.Key.Key_Right: (1.0, 0.0),
    Qt.Key.Key_Up: (0.0, -1.0),
    Qt.Key.Key_Down: (0.0, 1.0),
}


def is_arrow(event: QKeyEvent) -> bool:
    """Return whether a key is one of the four arrows."""
    return Qt.Key(event.key()) in _WAYS


def nudge(desk: Desk, event: QKeyEvent, *, px_per_screen: float, vertices_label: str, point_label: str) -> bool:
    """Move the selected vertices, or else the selected control point, of a picture; return whether there were any.

    Presses in a row are one step of undo.
    """
    way = np.array(_WAYS[Qt.Key(event.key())]) * px_per_screen
    if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
        way = 10.0 * way
    elif event.modifiers() & Qt.KeyboardModifier.ControlModifier:
        way = 0.1 * way
    from bobdesk.project import edits

    project, chosen = desk.session.project, desk.selection
    trace = project.trace
    if project.source is not None:
        return False
    if trace is not None and chosen.vertices and chosen.vertices[-1] < len(trace.points):
        indices = chosen.vertices
        to = trace.points[list(indices)] + way
        return desk.session.apply(
            vertices_label, lambda before: edits.move_vertices(before, indices, to), key=f"nudge vertices {indices}"
        )
    index = chosen.control_point
    if index is not None and index < len(project.control_points):
        point = project.control_points[index]
        x, y = point.x_px + float(way[0]), point.y_px + float(way[1])
        return desk.session.apply(
            point_label, lambda before: edits.move_control_point(before, index, x, y), key=f"nudge point {index}"
        )
    return False

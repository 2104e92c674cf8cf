"""What "fit the selection" shows."""

from __future__ import annotations

from PySide6.QtCore import QRectF

from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.space import Space, digitised_points, rectangle_around

_ROOM_AROUND_POINT = 60.0


def selected_part(desk: Desk, space: Space) -> QRectF | None:
    """Return the part of the scene around what is selected, else around the line, or None without either."""
    project, chosen = desk.session.project, desk.selection
    points = digitised_points(project)
    turn = [1.0, space.y_sign]
    if points is not None and chosen.vertices and chosen.vertices[-1] < len(points):
        part = rectangle_around(points[list(chosen.vertices)] * turn)
    elif chosen.control_point is not None and chosen.control_point < len(project.control_points):
        point = project.control_points[chosen.control_point]
        part = rectangle_around([[point.x_px, point.y_px]])
    elif points is not None:
        return rectangle_around(points * turn)
    else:
        return None
    room = max(_ROOM_AROUND_POINT, 0.25 * max(part.width(), part.height()))
    return part.adjusted(-room, -room, room, room)

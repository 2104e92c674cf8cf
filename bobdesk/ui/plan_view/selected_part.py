"""What "fit the selection" shows."""

from __future__ import annotations

from PySide6.QtCore import QRectF

from bobdesk.arrays import FloatArray
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.line_on_plan import LineOnPlan
from bobdesk.ui.plan_view.space import Space, digitised_points, rectangle_around
from bobdesk.ui.segments.alignment_now import alignment_now

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
    elif (chosen_part := _segments_part(desk)) is not None:
        part = rectangle_around(chosen_part * turn)
    elif points is not None:
        return rectangle_around(points * turn)
    else:
        return None
    room = max(_ROOM_AROUND_POINT, 0.25 * max(part.width(), part.height()))
    return part.adjusted(-room, -room, room, room)


def _segments_part(desk: Desk) -> FloatArray | None:
    """Return the places (n, 2) of the line from the first selected segment to the last, if any is selected."""
    if not desk.selection.segments:
        return None
    now = alignment_now(desk)
    chosen = [now.segments[index] for index in desk.selection.segments if index < len(now.segments)]
    points = LineOnPlan(now).points(desk.session.project)
    if not chosen or now.value is None or not len(points):
        return None
    stations = now.value.line.stations
    inside = (stations >= chosen[0].start) & (stations <= chosen[-1].end)
    return points[inside] if inside.any() else None

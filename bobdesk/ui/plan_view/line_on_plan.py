"""The centreline in plan units and on the screen, thinned to what is seen; kept until line or view change."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QPolygonF

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.project import derive
from bobdesk.project.project import Project
from bobdesk.ui.plan_view.follow import Follower
from bobdesk.ui.plan_view.near import nearest_on_line
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import polygon
from bobdesk.ui.plan_view.tools.tool import Pointer
from bobdesk.ui.segments.alignment_now import AlignmentNow

_MOST_KEPT = 4000


@dataclass(frozen=True, eq=False)
class ScreenPart:
    """A part of the line: places (k, 2), as Qt draws them, and the rectangle that they lie in."""

    points: FloatArray
    polygon: QPolygonF
    bounds: QRectF

    @classmethod
    def of(cls, points: FloatArray) -> ScreenPart:
        """Return the part through `points` (k, 2)."""
        made = polygon(points)
        return cls(points, made, made.boundingRect())


class ScreenLine:
    """What is drawn: stations (m,), m, and places on the screen (m, 2)."""

    def __init__(self, stations: FloatArray, screen: FloatArray) -> None:
        self.stations = stations
        self.screen = screen
        self._parts: dict[tuple[float, float], ScreenPart] = {}

    def kept_part(self, start: float, end: float) -> ScreenPart:
        """Return a part ready to be drawn; of hundreds, a drag changes two."""
        found = self._parts.get((start, end))
        if found is None:
            if len(self._parts) > _MOST_KEPT:
                self._parts.clear()
            found = self._parts[start, end] = ScreenPart.of(self.part(start, end))
        return found

    def part(self, start: float, end: float) -> FloatArray:
        """Return the places from one station to another, (k, 2)."""
        first, last = np.searchsorted(self.stations, [start, end], side="right")
        ends = self.at(np.array([start, end]))
        return np.concatenate([ends[:1], self.screen[first:last], ends[1:]])

    def at(self, stations: FloatArray) -> FloatArray:
        """Return the places of stations, (k, 2)."""
        return np.column_stack([np.interp(stations, self.stations, self.screen[:, axis]) for axis in (0, 1)])


class LineOnPlan:
    """Follows nothing by itself: it looks when it is asked."""

    def __init__(self, now: AlignmentNow) -> None:
        self._now = now
        self._made_for: tuple[object, ...] = ()
        self._points: FloatArray = np.empty((0, 2))
        self._drawn_for: tuple[object, ...] = ()
        self._drawn = ScreenLine(np.empty(0), self._points)

    def points(self, project: Project) -> FloatArray:
        """Return the centreline in plan units, (n, 2); empty before there is one."""
        value = self._now.value
        if value is None:
            return np.empty((0, 2))
        wanted = (value.line, project.source, project.calibration, project.control_points, project.known_distances)
        if not _same(wanted, self._made_for):
            try:
                metres = value.line.points / derive.plan_factor(project)
                in_pixels = project.source is None
                self._points = derive.calibration(project).needed().to_pixels(metres) if in_pixels else metres
            except InputError:
                # The scale is being given anew; the line that follows from it comes in a moment.
                return np.empty((0, 2))
            self._made_for = wanted
        return self._points

    def on_screen(self, project: Project, frame: Frame) -> ScreenLine | None:
        """Return the centreline as it is drawn, with at most a point a pixel."""
        points, value = self.points(project), self._now.value
        if value is None or not len(points):
            return None
        wanted = (points, frame)
        if not (self._drawn_for and self._drawn_for[0] is points and self._drawn_for[1] == frame):
            screen = frame.to_screen(points)
            steps = np.hypot(np.diff(screen[:, 0]), np.diff(screen[:, 1]))
            keep = np.diff(np.floor(np.concatenate([[0.0], np.cumsum(steps)])), prepend=-1.0) > 0
            keep[-1] = True
            self._drawn = ScreenLine(value.line.stations[keep], screen[keep])
            self._drawn_for = wanted
        return self._drawn

    def nearest(self, project: Project, place: tuple[float, float]) -> tuple[float, float] | None:
        """Return the station of the line nearest to a place of the plan, and how far it is, plan units."""
        points, value = self.points(project), self._now.value
        if value is None or len(points) < 2:
            return None
        stations = value.line.stations
        found = nearest_on_line(points, place)
        edge = points[found.edge + 1] - points[found.edge]
        length = float(np.hypot(*edge))
        share = 0.0 if length == 0 else float(np.hypot(*np.subtract(found.place, points[found.edge]))) / length
        low, high = stations[found.edge : found.edge + 2]
        return float(low + min(share, 1.0) * (high - low)), found.away

    def follower(
        self, project: Project, station: float, pointer: Pointer, *, between: tuple[float, float]
    ) -> Follower | None:
        """Return what follows the line from a station on as the mouse drags; `between` are the ends, m."""
        points, value = self.points(project), self._now.value
        if value is None or len(points) < 2:
            return None
        return Follower(
            points, value.line.stations, station, pointer.plan, between=between, per_screen=pointer.px_per_screen
        )

    def metres_per_unit(self, project: Project) -> float:
        """Return metres of the line per plan unit."""
        if project.source is not None:
            return derive.plan_factor(project)
        found = derive.calibration(project).value
        return 1.0 if found is None else found.metres_per_pixel * derive.plan_factor(project)


def _same(one: tuple[object, ...], other: tuple[object, ...]) -> bool:
    return len(one) == len(other) and all(a is b for a, b in zip(one, other, strict=True))

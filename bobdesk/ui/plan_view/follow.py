"""Follow a line with the mouse: where the line crosses itself, the branch that was taken hold of is kept."""

from __future__ import annotations

import math

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.ui.plan_view.near import nearest_on_line

Place = tuple[float, float]
# A quick mouse is followed in steps of so many pixels.
_STEP = 6.0
_MOST_STEPS = 200
_REACH = 4.0
# Further from its branch than this, and four times as near to another place of the line, the mouse means that one.
_STRAYED = 40.0
_MUCH_NEARER = 0.25


class Follower:
    """The station of a line at which the mouse drags something.

    Parameters
    ----------
    points, stations : (n, 2), (n,)
        The line in plan units, and its stations, m.
    station, place
        Where the drag begins on the line, and where the mouse is.
    between
        First and last station that can be reached, m.
    per_screen
        Plan units per screen pixel.
    """

    def __init__(
        self,
        points: FloatArray,
        stations: FloatArray,
        station: float,
        place: Place,
        *,
        between: tuple[float, float],
        per_screen: float,
    ) -> None:
        self._points, self._stations = points, stations
        self._along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
        self._low, self._high = np.interp(between, stations, self._along).tolist()
        self._at = float(np.interp(station, stations, self._along))
        self._place = place
        self._per_screen = per_screen

    def to(self, place: Place) -> float:
        """Take a move of the mouse; return the station, m."""
        way = math.dist(self._place, place)
        steps = min(max(math.ceil(way / (_STEP * self._per_screen)), 1), _MOST_STEPS)
        away = 0.0
        for share in np.linspace(0.0, 1.0, steps + 1)[1:].tolist():
            between = tuple(a + share * (b - a) for a, b in zip(self._place, place, strict=True))
            away = self._slide((between[0], between[1]), way / steps)
        self._place = place
        if away > _STRAYED * self._per_screen:
            other, how_far = self._nearest(place, self._low, self._high)
            if how_far < _MUCH_NEARER * away:
                self._at = other
        return float(np.interp(self._at, self._along, self._stations))

    def _slide(self, place: Place, way: float) -> float:
        """Go downhill along the line to the place nearest to the mouse; return how far it is, plan units."""
        reach = _REACH * max(way, self._per_screen)
        for _ in range(_MOST_STEPS):
            low, high = max(self._at - reach, self._low), min(self._at + reach, self._high)
            self._at, away = self._nearest(place, low, high)
            edge = 1e-6 * reach
            is_inside = low + edge < self._at < high - edge
            is_at_end = self._at <= self._low + edge or self._at >= self._high - edge
            if is_inside or is_at_end:
                return away
        return away

    def _nearest(self, place: Place, low: float, high: float) -> tuple[float, float]:
        """Return the place of a stretch that is nearest, as distance along the line, and how far it is."""
        first, last = np.searchsorted(self._along, [low, high], side="right")
        ends = np.column_stack([np.interp([low, high], self._along, self._points[:, axis]) for axis in (0, 1)])
        inner = self._along[first:last]
        part = np.concatenate([ends[:1], self._points[first:last], ends[1:]])
        along = np.concatenate([[low], inner, [high]])
        found = nearest_on_line(part, place)
        length = math.dist(part[found.edge], part[found.edge + 1])
        share = 0.0 if length == 0 else math.dist(part[found.edge], found.place) / length
        return float(along[found.edge] + min(share, 1.0) * (along[found.edge + 1] - along[found.edge])), found.away

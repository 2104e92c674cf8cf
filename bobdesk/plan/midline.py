"""The middle between two traced edges, where the user traces each edge of a wide track by itself."""

from __future__ import annotations

import numpy as np
import shapely

from bobdesk.arrays import FloatArray, frozen
from bobdesk.errors import InputError
from bobdesk.plan.polyline_geometry import arc_lengths, gaussian_smoothed, resampled

_ROUNDS = 8
_ENOUGH = 0.01


def midline(first: FloatArray, second: FloatArray, *, step: float = 2.0) -> FloatArray:
    """Return the line (n, 2) as far from one edge as from the other, from start to finish of both.

    Parameters
    ----------
    first, second
        (m, 2) and (k, 2), the two edges in pixels or metres; the second may run the other way.
    step
        Distance of the points of the result, the same unit.

    Raises
    ------
    InputError
        If the edges are too short, or do not run beside each other.
    """
    for edge in (first, second):
        if len(edge) < 2 or arc_lengths(edge)[-1] < 2 * step:
            raise InputError("An edge is too short to find the middle between two edges.")
    together = np.hypot(*(first[0] - second[0])) + np.hypot(*(first[-1] - second[-1]))
    crosswise = np.hypot(*(first[0] - second[-1])) + np.hypot(*(first[-1] - second[0]))
    if crosswise < together:
        second = second[::-1]
    lengths = float(arc_lengths(first)[-1]), float(arc_lengths(second)[-1])
    if max(lengths) > 2.0 * min(lengths):
        raise InputError(f"Edges of {lengths[0]:.0f} and {lengths[1]:.0f} in length do not run beside each other.")
    count = max(8, round(0.5 * sum(lengths) / step))
    at = np.linspace(0.0, 1.0, count + 1)
    points = 0.5 * (_at_shares(first, at) + _at_shares(second, at))
    sides = (shapely.LineString(first), shapely.LineString(second))
    for _ in range(_ROUNDS):
        shift = _to_middle(points, sides)
        # The ends have nothing beyond them that would hold them: they keep their place along the line.
        points = resampled(gaussian_smoothed(points + shift, sigma=1.0), step=step)
        if float(np.hypot(shift[:, 0], shift[:, 1]).max()) < _ENOUGH * step:
            break
    return frozen(points + _to_middle(points, sides), columns=2)


def _at_shares(points: FloatArray, shares: FloatArray) -> FloatArray:
    """Points (n, 2) at shares of the length of a polyline."""
    along = arc_lengths(points)
    return np.column_stack([np.interp(shares * along[-1], along, points[:, axis]) for axis in (0, 1)])


def _to_middle(points: FloatArray, sides: tuple[shapely.LineString, shapely.LineString]) -> FloatArray:
    """The way (n, 2) from each point to where both edges are equally far."""
    spots = shapely.points(points)
    nearest = []
    for side in sides:
        along = shapely.line_locate_point(side, spots)
        nearest.append(shapely.get_coordinates(shapely.line_interpolate_point(side, along)))
    gap = nearest[1] - nearest[0]
    width = np.maximum(np.hypot(gap[:, 0], gap[:, 1]), 1e-9)
    distances = [np.hypot(*(points - near).T) for near in nearest]
    return np.asarray(gap / width[:, None] * (0.5 * (distances[1] - distances[0]))[:, None], dtype=np.float64)

"""A polyline in metres: the vertices that a user, a file or a trace gave."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray, IntArray, frozen
from bobdesk.errors import InputError

FEWEST_VERTICES = 3
MOST_VERTICES = 1_000_000
LARGEST_COORDINATE = 1e8
SAME_POINT = 1e-3


@dataclass(frozen=True, eq=False)
class Polyline:
    """Vertices in metres, y up, in running order; it may cross itself (a Kreisel does).

    Attributes
    ----------
    vertices : (n, 2) float64, read-only
        n is at least 3; neighbours lie at least 1 mm apart.
    """

    vertices: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "vertices", frozen(self.vertices, columns=2))


def polyline_from_points(points: FloatArray) -> tuple[Polyline, IntArray]:
    """Check points and merge repeated ones.

    Parameters
    ----------
    points : (n, 2)
        Coordinates in metres.

    Returns
    -------
    polyline, kept
        The polyline and the indices of the points that were kept.

    Raises
    ------
    InputError
        If a coordinate is not finite or beyond 1e8 m, or fewer than three different points remain.
    """
    if len(points) > MOST_VERTICES:
        raise InputError(f"the line has {len(points):,} points; the most that can be used is {MOST_VERTICES:,}")
    if not np.isfinite(points).all():
        index = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])
        raise InputError(f"point {index + 1} of the line is not a finite number")
    if len(points) and np.abs(points).max() >= LARGEST_COORDINATE:
        raise InputError("the coordinates lie beyond 100,000 km; are they metres?")
    kept = _different_points(points)
    if len(kept) < FEWEST_VERTICES:
        found = "one point" if len(kept) == 1 else f"{len(kept)} different points"
        raise InputError(f"the line has only {found}; a plan needs at least {FEWEST_VERTICES}")
    return Polyline(points[kept]), kept


def _different_points(points: FloatArray) -> IntArray:
    """Return the indices of points that lie at least 1 mm from the last one kept."""
    if len(points) == 0:
        return np.zeros(0, dtype=np.int64)
    steps = np.hypot(*np.diff(points, axis=0).T)
    if (steps >= SAME_POINT).all():
        return np.arange(len(points))
    kept = [0]
    last = points[0]
    for index in range(1, len(points)):
        if np.hypot(*(points[index] - last)) >= SAME_POINT:
            kept.append(index)
            last = points[index]
    return np.array(kept)


def edge_lengths(polyline: Polyline) -> FloatArray:
    """Return the lengths of the edges between neighbouring vertices, (n-1,), m."""
    lengths: FloatArray = np.hypot(*np.diff(polyline.vertices, axis=0).T)
    return lengths

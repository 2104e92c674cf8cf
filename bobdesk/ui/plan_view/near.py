"""Places on and near a line (n, 2), with numpy alone: every move of the mouse asks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray


@dataclass(frozen=True)
class OnLine:
    """The place of a line that is nearest to another place.

    Attributes
    ----------
    place
        (x, y) on the line.
    along
        Distance along the line.
    edge
        Index of the edge's first vertex.
    away
        Distance from the place that was asked for.
    """

    place: tuple[float, float]
    along: float
    edge: int
    away: float


def distances_along(points: FloatArray) -> FloatArray:
    """Return the distance along the line at each vertex, (n,)."""
    steps = np.hypot(np.diff(points[:, 0]), np.diff(points[:, 1]))
    return np.concatenate([[0.0], np.cumsum(steps)])


def nearest_vertex(points: FloatArray, place: tuple[float, float]) -> tuple[int, float]:
    """Return the index of the vertex nearest to a place, and how far it is."""
    away = np.hypot(points[:, 0] - place[0], points[:, 1] - place[1])
    index = int(away.argmin())
    return index, float(away[index])


def nearest_on_line(points: FloatArray, place: tuple[float, float]) -> OnLine:
    """Return the place of the line that is nearest to `place`."""
    starts, ways = points[:-1], np.diff(points, axis=0)
    squares = np.maximum((ways**2).sum(axis=1), 1e-300)
    share = np.clip(((np.asarray(place) - starts) * ways).sum(axis=1) / squares, 0.0, 1.0)
    feet = starts + share[:, None] * ways
    away = np.hypot(feet[:, 0] - place[0], feet[:, 1] - place[1])
    edge = int(away.argmin())
    along = float(distances_along(points[: edge + 1])[-1] + share[edge] * np.sqrt(squares[edge]))
    return OnLine((float(feet[edge, 0]), float(feet[edge, 1])), along, edge, float(away[edge]))


def place_at(points: FloatArray, along: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the place at a distance along the line, and the unit direction of the line there."""
    marks = distances_along(points)
    along = min(max(along, 0.0), float(marks[-1]))
    edge = int(np.clip(np.searchsorted(marks, along, side="right") - 1, 0, len(points) - 2))
    while edge > 0 and marks[edge + 1] == marks[edge]:
        edge -= 1
    way = points[edge + 1] - points[edge]
    length = max(float(np.hypot(way[0], way[1])), 1e-12)
    place = points[edge] + way / length * (along - marks[edge])
    return (float(place[0]), float(place[1])), (float(way[0] / length), float(way[1] / length))

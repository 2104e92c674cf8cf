"""What there is to know of a segment in plan: radius, direction, turn angle, fit."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from bobdesk.alignment.centreline import Centreline, at_stations
from bobdesk.alignment.curvature import heading
from bobdesk.alignment.segments import Segment
from bobdesk.arrays import FloatArray

_NEWTON_STEPS = 10
_STRAIGHTEST_RADIUS = 1e5


@dataclass(frozen=True)
class SegmentFigures:
    """Figures of one segment.

    Attributes
    ----------
    radius
        Of the arc fitted to a curve, m; None for a straight.
    turn
        Change of heading from start to end, rad, left positive.
    deviation
        Largest distance of the line from the fitted arc or straight, m.
    """

    radius: float | None
    turn: float
    deviation: float

    @property
    def direction(self) -> Literal["left", "right"]:
        """Which way the segment turns."""
        return "left" if self.turn >= 0 else "right"


def segment_figures(centreline: Centreline, segment: Segment) -> SegmentFigures:
    """Fit an arc to a curve, or a straight line to a straight, and measure its turn angle."""
    count = max(5, round(segment.length / centreline.spacing) + 1)
    points = at_stations(centreline, np.linspace(segment.start, segment.end, count))
    headings = np.interp([segment.start, segment.end], centreline.stations, heading(centreline))
    turn = float(headings[1] - headings[0])
    if segment.kind == "curve":
        centre, radius = fit_circle(points)
        if radius < _STRAIGHTEST_RADIUS:
            deviation = float(np.abs(np.hypot(*(points - centre).T) - radius).max())
            return SegmentFigures(radius, turn, deviation)
    middle = points.mean(axis=0)
    across = np.linalg.svd(points - middle, full_matrices=False)[2][1]
    deviation = float(np.abs((points - middle) @ across).max())
    return SegmentFigures(math.inf if segment.kind == "curve" else None, turn, deviation)


def fit_circle(points: FloatArray) -> tuple[FloatArray, float]:
    """Return centre (2,) and radius of the circle with the least squares of distances, m.

    Kasa's linear fit, then Gauss-Newton on the distances, since the linear fit of a short arc comes
    out too small. Points on a line give a radius beyond 1e5 m.
    """
    middle = points.mean(axis=0)
    local = points - middle
    matrix = np.column_stack([2 * local, np.ones(len(local))])
    solution, _, rank, _ = np.linalg.lstsq(matrix, (local**2).sum(axis=1), rcond=1e-12)
    if rank < 3:
        return middle, math.inf
    centre = solution[:2]
    radius = math.sqrt(max(solution[2] + centre @ centre, 0.0))
    for _ in range(_NEWTON_STEPS):
        away = local - centre
        distance = np.hypot(*away.T)
        if radius > _STRAIGHTEST_RADIUS or distance.min() <= 0:
            break
        jacobian = np.column_stack([-away / distance[:, None], -np.ones(len(local))])
        step = np.linalg.lstsq(jacobian, radius - distance, rcond=None)[0]
        centre, radius = centre + step[:2], radius + float(step[2])
        if np.abs(step).max() < 1e-9 * radius:
            break
    return centre + middle, radius

"""Figures of any stretch of the line, between two stations."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray


@dataclass(frozen=True)
class RangeFigures:
    """Figures of a stretch.

    Attributes
    ----------
    start, end
        Stations, m.
    turn
        Change of heading, rad, left positive.
    mean_radius, least_radius
        One over the mean and the largest absolute curvature, m; infinite where the line is straight.
    drop, mean_gradient
        m, and per metre of plan, downhill positive; None before there is a result.
    """

    start: float
    end: float
    turn: float
    mean_radius: float
    least_radius: float
    drop: float | None = None
    mean_gradient: float | None = None

    @property
    def length(self) -> float:
        """Length in plan, m."""
        return self.end - self.start


def range_figures(
    stations: FloatArray,
    curvature: FloatArray,
    start: float,
    end: float,
    *,
    profile: tuple[FloatArray, FloatArray] | None = None,
) -> RangeFigures:
    """Measure the stretch between two stations.

    Parameters
    ----------
    stations, curvature : (n,)
        Of the centreline, m and 1/m.
    start, end
        In any order; they are kept on the line.
    profile
        Stations (m,) and elevations (m,) of a result, m.
    """
    low, high = sorted((min(max(start, stations[0]), stations[-1]), min(max(end, stations[0]), stations[-1])))
    inside = slice(int(np.searchsorted(stations, low, "right")), int(np.searchsorted(stations, high, "left")))
    at = np.concatenate([[low], stations[inside], [high]])
    bends = np.concatenate(
        [[np.interp(low, stations, curvature)], curvature[inside], [np.interp(high, stations, curvature)]]
    )
    length = float(high - low)
    size = np.abs(bends)
    mean = float(np.trapezoid(size, at)) / length if length > 0 else float(size.max())
    drop = gradient = None
    if profile is not None:
        upper, lower = np.interp([low, high], *profile)
        drop = float(upper - lower)
        gradient = drop / length if length > 0 else None
    return RangeFigures(
        float(low),
        float(high),
        float(np.trapezoid(bends, at)),
        _radius(mean),
        _radius(float(size.max())),
        drop,
        gradient,
    )


def _radius(curvature: float) -> float:
    return math.inf if curvature < 1e-9 else 1.0 / curvature

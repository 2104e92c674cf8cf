"""Anchors: the elevations that a profile is held at, from the start to the end."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.errors import TargetError
from bobdesk.solve.targets import KnownElevation, Targets

SAME_STATION = 1e-6
_BEYOND_THE_END = 0.005
# The fitted line is a little longer than the points that somebody counts along.
_NEAR_END, _NEAR_END_M = 1e-4, 0.01
Anchors = tuple[KnownElevation, ...]


def anchors_of(targets: Targets, length: float, lowest: tuple[float, ...] = ()) -> Anchors:
    """Return the held elevations in running order: the drop at the start, the known ones, 0 at the end.

    A known elevation at the end takes the place of 0; then the lowest point must be known too. Where the lowest
    point is known inside the line and the end is not, the end is free: an anchor with an infinite tolerance.

    Parameters
    ----------
    targets
        The targets; their known elevations count in the plan's own scale.
    length
        Plan length, m. A station up to 0.5 % beyond it, or 0.01 % (at least 1 cm) before it, counts as the end.
    lowest
        Stations to be held at 0 besides.

    Raises
    ------
    TargetError
        If a known elevation lies outside the line, below the lowest point, or contradicts another.
    """
    known = sorted((*targets.known, *(KnownElevation(at, 0.0) for at in lowest)), key=lambda item: item.station)
    for item in known:
        _check(item, length)
    start = KnownElevation(0.0, targets.drop)
    end: KnownElevation | None = None
    inner: list[KnownElevation] = []
    near_end = length - max(_NEAR_END * length, _NEAR_END_M)
    for item in known:
        if item.station <= SAME_STATION:
            _both(item, start, "the start is at the drop")
        elif item.station >= near_end:
            at_end = replace(item, station=length)
            end = at_end if end is None else _both(at_end, end, "two elevations for the end")
        elif inner and item.station - inner[-1].station <= SAME_STATION:
            inner[-1] = _both(item, inner[-1], "two elevations for one station")
        else:
            inner.append(item)
    if end is None:
        is_behind_lowest = any(item.elevation <= 0 and SAME_STATION < item.station < near_end for item in targets.known)
        end = KnownElevation(length, 0.0, math.inf if is_behind_lowest else 0.0)
    elif end.elevation > end.tolerance and not any(item.elevation <= item.tolerance for item in inner):
        raise TargetError(
            f"the end lies {end.elevation:g} m above the lowest point, so say where the lowest point is:"
            " a known elevation of 0 at its station"
        )
    return (start, *inner, end)


def last_before_a_free_end(anchors: Anchors) -> KnownElevation | None:
    """Return the last anchor at the lowest point if nothing is known of the end; None where the end is held."""
    if math.isfinite(anchors[-1].tolerance):
        return None
    return next(anchor for anchor in reversed(anchors[:-1]) if anchor.elevation <= 0)


def stations_of(anchors: Anchors) -> FloatArray:
    """Return the anchors' stations, (a,), m."""
    return np.array([anchor.station for anchor in anchors])


def elevations_of(anchors: Anchors) -> FloatArray:
    """Return the anchors' elevations, (a,), m."""
    return np.array([anchor.elevation for anchor in anchors])


def gradients_through(anchors: Anchors, *, scale: float, level_at_lowest: bool) -> FloatArray:
    """Return the gradient with which the track passes each inner anchor, (a-2,).

    That of the parabola through an anchor and its two neighbours, and never outside the mean
    gradients of the stretches beside it; 0 at the lowest point of a track that climbs again.
    """
    lengths = scale * np.diff(stations_of(anchors))
    means = -np.diff(elevations_of(anchors)) / lengths
    through = (means[:-1] * lengths[1:] + means[1:] * lengths[:-1]) / (lengths[1:] + lengths[:-1])
    if level_at_lowest:
        through[elevations_of(anchors)[1:-1] == 0] = 0.0
    return through


def _check(item: KnownElevation, length: float) -> None:
    if not -SAME_STATION <= item.station <= (1 + _BEYOND_THE_END) * length:
        raise TargetError(
            f"the elevation known at {item.station:g} m lies outside the line, which is {length:.2f} m long"
        )
    if item.elevation + item.tolerance < 0:
        raise TargetError(
            f"the elevation at {item.station:g} m is {item.elevation:g} m, below the lowest point;"
            " elevations count from the lowest point, so that the start is at the drop"
        )


def _both(item: KnownElevation, other: KnownElevation, why: str) -> KnownElevation:
    """Return what two elevations for one place leave: all that lies within the tolerances of both."""
    low = max(item.elevation - item.tolerance, other.elevation - other.tolerance)
    high = min(item.elevation + item.tolerance, other.elevation + other.tolerance)
    if low > high + 1e-9:
        raise TargetError(
            f"the elevation {item.elevation:g} m at {item.station:g} m contradicts {other.elevation:g} m: {why}"
        )
    exact = [one for one in (other, item) if one.tolerance == 0]
    return exact[0] if exact else replace(other, elevation=0.5 * (low + high), tolerance=0.5 * max(high - low, 0.0))

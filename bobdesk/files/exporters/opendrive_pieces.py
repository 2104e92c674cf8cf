"""A 3D centreline as few cubic pieces, for OpenDRIVE: plan by its length of arc, elevation by station."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.interpolate import Akima1DInterpolator, CubicSpline

from bobdesk.arrays import FloatArray
from bobdesk.track.centreline3d import Centreline3D

_PLAN_TOLERANCE_M = 1e-3
_ELEVATION_TOLERANCE_M = 1e-4
_MOST_ROWS = 64
_SMALLEST_KINK, _KINK = 1e-3, 4.0
# Gauss's points and weights on 0..1, exact to degree 9.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(5)
_NODES, _WEIGHTS = 0.5 * (_NODES + 1), 0.5 * _WEIGHTS


@dataclass(frozen=True)
class PlanPiece:
    """u and v, m, as cubic polynomials of the length of arc p from 0 to `length`, in a turned frame.

    Attributes
    ----------
    station, length
        Where it begins, and how long it is, m.
    x, y, heading
        The frame: its origin, m, and the direction of u, rad.
    u, v
        Four coefficients each, constant first.
    """

    station: float
    length: float
    x: float
    y: float
    heading: float
    u: tuple[float, ...]
    v: tuple[float, ...]


@dataclass(frozen=True)
class ElevationPiece:
    """Elevation, m, from `station` on: a + b d + c d² + e d³ of the distance d from there."""

    station: float
    coefficients: tuple[float, float, float, float]


def stations_of_arc(line: Centreline3D) -> tuple[FloatArray, FloatArray]:
    """Return the length of arc in plan at each row, (n,), m, and the unit tangent there, (n, 2).

    The arc is that of the cubic spline through the rows; chords are shorter by k² h² / 24.
    """
    plan = line.points[:, :2]
    chords = np.hypot(*np.diff(plan, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(chords)])
    way = CubicSpline(along, plan).derivative()
    speeds = np.hypot(*np.moveaxis(way(along[:-1, None] + chords[:, None] * _NODES), -1, 0))
    arcs = chords * (speeds @ _WEIGHTS)
    tangents = way(along)
    return np.concatenate([[0.0], np.cumsum(arcs)]), tangents / np.hypot(*tangents.T)[:, None]


def plan_pieces(line: Centreline3D, stations: FloatArray, tangents: FloatArray) -> list[PlanPiece]:
    """Return pieces that pass every row within 1 mm and follow each other without a kink."""
    plan = line.points[:, :2]

    def fits(first: int, last: int) -> bool:
        length = stations[last] - stations[first]
        cubic = _hermite(plan[first], plan[last], tangents[first], tangents[last], length)
        inner = stations[first + 1 : last] - stations[first]
        found = np.vander(inner, 4, increasing=True) @ cubic
        return bool((np.hypot(*(found - plan[first + 1 : last]).T) <= _PLAN_TOLERANCE_M).all())

    pieces = []
    for first, last in _longest_runs(len(plan), fits):
        length = float(stations[last] - stations[first])
        heading = float(np.arctan2(tangents[first, 1], tangents[first, 0]))
        cosine, sine = np.cos(heading), np.sin(heading)
        cubic = _hermite(plan[first], plan[last], tangents[first], tangents[last], length)
        cubic[0] = 0.0
        u, v = cubic @ np.array([cosine, sine]), cubic @ np.array([-sine, cosine])
        x, y = plan[first].tolist()
        pieces.append(
            PlanPiece(float(stations[first]), length, x, y, heading, tuple(u.tolist()), (0.0, 0.0, *v[2:].tolist()))
        )
    return pieces


def elevation_pieces(line: Centreline3D, stations: FloatArray) -> list[ElevationPiece]:
    """Return pieces that pass every row within 0.1 mm; a kink of the gradient at a row stays a kink."""
    kinks = _kinks(stations, line.elevations)
    parts = pairwise([0, *kinks, len(stations) - 1])
    pieces: list[ElevationPiece] = []
    for first, last in parts:
        pieces += _smooth_elevation(stations[first : last + 1], line.elevations[first : last + 1])
    return pieces


def _kinks(stations: FloatArray, z: FloatArray) -> list[int]:
    """Return the rows where the gradient jumps: it changes there far more than at both neighbours."""
    change = np.abs(np.diff(np.diff(z) / np.diff(stations)))
    beside = np.concatenate([[0.0], change, [0.0]])
    jumps = (change > _SMALLEST_KINK) & (change > _KINK * np.maximum(beside[:-2], beside[2:]))
    return (np.flatnonzero(jumps) + 1).tolist()


def _smooth_elevation(stations: FloatArray, z: FloatArray) -> list[ElevationPiece]:
    # Akima's slopes do not swing beside a place where the gradient changes within a row or two.
    straight = len(z) == 2
    slopes = np.diff(z).repeat(2) / np.diff(stations) if straight else Akima1DInterpolator(stations, z)(stations, 1)

    def cubic_of(first: int, last: int) -> FloatArray:
        length = stations[last] - stations[first]
        values, ways = z[[first, last], None], slopes[[first, last], None]
        return _hermite(values[0], values[1], ways[0], ways[1], length)[:, 0]

    def fits(first: int, last: int) -> bool:
        inner = stations[first + 1 : last] - stations[first]
        found = np.vander(inner, 4, increasing=True) @ cubic_of(first, last)
        return bool((np.abs(found - z[first + 1 : last]) <= _ELEVATION_TOLERANCE_M).all())

    pieces = []
    for first, last in _longest_runs(len(z), fits):
        a, b, c, d = cubic_of(first, last).tolist()
        pieces.append(ElevationPiece(float(stations[first]), (a, b, c, d)))
    return pieces


def _hermite(
    start: FloatArray, end: FloatArray, from_start: FloatArray, to_end: FloatArray, length: float
) -> FloatArray:
    """Return the cubic's coefficients, (4, k), constant first, by values and derivatives at 0 and `length`."""
    chord = (end - start) / length
    second = (3 * chord - 2 * from_start - to_end) / length
    third = (from_start + to_end - 2 * chord) / length**2
    return np.stack([start, from_start, second, third])


def _longest_runs(count: int, fits: Callable[[int, int], bool]) -> list[tuple[int, int]]:
    """Cut rows 0 to count - 1 into runs that `fits` accepts, each doubled as long as it does."""
    runs = []
    first = 0
    while first < count - 1:
        step = 1
        while step < _MOST_ROWS and first + 2 * step < count and fits(first, first + 2 * step):
            step *= 2
        runs.append((first, first + step))
        first += step
    return runs

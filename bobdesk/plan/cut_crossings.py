"""Where a way turns off at a crossing although the line goes straight through it, twice: there a loop was cut.

Around such a place four arms of ink leave: the way comes in on one and leaves on another, and the
other two go straight on from these.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np
from scipy import ndimage
from scipy.spatial import cKDTree

from bobdesk.arrays import BoolArray, FloatArray, IntArray
from bobdesk.plan.polyline_geometry import turns
from bobdesk.plan.raster import Float32Array

# The way turns by this somewhere at a crossing where it was cut, over some 14 pixels, degrees.
_LEAST_KINK = 24.0
# Radii of the circle on which arms are counted, in widths of the line and pixels: at a flat crossing, or
# with a broad stroke, arms part far out only.
_RADII = ((0.8, 5.0), (1.4, 9.0), (2.2, 14.0), (3.4, 22.0))
_INK = 0.4
# From the circle to a second one, to see where an arm is heading, pixels.
_OUT = 8.0
_ARM = 10
# Distance of the centres that are looked at, pixels, and shares of the radius.
_EVERY, _SPREAD = 2, 0.2
_CHUNK = 60_000
_FEWEST_ARMS, _MOST_ARMS = 3, 8
# Within the circle the way turns by more than this, and a line through it by at most so much more than the way:
# a small Kreisel bends at its crossing too; degrees.
_TURN, _MORE = 15.0, 25.0
# A line through a crossing bends evenly: the halves of its turn differ by less, degrees.
_UNEVEN = 28.0
# Two arms nearer to each other than the width and this are one, pixels.
_APART = 4.0


@dataclass(frozen=True)
class CutCrossing:
    """A way comes to a crossing at its point `first` and leaves it at `last`.

    The line goes on from `first` to `ahead` and comes back from `behind` to `last`; both are (x, y) on the
    circle of `radius` pixels around `centre`.  The least `doubt` is the surest.
    """

    first: int
    last: int
    ahead: tuple[float, float]
    behind: tuple[float, float]
    centre: tuple[float, float]
    radius: float
    doubt: float


@dataclass(frozen=True, eq=False)
class _Circle:
    """The way comes into the circle at its point `first` and is out of it at `last`."""

    centre: FloatArray
    radius: float
    first: int
    last: int


def cut_crossings(
    score: Float32Array, way: FloatArray, *, width: float
) -> Generator[float, None, tuple[CutCrossing, ...]]:
    """Return where a way was cut, the surest first; yields the fraction done.

    Parameters
    ----------
    score
        (h, w) ridge, 0 to 1.
    way
        (n, 2) x, y with one pixel between points.
    width
        Width of the line, pixels.
    """
    found: list[CutCrossing] = []
    radii = [widths * width + pixels for widths, pixels in _RADII]
    kinks = np.flatnonzero(turns_along(way) >= _LEAST_KINK)
    centres = _corners(way, kinks, radii=radii)
    nearest = cKDTree(way)
    middles = np.asarray(nearest.query(centres)[1], dtype=np.int64)
    for index, radius in enumerate(radii):
        yield index / len(radii)
        firsts, lasts = _passings(way, centres, middles, radius=radius)
        turning = np.flatnonzero(_turning(way, firsts, lasts, kinks))
        turning = turning[_spread(centres[turning], apart=_SPREAD * radius)]
        count = max(24, round(2 * np.pi * radius))
        rows = max(1, _CHUNK // count)
        for begin in range(0, len(turning), rows):
            part = turning[begin : begin + rows]
            inner = _inked(score, centres[part], radius=radius, count=count)
            outer = _inked(score, centres[part], radius=radius + _OUT, count=count)
            arms = (inner & ~np.roll(inner, 1, axis=1)).sum(axis=1)
            for one in np.flatnonzero((arms >= _FEWEST_ARMS) & (arms <= _MOST_ARMS)):
                place = part[one]
                circle = _Circle(centres[place], radius, int(firsts[place]), int(lasts[place]))
                cut = _cut_at(way, circle, inner[one], outer[one], width=width)
                if cut is not None and _untouched(nearest, cut, width=width):
                    found.append(cut)
            yield (index + begin / len(turning)) / len(radii)
    return _one_each(found)


def turns_along(way: FloatArray) -> FloatArray:
    """Return the angle (n,) by which a way (n, 2) turns over 14 pixels, degrees, 0 at its ends.

    Its points are one pixel apart.
    """
    gap, arm = 2, 10
    result = np.zeros(len(way))
    middle = np.arange(gap + arm, len(way) - gap - arm)
    result[middle] = turns(way, middle, gap=gap, arm=arm)[2]
    return result


def _corners(way: FloatArray, kinks: IntArray, *, radii: list[float]) -> FloatArray:
    """Return centres (k, 2) of circles about where the way turns.

    They are points of the way, and the corners that it rounds off.
    """
    points = np.arange(_ARM + 1, len(way) - _ARM - 1, _EVERY)
    sharp = np.zeros(len(points), dtype=bool)
    corners = [np.zeros((0, 2))]
    for radius in radii:
        firsts, lasts = _passings(way, way[points], points, radius=radius)
        turning = _turning(way, firsts, lasts, kinks)
        sharp |= turning
        there = _intersections(way, firsts[turning], lasts[turning])
        corners.append(there[np.hypot(*(there - way[points[turning]]).T) < 3.0 * radius])
    places = np.concatenate(corners)
    return np.concatenate([way[points[sharp]], places[_spread(places, apart=_EVERY)]])


def _spread(places: FloatArray, *, apart: float) -> IntArray:
    """Return the indices of one place (n, 2) in each square of `apart` pixels."""
    return np.asarray(np.unique(np.round(places / apart), axis=0, return_index=True)[1], dtype=np.int64)


def _passings(way: FloatArray, centres: FloatArray, middles: IntArray, *, radius: float) -> tuple[IntArray, IntArray]:
    """Return where the way was last out of the circles before `middles` and is again after them, (k,), or -1."""
    firsts = np.full(len(middles), -1)
    lasts = np.full(len(middles), -1)
    for lag in range(int(3 * radius)):
        for ends, places in ((firsts, middles - lag), (lasts, middles + lag)):
            inside = np.flatnonzero((places >= _ARM) & (places < len(way) - _ARM) & (ends < 0))
            away = np.hypot(*(way[places[inside]] - centres[inside]).T)
            reached = inside[away >= radius]
            ends[reached] = places[reached]
    return firsts, lasts


def _turning(way: FloatArray, firsts: IntArray, lasts: IntArray, kinks: IntArray) -> BoolArray:
    """Return (k,): whether the way turns between `firsts` and `lasts`, and has one of the `kinks` there."""
    known = (firsts >= 0) & (lasts > firsts)
    turn = np.abs(_angle(way[firsts] - way[firsts - _ARM], way[np.minimum(lasts + _ARM, len(way) - 1)] - way[lasts]))
    sharp = np.searchsorted(kinks, firsts) < np.searchsorted(kinks, lasts, side="right")
    return np.asarray(known & sharp & (turn > _TURN))


def _intersections(way: FloatArray, firsts: IntArray, lasts: IntArray) -> FloatArray:
    """Return (k, 2): where the straight lines into and out of the circles meet."""
    coming, going = way[firsts] - way[firsts - _ARM], way[lasts + _ARM] - way[lasts]
    across = way[lasts] - way[firsts]
    turn = coming[:, 0] * going[:, 1] - coming[:, 1] * going[:, 0]
    share = (across[:, 0] * going[:, 1] - across[:, 1] * going[:, 0]) / np.where(np.abs(turn) < 1e-9, 1e-9, turn)
    return np.asarray(way[firsts] + share[:, None] * coming, dtype=np.float64)


def _inked(score: Float32Array, centres: FloatArray, *, radius: float, count: int) -> BoolArray:
    """Return (n, count): whether there is ink on a circle around each centre (n, 2)."""
    angles = 2 * np.pi * np.arange(count) / count
    x = centres[:, :1] + radius * np.cos(angles)
    y = centres[:, 1:] + radius * np.sin(angles)
    return np.asarray(ndimage.map_coordinates(score, [y, x], order=1, mode="constant") > _INK)


def _angle(first: FloatArray, second: FloatArray) -> FloatArray:
    """Angle from directions (..., 2) to others, degrees, -180 to 180."""
    cross = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
    return np.asarray(np.degrees(np.arctan2(cross, (first * second).sum(axis=-1))), dtype=np.float64)


def _arms(ring: BoolArray, centre: FloatArray, *, radius: float) -> FloatArray:
    """Return the middles (k, 2) of the inked arcs of a circle, (n,) from +x towards +y."""
    count = len(ring)
    starts = np.flatnonzero(ring & ~np.roll(ring, 1))
    ends = np.flatnonzero(ring & ~np.roll(ring, -1))
    if len(starts) and ends[0] < starts[0]:
        ends = np.append(ends[1:], ends[0] + count)
    angles = np.pi * (starts + ends) / count
    return centre + radius * np.column_stack([np.cos(angles), np.sin(angles)])


def _cut_at(
    way: FloatArray, circle: _Circle, inner: BoolArray, outer: BoolArray, *, width: float
) -> CutCrossing | None:
    """Return the arms on which the line goes straight on, or None where there are no two.

    `inner` and `outer`, (n,) and (m,), say where there is ink on the circle and on a larger one.
    """
    entry, leave = way[circle.first], way[circle.last]
    arms = _arms(inner, circle.centre, radius=circle.radius)
    beyond = _arms(outer, circle.centre, radius=circle.radius + _OUT)
    of_the_way = np.minimum(np.hypot(*(arms - entry).T), np.hypot(*(arms - leave).T)) <= 0.25 * circle.radius
    arms = arms[~of_the_way]
    if len(arms) < 2 or len(beyond) < 2:
        return None
    away = np.hypot(*(arms[:, None] - beyond[None]).transpose(2, 0, 1))
    goes_on = away.min(axis=1) < 1.8 * _OUT
    outwards = (beyond[away.argmin(axis=1)] - arms)[goes_on]
    arms = arms[goes_on]
    if len(arms) < 2:
        return None
    coming, going = entry - way[circle.first - _ARM], way[circle.last + _ARM] - leave
    ahead, uneven_ahead = _bend(coming, arms - entry, outwards)
    behind, uneven_behind = _bend(-outwards, leave - arms, going)
    turn = np.maximum(ahead[:, None], behind[None, :])
    doubt = turn + 0.5 * (uneven_ahead[:, None] + uneven_behind[None, :])
    doubt[np.hypot(*(arms[:, None] - arms[None]).transpose(2, 0, 1)) < width + _APART] = np.inf
    one, two = np.unravel_index(int(doubt.argmin()), doubt.shape)
    turn_of_way = abs(float(_angle(coming, going)))
    if not np.isfinite(doubt[one, two]) or turn[one, two] > turn_of_way + _MORE:
        return None
    return CutCrossing(
        circle.first,
        circle.last,
        (float(arms[one, 0]), float(arms[one, 1])),
        (float(arms[two, 0]), float(arms[two, 1])),
        (float(circle.centre[0]), float(circle.centre[1])),
        circle.radius,
        float(doubt[one, two]) - 0.5 * turn_of_way,
    )


def _bend(coming: FloatArray, across: FloatArray, going: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return by how much lines turn that come, cross the circle and go on (k, 2), and how unevenly, degrees.

    The turn of a line that bends too unevenly is infinite.
    """
    one, two = _angle(coming, across), _angle(across, going)
    uneven = np.abs(one - two)
    return np.where(uneven < _UNEVEN, np.abs(one + two), np.inf), uneven


def _untouched(way: cKDTree, cut: CutCrossing, *, width: float) -> bool:
    """Whether the way uses neither arm: at a crossing that it passes twice it does."""
    return bool(np.all(way.query(np.array([cut.ahead, cut.behind]))[0] > max(3.0, 0.5 * width)))


def _one_each(found: list[CutCrossing]) -> tuple[CutCrossing, ...]:
    """Return the surest of those with one radius at one place, the surest place first."""
    kept: list[CutCrossing] = []
    for cut in sorted(found, key=lambda cut: cut.doubt):
        if not any(same_place(cut, other) and cut.radius == other.radius for other in kept):
            kept.append(cut)
    return tuple(kept)


def same_place(one: CutCrossing, other: CutCrossing) -> bool:
    """Return whether the centre of `one` lies in the circle of `other`."""
    return bool(np.hypot(one.centre[0] - other.centre[0], one.centre[1] - other.centre[1]) <= other.radius)

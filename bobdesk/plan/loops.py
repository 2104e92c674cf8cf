"""Around a Kreisel: where the cheapest way was cut at a crossing, the way that goes straight on and comes back.

What is found is a proposal: the user looks at it.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass, replace

import numpy as np
from scipy import ndimage

from bobdesk.arrays import BoolArray, FloatArray
from bobdesk.plan.cheapest_path import cheapest_path, path_points
from bobdesk.plan.cut_crossings import CutCrossing, cut_crossings, same_place, turns_along
from bobdesk.plan.double_edge import centred
from bobdesk.plan.polyline_geometry import resampled
from bobdesk.plan.raster import Float32Array
from bobdesk.plan.ridge import ridge_along, step_cost
from bobdesk.plan.rough_way import RoughWay
from bobdesk.plan.stages import at_fraction

# A picture with more is too full for a proposal.
_MOST_LOOPS = 6
_MOST_TRIES = 8
_INK = 0.3
# The share of a loop that shows ink, and that is not the way that was found before; its length, in widths
# and pixels.
_INKED, _FRESH = 0.85, 0.7
_SHORTEST_WIDTHS, _SHORTEST = 4.0, 40.0
# What keeps a loop from being cut again: the cost of a pixel beside the ink next to the crossing, the ridge
# between two arms there, and the factor on the cost along the way that was found before.
_OFF, _PARTED, _TAKEN = 5_000.0, 0.45, 4.0
# A loop turns by no more than this over some 14 pixels, and where it goes straight through the crossing by
# so much less than the way that was cut; degrees.
_KINK, _SMOOTHER = 60.0, 2.0


@dataclass(frozen=True, eq=False)
class _Loop:
    """A way (n, 2) and the points between which it has a new loop; the loop may be cut itself."""

    way: FloatArray
    cut: CutCrossing
    first: int
    last: int

    @property
    def whole(self) -> bool:
        return _sharpest(self.way, self.first, self.last) <= _KINK


def around_loops(rough: RoughWay) -> Generator[float, None, RoughWay | None]:
    """Return the way that goes around the loops that `rough` cuts, or None where it cuts none."""
    plain = found = way = resampled(rough.middle, step=1.0)
    wrong: list[CutCrossing] = []
    tried: list[CutCrossing] = []
    cut_loop: _Loop | None = None
    for number in range(_MOST_LOOPS):
        loop = yield from at_fraction(_next_loop(rough, way, wrong, tried), number / _MOST_LOOPS)
        if loop is None:
            if cut_loop is None:
                break
            wrong.append(cut_loop.cut)
            way, cut_loop = found, None
            continue
        if cut_loop is not None:
            more = len(loop.way) - len(way)
            loop = replace(
                loop,
                cut=cut_loop.cut,
                first=min(loop.first, cut_loop.first),
                last=max(loop.last, cut_loop.last + more),
            )
        way = loop.way
        cut_loop = None if loop.whole else loop
        if cut_loop is None:
            found = way
    return None if found is plain else replace(rough, middle=found)


def _next_loop(
    rough: RoughWay, way: FloatArray, wrong: list[CutCrossing], tried: list[CutCrossing]
) -> Generator[float, None, _Loop | None]:
    """Return `way` with the surest of the loops that it cuts.

    At the places in `wrong` nothing is found; what is looked at in vain goes to `tried`.
    """
    cuts = yield from at_fraction(cut_crossings(rough.score, way, width=rough.section.width), 0.2)
    for cut in cuts:
        known = any(same_place(cut, other) and cut.radius == other.radius for other in tried)
        if known or any(same_place(cut, other) for other in wrong):
            continue
        if len(tried) == _MOST_TRIES:
            break
        joined = yield from at_fraction(_joined(rough, way, cut), 0.5)
        if joined is not None:
            through = round(2 * cut.radius)
            last = cut.last + len(joined) - len(way)
            left = max(_sharpest(joined, cut.first, cut.first + through), _sharpest(joined, last - through, last))
            if left <= _sharpest(way, cut.first, cut.last) - _SMOOTHER:
                return _Loop(joined, cut, cut.first, last)
        tried.append(cut)
    return None


def _sharpest(way: FloatArray, first: int, last: int) -> float:
    """Return by how much `way` turns at most from the point `first` to `last`, degrees."""
    return float(turns_along(way[max(0, first - 17) : last + 18]).max(initial=0.0))


def _joined(rough: RoughWay, way: FloatArray, cut: CutCrossing) -> Generator[float, None, FloatArray | None]:
    """Return `way` with the loop at a crossing, or None if the ink makes none."""
    height, width = rough.score.shape
    ends = [(round(y), round(x)) for x, y in (cut.ahead, cut.behind)]
    if any(not (0 <= row < height and 0 <= column < width) for row, column in ends):
        return None
    taken = _covered(way, shape=rough.score.shape, width=rough.section.width)
    cost, ridge = _blocked(rough.score, taken, cut)
    yield 0.2
    points = path_points((yield from at_fraction(cheapest_path(cost, ridge, ends), 0.4)))
    if len(points) < _SHORTEST_WIDTHS * rough.section.width + _SHORTEST:
        return None
    fresh = ~taken[points[:, 1].astype(np.intp), points[:, 0].astype(np.intp)]
    if np.mean(fresh) < _FRESH or np.mean(ridge_along(rough.score, points) > _INK) < _INKED:
        return None
    joined = np.concatenate([way[: cut.first + 1], points, way[cut.last :]])
    middle = yield from at_fraction(centred(rough.share, joined, section=rough.section), 0.8)
    return resampled(middle, step=1.0)


def _covered(way: FloatArray, *, shape: tuple[int, ...], width: float) -> BoolArray:
    """Return the pixels (h, w) that the line along `way` covers."""
    covered = np.zeros(shape, dtype=bool)
    columns = np.clip(np.round(way[:, 0]).astype(np.intp), 0, shape[1] - 1)
    rows = np.clip(np.round(way[:, 1]).astype(np.intp), 0, shape[0] - 1)
    covered[rows, columns] = True
    return np.asarray(ndimage.binary_dilation(covered, iterations=max(2, round(0.5 * width))))


def _blocked(score: Float32Array, taken: BoolArray, cut: CutCrossing) -> tuple[Float32Array, Float32Array]:
    """Return cost and ridge (h, w) that leave no way through the crossing, and rather none where `taken`."""
    cost, ridge = step_cost(score), score.copy()
    cost[taken] *= np.float32(_TAKEN)
    x, y = cut.centre
    reach = round(3 * cut.radius)
    top, left = max(0, round(y) - reach), max(0, round(x) - reach)
    window = (slice(top, round(y) + reach + 1), slice(left, round(x) + reach + 1))
    down, right = np.ogrid[: ridge[window].shape[0], : ridge[window].shape[1]]
    away = np.hypot(down + top - y, right + left - x)
    blank = score[window] < np.where(away < 0.6 * reach, _PARTED, _INK)
    crossing = away < cut.radius - 2.0
    cost[window][crossing | (blank & (away < reach))] = _OFF
    ridge[window][crossing] = 0.0
    return cost, ridge

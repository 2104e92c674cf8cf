"""Profiles that the data allow, drawn at random: all of them equally likely."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass
from typing import Any

import numpy as np

from bobdesk.arrays import FloatArray, IntArray, frozen
from bobdesk.errors import TargetError
from bobdesk.progress import Progress
from bobdesk.solve.anchors import Anchors
from bobdesk.solve.envelope import GRID, allowed_elevations, grid_of
from bobdesk.solve.targets import Targets

# Steps a cell until a chain has forgotten where it began; with a bounded change of gradient moves are smaller.
_STEPS_A_CELL, _STEPS_A_SMOOTH_CELL = 40, 150
_STEPS_A_REPORT = 200
_NOTHING = 1e-12


@dataclass(frozen=True, eq=False)
class Bundle:
    """Profiles within limits, drop and known elevations.

    Attributes
    ----------
    stations : (n,)
        m, in true size.
    elevations : (c, n)
        Of c profiles, m.
    """

    stations: FloatArray
    elevations: FloatArray

    def __post_init__(self) -> None:
        for name in ("stations", "elevations"):
            object.__setattr__(self, name, frozen(getattr(self, name)))

    def quantiles(self, *shares: float) -> FloatArray:
        """Return the elevations below which these shares of the profiles lie, (len(shares), n), m."""
        found: FloatArray = np.quantile(self.elevations, shares, axis=0)
        return found


@dataclass(frozen=True, eq=False)
class _Bounds:
    """Limits of elevations (n,), gradients of the cells (n-1,), and changes of the gradient (n-2,)."""

    cells: FloatArray
    low: FloatArray
    high: FloatArray
    min_gradient: float
    max_gradient: float
    most: FloatArray | None


def sample_profiles(
    anchors: Anchors,
    targets: Targets,
    *,
    count: int = 200,
    seed: int = 1,
    largest_change: float | None = None,
    scale: float = 1.0,
    step: float = GRID,
) -> Generator[Progress, None, Bundle]:
    """Draw profiles of one gradient a cell, uniformly among all that the data allow, by hit-and-run.

    From a profile well inside the limits each of `count` chains goes on a random way along random
    directions: a stretch of the line is lifted as a block or as a smooth bump, by an amount drawn
    evenly from all that keep to the limits. That leaves the uniform distribution as it is,
    and reaches it from anywhere.

    The profiles are likely only in the sense of a volume. Of fine grids nearly all profiles are rough
    and keep near the middle of the band, which real tracks do not know; the envelope is the bound.

    Parameters
    ----------
    anchors, targets, scale
        As for `envelope`.
    count
        Of profiles.
    seed
        The same seed gives the same profiles.
    largest_change
        Of the gradient per metre, 1/m; None for no bound.
    step
        Largest length of a cell, m.

    Raises
    ------
    TargetError
        If no profile meets all.

    References
    ----------
    R. L. Smith, Efficient Monte Carlo procedures for generating points uniformly distributed over
    bounded regions, Operations Research 32 (1984) 1296.
    """
    at = grid_of(anchors, scale=scale, step=step)
    cells = np.diff(at)
    low, high = allowed_elevations(at, anchors, scale=scale)
    most = None if largest_change is None else largest_change * 0.5 * (cells[1:] + cells[:-1])
    bounds = _Bounds(cells, low, high, targets.min_gradient, targets.max_gradient, most)
    # A row a station: what is done to all profiles at once then runs through memory in order, which is much faster.
    elevations = np.tile(_well_inside(bounds)[:, None], (1, count))
    random = np.random.default_rng(seed)
    steps = len(cells) * (_STEPS_A_CELL if most is None else _STEPS_A_SMOOTH_CELL)
    held = high - low <= _NOTHING
    span_of = _spans(np.flatnonzero(held), len(at))
    if most is None and (narrow := np.flatnonzero(~held & np.isfinite(high - low))).size:
        # Hardly anything moves that takes a station with a small tolerance along, so half of the moves leave them out.
        between = _spans(np.flatnonzero(held | np.isfinite(high - low)), len(at))
        span_of = [*span_of, *between, *([(station - 1, station + 1) for station in narrow.tolist()])]
        steps *= 2
    for number in range(steps if span_of else 0):
        if number % _STEPS_A_REPORT == 0:
            yield Progress(number / steps, "profiles at random")
        start, end = span_of[int(random.integers(len(span_of)))]
        first, last = _window(random, start + 1, end - 1, smooth=most is not None)
        _moved(elevations, first, _direction(random, last - first + 1), bounds, random)
    return Bundle(at, elevations.T)


def _spans(held: IntArray, total: int) -> list[tuple[int, int]]:
    """Return the held stations on both sides of each that is not, so that long spans are moved more often."""
    spans = [(int(a), int(b)) for a, b in zip(held, [*held[1:], total], strict=True) if b - a > 1]
    return [span for span in spans for _ in range(span[1] - span[0] - 1)]


def _window(random: np.random.Generator, first: int, last: int, *, smooth: bool) -> tuple[int, int]:
    """Return the first and last station of a random piece of a span; of all lengths where moves must be smooth."""
    if not smooth:
        one, other = random.integers(first, last + 1, 2).tolist()
        return min(one, other), max(one, other)
    length = round(float(np.exp(random.uniform(0, np.log(last - first + 1)))))
    begin = int(random.integers(first - length + 1, last + 1))
    return max(begin, first), min(begin + length - 1, last)


def _direction(random: np.random.Generator, count: int) -> FloatArray:
    if random.random() < 0.5:
        return np.ones(count)
    bump: FloatArray = np.sin(np.pi * np.arange(1, count + 1) / (count + 1)) ** 2
    return bump


def _moved(elevations: FloatArray, first: int, lift: FloatArray, bounds: _Bounds, random: np.random.Generator) -> None:
    """Move all profiles, in place, along one direction by as much as is drawn for each."""
    total, count = elevations.shape
    last = first + len(lift) - 1
    # The stations whose gradients and changes of gradient the lift touches, as far as there are such.
    begin, end = max(first - 2, 0), min(last + 3, total)
    way = np.zeros(end - begin)
    way[first - begin : last - begin + 1] = lift
    here = elevations[begin:end]
    cells = bounds.cells[begin : end - 1]
    least = np.full(count, -np.inf)
    largest = np.full(count, np.inf)

    def narrow(values: FloatArray, along: FloatArray, low: FloatArray | float, high: FloatArray | float) -> None:
        found = np.flatnonzero(np.abs(along) > _NOTHING)
        if not len(found):
            return
        whole = len(found) == found[-1] - found[0] + 1
        moves: slice | IntArray = slice(found[0], found[-1] + 1) if whole else found
        along = along[moves]
        one = (low[moves] if isinstance(low, np.ndarray) else low) / along
        other = (high[moves] if isinstance(high, np.ndarray) else high) / along
        there = values[moves] / along[:, None]
        np.maximum(least, (np.minimum(one, other)[:, None] - there).max(axis=0), out=least)
        np.minimum(largest, (np.maximum(one, other)[:, None] - there).min(axis=0), out=largest)

    narrow(here, way, bounds.low[begin:end], bounds.high[begin:end])
    gradients, turned = (here[:-1] - here[1:]) / cells[:, None], (way[:-1] - way[1:]) / cells
    narrow(gradients, turned, bounds.min_gradient, bounds.max_gradient)
    if bounds.most is not None and end - begin > 2:
        most = bounds.most[begin : end - 2]
        narrow(gradients[1:] - gradients[:-1], turned[1:] - turned[:-1], -most, most)
    least, largest = np.minimum(least, 0.0), np.maximum(largest, 0.0)
    amount = least + random.random(count) * (largest - least)
    here += way[:, None] * amount


def _well_inside(bounds: _Bounds) -> FloatArray:
    """Return the elevations of a profile that keeps as far from all limits as can be, (n,), m."""
    from scipy import sparse
    from scipy.optimize import linprog

    cells, count = bounds.cells, len(bounds.low)
    at = np.arange(count - 1)
    values, columns = np.concatenate([1 / cells, -1 / cells]), np.concatenate([at, at + 1])
    # The stubs of SciPy's sparse arrays and of linprog do not know each other.
    gradients: Any = sparse.csr_array((values, (np.tile(at, 2), columns)), shape=(count - 1, count))
    rows: list[Any] = [gradients, -gradients]
    limits = [np.full(count - 1, bounds.max_gradient), np.full(count - 1, -bounds.min_gradient)]
    room = [np.full(2 * (count - 1), bounds.max_gradient - bounds.min_gradient)]
    if bounds.most is not None:
        changes = gradients[1:] - gradients[:-1]
        rows += [changes, -changes]
        limits += [bounds.most, bounds.most]
        room += [bounds.most, bounds.most]
    free = np.flatnonzero(bounds.high - bounds.low > _NOTHING)
    some: Any = sparse.csr_array((np.ones(len(free)), (np.arange(len(free)), free)), shape=(len(free), count))
    span = np.minimum(bounds.high - bounds.low, 1.0)[free]
    rows.append(-some)
    limits.append(-bounds.low[free])
    room.append(span)
    shares: Any = sparse.csr_array(np.concatenate(room)[:, None])
    matrix: Any = sparse.csr_array(sparse.hstack([sparse.vstack(rows), shares]))
    ends = np.stack([bounds.low, bounds.high], axis=1)
    within: Any = np.vstack([ends, [[0.0, 0.1]]])
    # The last unknown is the share of its room that every limit keeps free; 0.1 and more is well inside.
    found: Any = linprog(
        np.append(np.zeros(count), -1.0),
        matrix,
        np.concatenate(limits),
        bounds=within,
    )
    if found.status != 0:
        raise TargetError("no profile within the limits meets the drop and the known elevations")
    elevations: FloatArray = np.clip(found.x[:-1], bounds.low, bounds.high)
    return elevations

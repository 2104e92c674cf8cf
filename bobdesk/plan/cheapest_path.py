"""The cheapest way over a picture from click to click, by Dijkstra on the pixels that can matter.

SciPy's Dijkstra cannot be stopped, so the graphs are kept small: first the pixels with some ridge; where
these do not connect the clicks (dashes), all pixels of a coarse copy, then a corridor around what it found.
"""

from __future__ import annotations

from collections.abc import Generator
from itertools import pairwise

import numpy as np
import numpy.typing as npt
from scipy import ndimage
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from bobdesk.arrays import BoolArray, FloatArray, IntArray
from bobdesk.errors import InputError
from bobdesk.plan.raster import Float32Array

Pixel = tuple[int, int]

# About 0.1 s of Dijkstra; a larger graph is not tried at full size.
_MOST_NODES = 250_000
# Steps along a line that has been used by an earlier leg cost this much more: a second via in a loop
# sends the line around it and not back the way it came.
_USED_AGAIN = 3.0
_STEPS = ((-1, -1), (-1, 0), (-1, 1), (0, -1), (0, 1), (1, -1), (1, 0), (1, 1))


def pixel_graph(
    cost: Float32Array, allowed: BoolArray
) -> tuple[csr_array, npt.NDArray[np.int32], npt.NDArray[np.int32]]:
    """Return the 8-neighbour graph of the `allowed` pixels, their numbers (h, w) or -1, and places (n, 2).

    An edge costs its length times the mean cost of its two pixels.
    """
    height, width = cost.shape
    count = int(np.count_nonzero(allowed))
    numbers = np.full((height + 2, width + 2), -1, dtype=np.int32)
    numbers[1:-1, 1:-1][allowed] = np.arange(count, dtype=np.int32)
    rows, columns = np.nonzero(allowed)
    neighbours = np.empty((count, len(_STEPS)), dtype=np.int32)
    for index, (down, right) in enumerate(_STEPS):
        neighbours[:, index] = numbers[rows + 1 + down, columns + 1 + right]
    own = cost[allowed]
    lengths = np.array([0.5 * np.hypot(*step) for step in _STEPS], dtype=np.float32)
    weights = (own[:, None] + own[neighbours]) * lengths
    exists = neighbours >= 0
    starts = np.concatenate([[0], np.cumsum(exists.sum(axis=1))]).astype(np.int32)
    graph = csr_array((weights[exists].astype(np.float64), neighbours[exists], starts), shape=(count, count))
    return graph, numbers[1:-1, 1:-1], np.column_stack([rows, columns]).astype(np.int32)


def _way(predecessors: npt.NDArray[np.int32], *, goal: int) -> IntArray:
    nodes = [goal]
    while predecessors[nodes[-1]] >= 0:
        nodes.append(int(predecessors[nodes[-1]]))
    return np.array(nodes[::-1], dtype=np.int64)


def _connected(allowed: BoolArray, stops: list[Pixel]) -> bool:
    labels, _ = ndimage.label(allowed, structure=np.ones((3, 3), dtype=int))
    found = {int(labels[stop]) for stop in stops}
    return len(found) == 1 and 0 not in found


def _legs(cost: Float32Array, allowed: BoolArray, stops: list[Pixel]) -> Generator[float, None, list[IntArray]]:
    """Return the cheapest way of every leg as (m, 2) row, column."""
    cost = cost.copy()
    legs: list[IntArray] = []
    for index, (start, goal) in enumerate(pairwise(stops)):
        graph, numbers, places = pixel_graph(cost, allowed)
        yield (index + 0.5) / (len(stops) - 1)
        _, predecessors = dijkstra(graph, indices=np.array([numbers[start]]), return_predecessors=True)
        goal_number = int(numbers[goal])
        if predecessors[0, goal_number] < 0 and start != goal:
            raise InputError(
                f"No way leads from the point at column {start[1]}, row {start[0]} of the work copy onwards."
            )
        way = places[_way(predecessors[0], goal=goal_number)].astype(np.int64)
        legs.append(way)
        used = np.zeros(cost.shape, dtype=bool)
        used[tuple(way[:-4].T)] = True
        cost[ndimage.binary_dilation(used, iterations=2)] *= np.float32(_USED_AGAIN)
        yield (index + 1) / (len(stops) - 1)
    return legs


def pooled(score: Float32Array, *, factor: int) -> Float32Array:
    """Return the largest score in each `factor` x `factor` block: a thin line stays whole."""
    height, width = score.shape
    padded = np.pad(score, ((0, -height % factor), (0, -width % factor)))
    rows, columns = padded.shape[0] // factor, padded.shape[1] // factor
    return np.asarray(padded.reshape(rows, factor, columns, factor).max(axis=(1, 3)))


def _around(ways: list[IntArray], *, shape: tuple[int, int], factor: int, reach: int) -> BoolArray:
    """Pixels within some `reach` blocks of ways on a copy pooled by `factor`."""
    rows, columns = -(-shape[0] // factor), -(-shape[1] // factor)
    blocks = np.zeros((rows, columns), dtype=bool)
    for way in ways:
        blocks[tuple(way.T)] = True
    blocks = ndimage.binary_dilation(blocks, structure=np.ones((3, 3), dtype=bool), iterations=reach)
    return np.repeat(np.repeat(blocks, factor, axis=0), factor, axis=1)[: shape[0], : shape[1]]


def cheapest_path(
    cost: Float32Array, score: Float32Array, stops: list[Pixel]
) -> Generator[float, None, list[IntArray]]:
    """Return the cheapest way through all `stops` (row, column), one (m, 2) array of pixels a leg.

    Parameters
    ----------
    cost
        (h, w) cost of a step of one pixel.
    score
        (h, w) ridge strength from 0 to 1: where ways are looked for first.
    stops
        Start, vias and finish.
    """
    for threshold in (0.25, 0.1):
        allowed = ndimage.binary_dilation(score > threshold, iterations=2)
        for stop in stops:
            allowed[stop] = True
        yield 0.1
        if np.count_nonzero(allowed) <= _MOST_NODES and _connected(allowed, stops):
            yield 0.2
            return (yield from _legs(cost, allowed, stops))
    factor = max(2, int(np.ceil((score.size / _MOST_NODES) ** 0.5)))
    coarse_stops = [(row // factor, column // factor) for row, column in stops]
    coarse_cost = -pooled(-cost, factor=factor)
    everywhere = np.ones(coarse_cost.shape, dtype=bool)
    yield 0.3
    coarse = yield from _legs(coarse_cost, everywhere, coarse_stops)
    corridor = _around(coarse, shape=(cost.shape[0], cost.shape[1]), factor=factor, reach=3)
    return (yield from _legs(cost, corridor, stops))


def path_points(legs: list[IntArray]) -> FloatArray:
    """Join the legs (m, 2) row, column to one line of (n, 2) x, y."""
    joined = [legs[0], *(leg[1:] for leg in legs[1:])]
    return np.concatenate(joined)[:, ::-1].astype(np.float64)

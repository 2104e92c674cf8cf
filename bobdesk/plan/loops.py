"""A way that may not turn sharply: it goes around a Kreisel where the cheapest path cuts it.

A state is a pixel with one of 24 directions of travel.  A step turns by one direction at most, so that a
short cut at a crossing is not open to it.  What is found is a proposal: at a crossing with another line it
may also go wrong, and the user looks at it.
"""

from __future__ import annotations

from collections.abc import Generator

import numpy as np
import numpy.typing as npt
from scipy import ndimage
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from bobdesk.arrays import FloatArray, IntArray
from bobdesk.plan.cheapest_path import Pixel
from bobdesk.plan.raster import Float32Array
from bobdesk.plan.stages import at_fraction

_DIRECTIONS = 24
# Lengths of a step, pixels, the stiffest first: curves down to 19, then 15 pixels of radius.
_STEPS = (5.0, 4.0)
# A turn by one direction costs this many pixels of way.
_TURN = 2.0
_INK = 0.3
# The mean ridge along a straight piece of a line.
_STRAIGHT = 0.55
# About 0.3 s of Dijkstra in one piece; beyond it the picture is too full for a proposal.
_MOST_STATES = 1_500_000


def _thin(score: Float32Array) -> npt.NDArray[np.bool_]:
    """Pixels on or beside a ridge's crest."""
    crest = score >= 0.8 * ndimage.maximum_filter(score, size=5)
    return np.asarray(crest & (score > _INK))


def _oriented(score: Float32Array, direction: int, *, half: int) -> Float32Array:
    """The mean ridge along a straight piece of `half` pixels to both sides of each pixel."""
    angle = 2 * np.pi * direction / _DIRECTIONS
    height, width = score.shape
    padded = np.pad(score, half)
    total = np.zeros_like(score)
    for offset in range(-half, half + 1):
        down = half + round(offset * float(np.sin(angle)))
        right = half + round(offset * float(np.cos(angle)))
        total += padded[down : down + height, right : right + width]
    return np.asarray(total / (2 * half + 1), dtype=np.float32)


def smooth_way(score: Float32Array, stops: list[Pixel], *, width: float) -> Generator[float, None, FloatArray | None]:
    """Return the best way (n, 2) x, y through `stops` (row, column) without sharp turns, or None.

    Parameters
    ----------
    score
        (h, w) ridge, 0 to 1.
    width
        Width of the line: a piece must be straight over more than a crossing is wide, pixels.
    """
    rows, columns = np.ogrid[: score.shape[0], : score.shape[1]]
    half = max(7, round(1.2 * width))
    wide = ndimage.maximum_filter(score, size=3) if width < 5.0 else score
    allowed = _thin(wide)
    for stop in stops:
        allowed |= (rows - stop[0]) ** 2 + (columns - stop[1]) ** 2 <= 9
    yield 0.1
    places = np.argwhere(allowed).astype(np.int32)
    pixels = np.full(score.shape, -1, dtype=np.int32)
    pixels[places[:, 0], places[:, 1]] = np.arange(len(places), dtype=np.int32)
    numbers = np.full((_DIRECTIONS, len(places)), -1, dtype=np.int32)
    along = np.empty((_DIRECTIONS // 2, len(places)), dtype=np.float32)
    count = 0
    for direction in range(_DIRECTIONS // 2):
        along[direction] = _oriented(wide, direction, half=half)[places[:, 0], places[:, 1]]
        usable = along[direction] > _STRAIGHT
        size = int(np.count_nonzero(usable))
        for one in (direction, direction + _DIRECTIONS // 2):
            numbers[one][usable] = np.arange(count, count + size, dtype=np.int32)
            count += size
        yield 0.1 + 0.6 * direction / _DIRECTIONS
    if count == 0 or count > _MOST_STATES:
        return None
    ends = [_states_near(places, numbers, stop) for stop in stops]
    if any(len(states) == 0 for states in ends):
        return None
    for step in _STEPS:
        graph = yield from at_fraction(_turning_graph(pixels, places, numbers, along, count=count, step=step), 0.6)
        way = yield from at_fraction(_cheapest(graph, ends), 0.8)
        if way is not None:
            pixel_of = np.empty(count, dtype=np.int64)
            for states in numbers:
                there = np.flatnonzero(states >= 0)
                pixel_of[states[there]] = there
            return places[pixel_of[way]][:, ::-1].astype(np.float64)
    return None


def _cheapest(graph: csr_array, ends: list[IntArray]) -> Generator[float, None, IntArray | None]:
    """Return the states (n,) of the cheapest way through the stops, or None where there is none."""
    sources = ends[0]
    ways: list[IntArray] = []
    for goals in ends[1:]:
        distances, predecessors, _ = dijkstra(graph, indices=sources, return_predecessors=True, min_only=True)
        goal = int(goals[np.argmin(distances[goals])])
        if not np.isfinite(distances[goal]):
            return None
        way = [goal]
        while predecessors[way[-1]] >= 0:
            way.append(int(predecessors[way[-1]]))
        ways.append(np.array(way[::-1], dtype=np.int64))
        sources = np.array([goal], dtype=np.int64)
        yield 0.9
    return np.concatenate(ways)


def _states_near(places: npt.NDArray[np.int32], numbers: npt.NDArray[np.int32], pixel: Pixel) -> IntArray:
    """Return the states (k,) within three pixels of a pixel."""
    near = np.abs(places - np.array(pixel)).max(axis=1) <= 3
    found = numbers[:, near].ravel()
    return found[found >= 0].astype(np.int64)


def _turning_graph(
    pixels: npt.NDArray[np.int32],
    places: npt.NDArray[np.int32],
    numbers: npt.NDArray[np.int32],
    along: Float32Array,
    *,
    count: int,
    step: float,
) -> Generator[float, None, csr_array]:
    """Return the graph of the `count` states.

    `pixels` (h, w) counts the usable pixels, at `places` (n, 2) row, column; `numbers` (24, n) are their
    states or -1; `along` (12, n) is the ridge along each direction.
    """
    height, width = pixels.shape
    heads, tails, weights = [], [], []
    for direction in range(_DIRECTIONS):
        here = np.flatnonzero(numbers[direction] >= 0)
        for turn in (-1, 0, 1):
            towards = (direction + turn) % _DIRECTIONS
            angle = 2 * np.pi * (direction + 0.5 * turn) / _DIRECTIONS
            move = np.array([round(step * float(np.sin(angle))), round(step * float(np.cos(angle)))])
            there = places[here] + move
            inside = np.all((there >= 0) & (there < [height, width]), axis=1)
            goals = np.full(len(here), -1, dtype=np.int64)
            goals[inside] = pixels[there[inside, 0], there[inside, 1]]
            reached = goals >= 0
            reached[reached] = numbers[towards, goals[reached]] >= 0
            line = along[towards % (_DIRECTIONS // 2), goals[reached]].astype(np.float64)
            heads.append(numbers[direction, here[reached]])
            tails.append(numbers[towards, goals[reached]])
            weights.append(float(np.hypot(*move)) / (0.02 + line**2) + _TURN * abs(turn))
        yield direction / _DIRECTIONS
    return csr_array((np.concatenate(weights), (np.concatenate(heads), np.concatenate(tails))), shape=(count, count))

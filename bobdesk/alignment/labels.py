"""Which stations are left curve, straight or right curve: exact optima over all labellings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray, IntArray, frozen

STATES = np.array([-1, 0, 1])
_CLIP = 1.5
_IMPOSSIBLE = -1e300


@dataclass(frozen=True, eq=False)
class Blocks:
    """A line cut wherever a state becomes better than another; an optimum changes only there.

    Attributes
    ----------
    edges : (b+1,)
        Stations of the cuts, m, from 0 to the line's length.
    scores : (b, 3)
        Gain of calling each block right curve, straight, left curve, m.
    """

    edges: FloatArray
    scores: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "edges", frozen(self.edges))
        object.__setattr__(self, "scores", frozen(self.scores, columns=3))


def blocks_of(stations: FloatArray, curvature: FloatArray, threshold: float) -> Blocks:
    """Cut the line where the curvature crosses -threshold, 0 and threshold.

    The gain per metre of calling a place a left curve is (curvature - threshold) / threshold,
    clipped to ±1.5, of a right curve the same with the sign turned, of a straight 0. Between two
    cuts no two states change their order, so that the best labelling changes at cuts alone: the
    optimum over all n stations is found over a few dozen blocks.
    """
    levels = np.array([-threshold, 0.0, threshold])
    crossings = [_crossings(stations, curvature - level) for level in levels]
    edges = np.unique(np.concatenate([[stations[0]], *crossings, [stations[-1]]]))
    left = np.clip((curvature - threshold) / threshold, -_CLIP, _CLIP)
    right = np.clip((-curvature - threshold) / threshold, -_CLIP, _CLIP)
    scores = np.column_stack(
        [_integral(stations, right, edges), np.zeros(len(edges) - 1), _integral(stations, left, edges)]
    )
    return Blocks(edges, scores)


def _crossings(stations: FloatArray, values: FloatArray) -> FloatArray:
    """Return the stations at which values change sign, by linear interpolation."""
    before, after = values[:-1], values[1:]
    at = np.flatnonzero((before < 0) != (after < 0))
    share = before[at] / (before[at] - after[at])
    crossings: FloatArray = stations[at] + share * (stations[at + 1] - stations[at])
    return crossings


def _integral(stations: FloatArray, values: FloatArray, edges: FloatArray) -> FloatArray:
    steps = np.diff(stations)
    running = np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * steps)])
    index = np.clip(np.searchsorted(stations, edges, side="right") - 1, 0, len(stations) - 2)
    into = edges - stations[index]
    slope = (values[index + 1] - values[index]) / steps[index]
    at_edges = running[index] + into * (values[index] + 0.5 * slope * into)
    return np.diff(at_edges)


def best_labels(blocks: Blocks, *, change_cost: float) -> IntArray:
    """Return the labelling of largest total gain, where each change costs `change_cost` metres.

    Viterbi's recursion over the blocks, exact. Labels are -1 right, 0 straight, 1 left; (b,).
    """
    count = len(blocks.scores)
    came_from = np.zeros((count, 3), dtype=np.int64)
    value = blocks.scores[0].copy()
    for block in range(1, count):
        best = int(value.argmax())
        changed = value[best] - change_cost
        came_from[block] = np.where(value >= changed, np.arange(3), best)
        value = np.maximum(value, changed) + blocks.scores[block]
    return _trace_back(came_from, int(value.argmax()))


def best_labels_of_count(blocks: Blocks, count: int) -> IntArray:
    """Return the labelling of largest gain with exactly `count` runs of equal labels; (b,).

    Dynamic programme over (runs so far, state), exact. `count` is at most the number of blocks.
    """
    steps = len(blocks.scores)
    value = np.full((count, 3), _IMPOSSIBLE)
    value[0] = blocks.scores[0]
    came_from = np.zeros((steps, count, 3), dtype=np.int8)
    others = np.array([[1, 2], [0, 2], [0, 1]])
    for block in range(1, steps):
        changed = np.full((count, 3), _IMPOSSIBLE)
        origin = np.zeros((count, 3), dtype=np.int8)
        for state in range(3):
            pair = value[:-1, others[state]]
            which = pair.argmax(axis=1)
            changed[1:, state] = pair[np.arange(count - 1), which]
            origin[1:, state] = others[state][which]
        better = changed > value
        came_from[block] = np.where(better, origin + 1, 0)
        value = np.where(better, changed, value) + blocks.scores[block]
    labels = np.empty(steps, dtype=np.int64)
    run, state = count - 1, int(value[count - 1].argmax())
    for block in range(steps - 1, -1, -1):
        labels[block] = STATES[state]
        origin_state = came_from[block, run, state]
        if origin_state:
            run, state = run - 1, int(origin_state) - 1
    return labels


def gain_by_count(blocks: Blocks, most: int) -> FloatArray:
    """Return the largest gain reachable with at most 1, 2, … `most` runs, (most,), m: where more stop paying."""
    value = np.full((most, 3), _IMPOSSIBLE)
    value[0] = blocks.scores[0]
    for scores in blocks.scores[1:]:
        changed = np.full((most, 3), _IMPOSSIBLE)
        for state in range(3):
            changed[1:, state] = np.delete(value[:-1], state, axis=1).max(axis=1)
        value = np.maximum(value, changed) + scores
    # An exact number of runs may force one that loses; with fewer allowed it need not be taken.
    gains: FloatArray = np.maximum.accumulate(value.max(axis=1))
    return gains


def _trace_back(came_from: IntArray, state: int) -> IntArray:
    labels = np.empty(len(came_from), dtype=np.int64)
    for block in range(len(came_from) - 1, -1, -1):
        labels[block] = STATES[state]
        state = int(came_from[block, state])
    return labels


def otsu_threshold(values: FloatArray, *, bins: int = 256) -> float:
    """Return the value that parts a histogram in the two most different halves.

    References
    ----------
    N. Otsu, A threshold selection method from gray-level histograms, IEEE SMC 9 (1979).
    """
    counts, edges = np.histogram(values, bins)
    centres = 0.5 * (edges[1:] + edges[:-1])
    below = np.cumsum(counts)
    moment = np.cumsum(counts * centres)
    spread = (moment[-1] * below / below[-1] - moment) ** 2 / np.maximum(below * (below[-1] - below), 1)
    return float(centres[spread.argmax()])

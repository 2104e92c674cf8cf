"""Where a trace may be wrong: weak stretches, turns at crossings, another length than known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from bobdesk.arrays import FloatArray, IntArray
from bobdesk.plan.polyline_geometry import arc_lengths, resampled, turns
from bobdesk.plan.raster import Float32Array

_WEAK = 0.5
# Sentences of one sort; the rest is counted.
_MOST_SENTENCES = 4
# Directions on both sides of straight on in which a line may go on, degrees.
_FAN = np.arange(-12.0, 13.0, 4.0)
# Over so many pixels no track turns by more than this.
_KINK_GAP, _KINK_ARM, _KINK = 3, 8, 60.0


@dataclass(frozen=True)
class Doubt:
    """A place (x, y) of a trace: a loop may be cut there, or else the trace has a kink."""

    x: float
    y: float
    cut_loop: bool


def confidence(fit: FloatArray, *, step: float, reach: float) -> FloatArray:
    """Return how sure each point is (n,), 0 to 1: its own fit, or that of its neighbours less the distance.

    `reach` is the distance in pixels over which a good fit loses all its worth.
    """
    loss = step / reach
    places = np.arange(len(fit)) * loss
    forwards = np.maximum.accumulate(fit + places) - places
    backwards = (np.maximum.accumulate((fit - places)[::-1]))[::-1] + places
    return np.asarray(np.clip(np.maximum(forwards, backwards), 0.0, 1.0), dtype=np.float64)


def weak_stretches(sure: FloatArray, *, shortest: int) -> IntArray:
    """Return the first and last index (k, 2) of stretches of `shortest` points or more that are not sure.

    That is a confidence (n,) below a half.
    """
    weak = np.concatenate([[False], sure < _WEAK, [False]]).astype(np.int8)
    edges = np.flatnonzero(np.diff(weak))
    stretches = np.column_stack([edges[::2], edges[1::2] - 1]).astype(np.int64)
    return stretches[stretches[:, 1] - stretches[:, 0] + 1 >= shortest]


def _goes_on(score: Float32Array, starts: FloatArray, ways: FloatArray, *, near: float) -> FloatArray:
    """How inked (n,) a line is that goes on from `starts` (n, 2) about along `ways` (n, 2)."""
    distances = np.arange(near, near + 14.0)
    best = np.zeros(len(starts))
    for turn in np.deg2rad(_FAN):
        x = ways[:, 0] * np.cos(turn) - ways[:, 1] * np.sin(turn)
        y = ways[:, 0] * np.sin(turn) + ways[:, 1] * np.cos(turn)
        at = [starts[:, 1:] + y[:, None] * distances, starts[:, :1] + x[:, None] * distances]
        inked = ndimage.map_coordinates(score, at, order=1, mode="constant")
        best = np.maximum(best, np.quantile(inked, 0.2, axis=1))
    return best


def _beside(score: Float32Array, points: FloatArray, *, width: float) -> Float32Array:
    """The ridge score without that of the path itself."""
    own = np.zeros(score.shape, dtype=bool)
    columns = np.clip(np.round(points[:, 0]).astype(np.intp), 0, score.shape[1] - 1)
    rows = np.clip(np.round(points[:, 1]).astype(np.intp), 0, score.shape[0] - 1)
    own[rows, columns] = True
    own = ndimage.binary_dilation(own, iterations=int(np.ceil(0.5 * width)) + 2)
    return np.where(own, np.float32(0.0), ndimage.maximum_filter(score, size=3))


def doubtful_turns(score: Float32Array, trace: FloatArray, *, width: float) -> tuple[Doubt, ...]:
    """Return where a trace (n, 2), copy pixels, turns off at a crossing, or has a kink.

    Where a loop was cut at its crossing, the ridge `score` (h, w) goes straight on where the trace comes
    from, and straight back from where it leaves.
    """
    points = resampled(trace, step=1.0)
    gap, arm = max(3, round(0.7 * width)), 10
    reach = gap + arm
    if len(points) < 2 * reach + 3:
        return ()
    middle = np.arange(reach, len(points) - reach)
    incoming, outgoing, turn = turns(points, middle, gap=gap, arm=arm)
    kink = turns(points, middle, gap=_KINK_GAP, arm=_KINK_ARM)[2]
    candidates = np.flatnonzero(turn > 28.0)
    others = _beside(score, points, width=width)
    near = 2.0 * gap + 4.0
    ahead = _goes_on(others, points[middle - gap][candidates], incoming[candidates], near=near)
    behind = _goes_on(others, points[middle + gap][candidates], -outgoing[candidates], near=near)
    crossing = np.zeros(len(middle), dtype=bool)
    crossing[candidates] = np.minimum(ahead, behind) > 0.55
    doubts: list[Doubt] = []
    for group in _groups(np.flatnonzero(crossing | (kink > _KINK)), apart=2 * reach):
        worst = int(group[turn[group].argmax()])
        x, y = points[middle[worst]]
        doubts.append(Doubt(float(x), float(y), bool(crossing[group].any())))
    return tuple(doubts)


def _groups(indices: IntArray, *, apart: int) -> list[IntArray]:
    if len(indices) == 0:
        return []
    return list(np.split(indices, np.flatnonzero(np.diff(indices) > apart) + 1))


def turn_sentences(doubts: list[tuple[Doubt, float, float]]) -> list[str]:
    """Say where turns are doubtful; each doubt comes with its place in the picture."""
    sentences = []
    for doubt, x, y in doubts[:_MOST_SENTENCES]:
        if doubt.cut_loop:
            sentences.append(
                f"The trace turns off at the crossing at {x:.0f},{y:.0f} while the line goes straight on: "
                "it may have cut a loop; add points on the loop."
            )
        else:
            sentences.append(f"The trace has a kink at {x:.0f},{y:.0f}; look whether it follows the line there.")
    if len(doubts) > _MOST_SENTENCES:
        sentences.append(f"The trace has {len(doubts) - _MOST_SENTENCES} more doubtful turns.")
    return sentences


def weak_sentences(points: FloatArray, stretches: IntArray) -> list[str]:
    """Say where the picture hardly shows the line."""
    along = arc_lengths(points)
    lengths = along[stretches[:, 1]] - along[stretches[:, 0]]
    order = np.argsort(-lengths)
    sentences = []
    for index in order[:_MOST_SENTENCES]:
        x, y = points[int(stretches[index].mean())]
        sentences.append(f"The picture hardly shows the line over {lengths[index]:.0f} px around {x:.0f},{y:.0f}.")
    if len(order) > _MOST_SENTENCES:
        sentences.append(f"The picture hardly shows the line in {len(order) - _MOST_SENTENCES} more places.")
    return sentences


def length_sentence(length: float, known: float) -> str | None:
    """Compare with a known length; None within 3 %."""
    percent = 100.0 * (length - known) / known
    if abs(percent) <= 3.0:
        return None
    what = "shorter" if percent < 0 else "longer"
    why = "a loop may be missing" if percent < 0 else "it may take a way round"
    share = f"{abs(percent):.0f} %"
    return f"The trace is {length:.0f} px long, {share} {what} than the known {known:.0f} px: {why}."

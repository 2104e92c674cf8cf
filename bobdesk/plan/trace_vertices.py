"""What a hand does to the vertices of a trace: each a function that returns a new trace.

A vertex that a person has placed is sure (confidence 1), and no stretch that is touched stays suspect.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from bobdesk.arrays import FloatArray, IntArray, frozen
from bobdesk.errors import InputError
from bobdesk.plan.traced_line import Trace

_FEWEST = 2
_LARGEST_PX = 1e6


def drawn_trace(points: npt.ArrayLike) -> Trace:
    """Return the trace of clicked points, (n, 2), pixels.

    Raises
    ------
    InputError
        If there are fewer than two, or one is no place in a picture.
    """
    places = checked_vertices(points)
    if len(places) < _FEWEST:
        raise InputError("A line needs at least two points.")
    return Trace(frozen(places), frozen(np.ones(len(places))), 0.0, "single", (), _stretches([]))


def checked_vertices(points: npt.ArrayLike) -> FloatArray:
    """Return the points as (n, 2), or raise InputError if one is no place in a picture."""
    places = np.array(points, dtype=np.float64).reshape(-1, 2)
    if not (np.isfinite(places).all() and (np.abs(places) < _LARGEST_PX).all()):
        raise InputError("A point of the line is no place in a picture.")
    return places


def with_vertices_moved(trace: Trace, indices: Sequence[int], *, to: npt.ArrayLike) -> Trace:
    """Put the vertices at `indices` at the places `to`, (k, 2)."""
    for index in indices:
        _check_index(trace, index)
    points, sure = trace.points.copy(), trace.confidence.copy()
    points[list(indices)] = checked_vertices(to)
    sure[list(indices)] = 1.0
    kept = [
        (first, last) for first, last in trace.suspect.tolist() if not any(first <= index <= last for index in indices)
    ]
    return replace(trace, points=frozen(points), confidence=frozen(sure), suspect=_stretches(kept))


def with_vertex_inserted(trace: Trace, after: int, *, at: npt.ArrayLike) -> Trace:
    """Put a new vertex behind the one with the index `after`; -1 puts it before the first."""
    if not -1 <= after < len(trace.points):
        raise InputError(f"There is no vertex {after + 1} in this line.")
    return with_stretch_replaced(trace, after + 1, after + 1, by=checked_vertices(at))


def without_vertices(trace: Trace, indices: Sequence[int]) -> Trace:
    """Take vertices away.

    Raises
    ------
    InputError
        If fewer than two would be left.
    """
    for index in indices:
        _check_index(trace, index)
    gone = sorted(set(indices))
    if len(trace.points) - len(gone) < _FEWEST:
        raise InputError("A line needs at least two points; delete the whole line instead.")
    kept = np.delete(np.arange(len(trace.points)), gone)
    new_place = np.searchsorted(kept, np.arange(len(trace.points)))
    suspect = []
    for first, last in trace.suspect.tolist():
        moved = (int(new_place[first]), int(np.searchsorted(kept, last, side="right")) - 1)
        if moved[0] <= moved[1]:
            suspect.append(moved)
    return replace(
        trace,
        points=frozen(trace.points[kept]),
        confidence=frozen(trace.confidence[kept]),
        suspect=_stretches(suspect),
    )


def with_stretch_replaced(
    trace: Trace, first: int, last: int, *, by: npt.ArrayLike, confidence: npt.ArrayLike | None = None
) -> Trace:
    """Put other vertices in the place of those from `first` up to but not with `last`.

    With `first` = `last` they are put between; at 0 or the number of vertices they prolong the line.
    """
    count = len(trace.points)
    if not 0 <= first <= last <= count:
        raise InputError("There is no such stretch in this line.")
    new = checked_vertices(by)
    sure = np.ones(len(new)) if confidence is None else np.array(confidence, dtype=np.float64)
    if len(sure) != len(new) or not ((sure >= 0) & (sure <= 1)).all():
        raise InputError("The confidence of each new vertex must be a number from 0 to 1.")
    points = np.concatenate([trace.points[:first], new, trace.points[last:]])
    if len(points) < _FEWEST:
        raise InputError("A line needs at least two points; delete the whole line instead.")
    shift = len(new) - (last - first)
    suspect = [
        (one, other) if other < first else (one + shift, other + shift)
        for one, other in trace.suspect.tolist()
        if other < first or one >= last
    ]
    return replace(
        trace,
        points=frozen(points),
        confidence=frozen(np.concatenate([trace.confidence[:first], sure, trace.confidence[last:]])),
        suspect=_stretches(suspect),
    )


def turned_round(trace: Trace) -> Trace:
    """Let the line run the other way."""
    last = len(trace.points) - 1
    suspect = [(last - two, last - one) for one, two in reversed(trace.suspect.tolist())]
    return replace(
        trace,
        points=frozen(trace.points[::-1]),
        confidence=frozen(trace.confidence[::-1]),
        suspect=_stretches(suspect),
    )


def enlarged(trace: Trace, factor: float) -> Trace:
    """Fit the trace to the same picture drawn with `factor` times as many pixels along each side."""
    # Pixel centres count from 0, so the picture's corner is at -0.5.
    return replace(
        trace, points=frozen((trace.points + 0.5) * factor - 0.5), line_width_px=trace.line_width_px * factor
    )


def _stretches(pairs: Sequence[tuple[int, int] | list[int]]) -> IntArray:
    array = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    array.flags.writeable = False
    return array


def _check_index(trace: Trace, index: int) -> None:
    if not 0 <= index < len(trace.points):
        raise InputError(f"There is no vertex {index + 1} in this line.")

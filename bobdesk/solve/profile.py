"""The profile: how the gradients of the pieces make the elevation of every row.

A piece is a segment, or a part of one between known elevations. The gradient is constant in a piece
and, where transitions are wanted, passes from one to the next by a parabolic vertical curve, that is
on a straight ramp. Every row's fall is then a fixed linear combination of two or three gradients, so
that what is solved for is exactly what is exported.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from scipy import sparse

from bobdesk.alignment.centreline import Centreline, at_stations
from bobdesk.alignment.curvature import curvature
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import BoolArray, FloatArray, IntArray, frozen

_SAME_STATION = 1e-6
_CLOSEST_BREAK = 1.0
_MOST_DIVISIONS = 300


@dataclass(frozen=True, eq=False)
class Falls:
    """The fall from each of m stations to the next, in the plan's own scale.

    Attributes
    ----------
    by_piece : (m-1, p)
        Share of each piece's gradient, m.
    by_edge : (m-1, p-1)
        Share of the gradient given at each held edge, m.
    """

    by_piece: sparse.csr_array
    by_edge: sparse.csr_array

    def __call__(self, gradients: FloatArray, edge_gradients: FloatArray) -> FloatArray:
        """Return the falls, (m-1,), m."""
        falls: FloatArray = self.by_piece @ gradients + self.by_edge @ edge_gradients
        return falls


@dataclass(frozen=True, eq=False)
class Profile:
    """Rows, pieces and transitions of a profile; it holds no gradients.

    Attributes
    ----------
    stations : (n,)
        Of the rows, m. Equal steps; known elevations fall on rows, so that between two of them the
        steps may differ from those elsewhere by a per cent or so.
    points : (n, 2)
        Plan, m.
    edges : (p+1,)
        Stations at which pieces begin and end, m.
    segment_of : (p,)
        Index of the segment that each piece belongs to.
    half_transitions : (p-1,)
        Half the length of the transition at each inner edge, m; 0 for a kink.
    held : (p-1,)
        True at inner edges whose elevation is known. There the gradient passes through a value
        that is given beforehand, so that the known elevation holds exactly in spite of the
        transition, and the stretches on both sides have no gradient in common.
    curvature : (n,)
        Of the plan, 1/m, left positive.
    """

    stations: FloatArray
    points: FloatArray
    edges: FloatArray
    segment_of: IntArray
    half_transitions: FloatArray
    held: BoolArray
    curvature: FloatArray

    def __post_init__(self) -> None:
        for name in ("stations", "points", "edges", "half_transitions", "curvature"):
            object.__setattr__(self, name, frozen(getattr(self, name)))

    @cached_property
    def piece_lengths(self) -> FloatArray:
        """Plan lengths of the pieces, (p,), m."""
        return np.diff(self.edges)

    @cached_property
    def chords(self) -> FloatArray:
        """Plan distances between neighbouring rows, (n-1,), m."""
        lengths: FloatArray = np.hypot(*np.diff(self.points, axis=0).T)
        return lengths

    @cached_property
    def falls(self) -> Falls:
        """The fall from each row to the next."""
        return falls_between(self, self.stations)

    @property
    def length(self) -> float:
        """Plan length along the chords, m."""
        return float(self.chords.sum())


def make_profile(
    centreline: Centreline,
    segments: Segments,
    *,
    breaks: tuple[float, ...] = (),
    kinks: tuple[float, ...] = (),
    transition: float = 0.0,
    longest_piece: float | None = None,
) -> Profile:
    """Lay out rows and pieces.

    Parameters
    ----------
    centreline, segments
        The plan.
    breaks
        Stations of known elevations, m; a row and a break of the gradient is put at each. A
        segment boundary within 1 m of one gives way to it.
    kinks
        Stations among `breaks` that get no transition.
    transition
        Length of the vertical transitions, m; shortened to what the pieces beside it allow.
    longest_piece
        Longer pieces are divided into equal ones, m; None leaves a piece as long as its segment.
    """
    length = centreline.length
    inner = [station for station in sorted(breaks) if _SAME_STATION < station < length - _SAME_STATION]
    stations, points, bends = profile_rows(centreline, inner)
    known = np.array([0.0, *inner, length])
    boundaries = np.array([segment.start for segment in segments[1:]])
    if len(boundaries):
        apart = np.abs(boundaries[:, None] - known[None, :]).min(axis=1)
        boundaries = boundaries[apart > _CLOSEST_BREAK]
    edges = _distinct(np.sort(np.concatenate([known, boundaries])))
    if longest_piece is not None:
        edges = _divided(edges, max(longest_piece, length / _MOST_DIVISIONS))
    middles = 0.5 * (edges[1:] + edges[:-1])
    ends = np.array([segment.end for segment in segments])
    segment_of = np.minimum(np.searchsorted(ends, middles, side="right"), len(segments) - 1)
    lengths = np.diff(edges)
    halves = 0.5 * np.minimum(transition, np.minimum(lengths[1:], lengths[:-1]))
    held = _is_among(edges[1:-1], inner)
    halves[_is_among(edges[1:-1], list(kinks))] = 0.0
    return Profile(stations, points, edges, segment_of, halves, held, bends)


def profile_rows(centreline: Centreline, breaks: list[float]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return stations, plan points and curvature of the rows where these inner stations get a row each."""
    if not breaks:
        return centreline.stations, centreline.points, curvature(centreline)
    stations = row_stations(centreline.length, centreline.spacing, breaks)
    bends = np.interp(stations, centreline.stations, curvature(centreline))
    return stations, at_stations(centreline, stations), bends


def _divided(edges: FloatArray, longest: float) -> FloatArray:
    parts = [
        np.linspace(start, end, int(np.ceil((end - start) / longest - 1e-9)) + 1)[1:] for start, end in pairwise(edges)
    ]
    divided: FloatArray = np.concatenate([edges[:1], *parts])
    return divided


def _is_among(values: FloatArray, chosen: list[float]) -> BoolArray:
    if not chosen:
        return np.zeros(len(values), dtype=np.bool_)
    return np.asarray(np.abs(values[:, None] - np.array(chosen)[None, :]).min(axis=1) < _SAME_STATION)


def row_stations(length: float, spacing: float, breaks: list[float]) -> FloatArray:
    """Return stations from 0 to `length`, equally spaced between each two breaks, with the breaks on them."""
    anchors = [0.0, *breaks, length]
    parts = [np.zeros(1)]
    for start, end in pairwise(anchors):
        if end - start > _SAME_STATION:
            parts.append(np.linspace(start, end, max(1, round((end - start) / spacing)) + 1)[1:])
    return np.concatenate(parts)


def falls_between(profile: Profile, stations: FloatArray) -> Falls:
    """Return the fall from each station to the next as a function of the gradients."""
    pieces = len(profile.piece_lengths)
    cuts = np.union1d(stations, profile.edges)
    cuts = cuts[(cuts >= stations[0]) & (cuts <= stations[-1])]
    middles = 0.5 * (cuts[1:] + cuts[:-1])
    piece = np.clip(np.searchsorted(profile.edges, middles, side="right") - 1, 0, pieces - 1)
    shares = [(np.searchsorted(stations, middles, side="right") - 1, piece, np.diff(cuts))]
    given: list[tuple[IntArray, IntArray, FloatArray]] = []
    for index in np.flatnonzero(profile.half_transitions > 0):
        edge, half = profile.edges[index + 1], float(profile.half_transitions[index])
        first = max(int(np.searchsorted(stations, edge - half)) - 1, 0)
        last = min(int(np.searchsorted(stations, edge + half)) + 1, len(stations))
        if last - first < 2:
            continue
        rows = np.arange(first, last - 1)
        beyond = np.clip(stations[first:last] - edge, -half, half)
        if profile.held[index]:
            before, after = _held_ramp(beyond, half)
            given.append((rows, np.full(len(rows), index), -np.diff(before + after)))
        else:
            gained = (beyond + half) ** 2 / (4 * half) - np.maximum(beyond, 0.0)
            before, after = -gained, gained
        shares.append((rows, np.full(len(rows), index), np.diff(before)))
        shares.append((rows, np.full(len(rows), index + 1), np.diff(after)))
    return Falls(
        _matrix(shares, (len(stations) - 1, pieces)),
        _matrix(given, (len(stations) - 1, max(pieces - 1, 1))),
    )


def _held_ramp(beyond: FloatArray, half: float) -> tuple[FloatArray, FloatArray]:
    """Return what a transition through a given gradient adds to the running shares of both pieces, m.

    Before the edge the earlier piece's gradient gives way to the given one on a ramp, after it the
    given one to the later piece's; the given gradient gains what the two lose.
    """
    before = np.minimum(beyond, 0.0) + half
    after = np.maximum(beyond, 0.0)
    return -(before**2) / (2 * half), after**2 / (2 * half) - after


def _matrix(entries: list[tuple[IntArray, IntArray, FloatArray]], shape: tuple[int, int]) -> sparse.csr_array:
    """Return the sum of all entries (rows, columns, values) as a sparse matrix without zeros."""
    if not entries:
        return sparse.csr_array(shape)
    rows, columns, values = (np.concatenate(part) for part in zip(*entries, strict=True))
    matrix = sparse.csr_array(sparse.coo_array((values, (rows, columns)), shape=shape))
    matrix.data[np.abs(matrix.data) < 1e-13] = 0.0
    matrix.eliminate_zeros()
    return matrix


def _distinct(sorted_values: FloatArray) -> FloatArray:
    keep = np.concatenate([[True], np.diff(sorted_values) > _SAME_STATION])
    distinct: FloatArray = sorted_values[keep]
    return distinct

"""The 3D centreline: plan and elevation of every row, as it is exported."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray, IntArray, frozen
from bobdesk.solve.iterates import Solution

if TYPE_CHECKING:
    from bobdesk.alignment.centreline import Centreline

DECIMALS = 6
_NO_CURVATURE = 1e-9


@dataclass(frozen=True, eq=False)
class Centreline3D:
    """A line in space, row by row, in true size.

    Attributes
    ----------
    stations : (n,)
        Distance along the line in plan, m.
    slope_lengths : (n,)
        Distance along the 3D line, the sum of the distances between rows, m.
    points : (n, 3)
        x, y, z, m; z counts from the lowest point.
    headings : (n,)
        rad, anticlockwise from +x.
    gradients : (n,)
        Downhill positive.
    plan_curvature : (n,)
        1/m, left positive.
    curvature : (n,)
        Of the 3D line, 1/m, with the sign of the plan's.
    segment_of : (n,)
        Index of the segment that each row lies in.
    segments
        In true size.
    segment_gradients : (s,)
        Fall over each segment divided by its plan length.
    """

    stations: FloatArray
    slope_lengths: FloatArray
    points: FloatArray
    headings: FloatArray
    gradients: FloatArray
    plan_curvature: FloatArray
    curvature: FloatArray
    segment_of: IntArray
    segments: Segments
    segment_gradients: FloatArray

    def __post_init__(self) -> None:
        names = "stations slope_lengths points headings gradients plan_curvature curvature segment_gradients"
        for name in names.split():
            object.__setattr__(self, name, frozen(getattr(self, name)))

    @property
    def elevations(self) -> FloatArray:
        """Elevation of each row, (n,), m."""
        elevations: FloatArray = self.points[:, 2]
        return elevations


def make_centreline3d(centreline: Centreline, segments: Segments, solution: Solution) -> Centreline3D:
    """Put plan and gradients together."""
    from bobdesk.alignment.curvature import heading  # here, for it needs scipy, and the type does not

    profile, scale = solution.profile, solution.scale
    falls = scale * profile.falls(solution.gradients, solution.edge_gradients)
    elevations = solution.start_elevation - np.concatenate([[0.0], np.cumsum(falls)])
    # Rounded here, so that every figure is that of the rows as they are written.
    points: FloatArray = np.column_stack([scale * profile.points, elevations]).round(DECIMALS) + 0.0
    stations = np.round(scale * profile.stations, DECIMALS)
    gradients = _gradients_at_rows(stations, falls, solution)
    true_size = tuple(replace(segment, start=scale * segment.start, end=scale * segment.end) for segment in segments)
    ends = np.array([segment.end for segment in true_size])
    bends = profile.curvature / scale
    return Centreline3D(
        stations=stations,
        slope_lengths=np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]),
        points=points,
        headings=np.interp(profile.stations, centreline.stations, heading(centreline)),
        gradients=gradients,
        plan_curvature=bends,
        curvature=_curvature_in_space(stations, gradients, bends),
        segment_of=np.minimum(np.searchsorted(ends, stations, side="right"), len(ends) - 1),
        segments=true_size,
        segment_gradients=segment_gradients(stations, elevations, true_size),
    )


def segment_gradients(stations: FloatArray, elevations: FloatArray, segments: Segments) -> FloatArray:
    """Return the fall over each segment divided by its plan length, (s,)."""
    edges = np.array([segments[0].start, *(segment.end for segment in segments)])
    gradients: FloatArray = -np.diff(np.interp(edges, stations, elevations)) / np.diff(edges)
    return gradients


def _gradients_at_rows(stations: FloatArray, falls: FloatArray, solution: Solution) -> FloatArray:
    """Return the gradient at each row: of the piece, and on transitions the mean of the two steps."""
    steps = falls / np.diff(stations)
    before = np.concatenate([steps[:1], steps])
    after = np.concatenate([steps, steps[-1:]])
    profile = solution.profile
    mean: FloatArray = 0.5 * (before + after)
    # At a kink the gradient has no value of its own: it is that of the piece that begins there.
    kinks = profile.edges[1:-1][profile.half_transitions <= 0]
    if len(kinks):
        spacing = float(np.diff(profile.stations).max())
        near = np.searchsorted(profile.stations, kinks)
        for row, kink in zip(near, kinks, strict=True):
            for index in (row - 1, row):
                if 0 <= index < len(mean) and abs(profile.stations[index] - kink) <= spacing:
                    mean[index] = after[index] if profile.stations[index] >= kink - 1e-9 else before[index]
    return mean


def _curvature_in_space(stations: FloatArray, gradients: FloatArray, plan: FloatArray) -> FloatArray:
    """Return |r' x r''| / |r'|³ of the line (x(s), y(s), z(s)) by station s, with the plan's sign.

    With z' = -g: |r' x r''|² = k² (1 + g²) + g'², |r'|² = 1 + g².
    """
    change = np.gradient(gradients, stations)
    speed = 1 + gradients**2
    size = np.sqrt(plan**2 * speed + change**2) / speed**1.5
    signed: FloatArray = np.where(plan < -_NO_CURVATURE, -size, size)
    return signed

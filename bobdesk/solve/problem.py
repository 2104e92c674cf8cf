"""A profile with its targets: the feasible set and the quantities that solvers need."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import BoolArray, FloatArray, IntArray
from bobdesk.errors import TargetError
from bobdesk.solve.anchors import Anchors, elevations_of, gradients_through, stations_of
from bobdesk.solve.length import LengthOf
from bobdesk.solve.profile import Profile, falls_between, make_profile
from bobdesk.solve.projection import FeasibleSet
from bobdesk.solve.targets import Targets

_LONGEST_LEVEL_OUT = 0.25
Ranges = tuple[tuple[float, float], ...]


@dataclass(frozen=True, eq=False)
class Problem:
    """What a solver is given.

    Solvers work in v = gradient * sqrt(length), so that |v|² is the integral of the gradient² along
    the line: pieces of 3 m and of 300 m are then equally well scaled.

    Attributes
    ----------
    profile
        Rows and pieces, in the plan's own scale.
    targets
        The targets.
    anchors
        The elevations that are held, from the start to the end, in running order.
    boundaries : (s+1,)
        Stations at which the segments begin, and the last one ends, in the plan's own scale, m.
    scale
        Factor on the plan.
    downhill, uphill
        Ranges of stations in which the track may not climb, or not fall, whatever the limits.
    through : (a-2,) or None
        Gradients at the inner anchors where they are known better than from the anchors alone.
    level_out
        Length over which the gradient is taken to die out before an end at the lowest point, m.
    """

    profile: Profile
    targets: Targets
    anchors: Anchors
    boundaries: FloatArray
    scale: float = 1.0
    downhill: Ranges = ()
    uphill: Ranges = ()
    through: FloatArray | None = None
    level_out: float = 0.0

    @cached_property
    def piece_lengths(self) -> FloatArray:
        """Plan lengths of the pieces in true size, (p,), m."""
        return self.scale * self.profile.piece_lengths

    @cached_property
    def roots(self) -> FloatArray:
        """Factor from gradients to the solvers' variables, (p,), m^(1/2)."""
        roots: FloatArray = np.sqrt(self.piece_lengths)
        return roots

    @cached_property
    def edge_gradients(self) -> FloatArray:
        """Gradients given at the held edges, 0 at the others, (p-1,) or (1,)."""
        given = np.zeros(max(len(self.profile.held), 1))
        through = self.through
        if through is None:
            through = gradients_through(self.anchors, scale=self.scale, level_at_lowest=self.climbs)
        given[np.flatnonzero(self.profile.held)] = through
        if self.downhill or self.uphill:
            # Where a track may not climb up to a known elevation, nor fall behind it, it passes level.
            low, high = self.lowest_gradients, self.highest_gradients
            inner = slice(len(self.profile.held))
            least, most = np.maximum(low[:-1], low[1:]), np.minimum(high[:-1], high[1:])
            given[inner] = np.where(self.profile.held, np.clip(given[inner], least, most), given[inner])
        return given

    @property
    def climbs(self) -> bool:
        """Whether the limits let the track climb."""
        return self.targets.min_gradient < 0

    @cached_property
    def length_of(self) -> LengthOf:
        """The 3D length as a function of the gradients."""
        return LengthOf(self.profile, self.edge_gradients, self.scale)

    @cached_property
    def stretch_of(self) -> IntArray:
        """Index of the stretch between anchors that each piece lies in, (p,)."""
        stretches: IntArray = np.concatenate([[0], np.cumsum(self.profile.held)])
        return stretches

    @cached_property
    def lowest_gradients(self) -> FloatArray:
        """Smallest gradient that each piece may have, (p,)."""
        return np.where(self._lies_in(self.downhill), max(0.0, self.targets.min_gradient), self.targets.min_gradient)

    @cached_property
    def highest_gradients(self) -> FloatArray:
        """Largest gradient that each piece may have, (p,)."""
        return np.where(self._lies_in(self.uphill), min(0.0, self.targets.max_gradient), self.targets.max_gradient)

    def _lies_in(self, ranges: Ranges) -> BoolArray:
        middles = 0.5 * (self.profile.edges[1:] + self.profile.edges[:-1])
        found = np.zeros(len(middles), dtype=np.bool_)
        for start, end in ranges:
            found |= (middles > start) & (middles < end)
        return found

    @cached_property
    def tapers(self) -> FloatArray:
        """Share that each piece has of the gradient before the end levels out, (p,), in (0, 1]."""
        edges = self.scale * self.profile.edges
        length = min(self.level_out, _LONGEST_LEVEL_OUT * float(edges[-1]))
        if length <= 0 or self.anchors[-1].elevation > 0:
            return np.ones(len(edges) - 1)
        to_go = (edges[-1] - edges) / length
        # Integral of min(1, to go) from the end.
        area = np.where(to_go < 1, 0.5 * to_go**2, to_go - 0.5) * length
        tapers: FloatArray = -np.diff(area) / np.diff(edges)
        return tapers

    @cached_property
    def feasible_set(self) -> FeasibleSet:
        """Limits, drop, known elevations and mean gradient as a set of the solvers' variables."""
        falls = falls_between(self.profile, stations_of(self.anchors))
        weights = self.scale * np.asarray(falls.by_piece.sum(axis=0)) / self.roots
        given = self.scale * (falls.by_edge @ self.edge_gradients)
        wanted = self.targets.segments_mean
        by_row = self._shares_of_rows
        return FeasibleSet(
            weights=weights,
            stretch_of=self.stretch_of,
            falls=-np.diff(elevations_of(self.anchors)) - given,
            low=self.lowest_gradients * self.roots,
            high=self.highest_gradients * self.roots,
            mean_weights=None if wanted is None else self.profile.falls.by_piece.T @ by_row / self.roots,
            mean=0.0 if wanted is None else wanted - float(by_row @ (self.profile.falls.by_edge @ self.edge_gradients)),
        )

    @cached_property
    def _shares_of_rows(self) -> FloatArray:
        """Share of the fall from each row to the next in the mean of the segments' gradients, (n-1,), 1/m.

        Of the elevations at the segments' boundaries, as they follow from the rows: transitions and pieces that a known
        elevation has cut let these differ from the gradients of the pieces.
        """
        counted = np.interp(self.profile.stations, self.boundaries, np.linspace(0, 1, len(self.boundaries)))
        shares: FloatArray = np.diff(counted) / np.diff(self.profile.stations)
        return shares

    def gradients(self, v: FloatArray) -> FloatArray:
        """Return the gradients of the pieces, (p,), from the solvers' variables."""
        return v / self.roots

    def even_start(self) -> FloatArray:
        """Return variables with the mean gradient of each stretch in all of its pieces, (p,)."""
        lengths = self.scale * np.diff(stations_of(self.anchors))
        means = -np.diff(elevations_of(self.anchors)) / lengths
        start: FloatArray = means[self.stretch_of] * self.roots
        return start


def mean_shares(profile: Profile) -> FloatArray:
    """Return the share of each piece in the mean of the segments' gradients, (p,)."""
    of_segment = np.bincount(profile.segment_of, profile.piece_lengths)
    shares: FloatArray = profile.piece_lengths / of_segment[profile.segment_of] / np.count_nonzero(of_segment)
    return shares


def make_problem(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    anchors: Anchors,
    *,
    transition: float = 0.0,
    longest_piece: float | None = None,
    scale: float = 1.0,
    downhill: Ranges = (),
    uphill: Ranges = (),
    through: FloatArray | None = None,
    level_out: float = 0.0,
) -> Problem:
    """Put plan and targets together.

    Where a stretch can be met by kinks only, because it falls nearly as steeply as the limits
    allow, the transitions at its ends are left out.

    Raises
    ------
    TargetError
        If a stretch cannot be met at all; the sentence names it with numbers.
    """
    breaks = tuple(anchor.station for anchor in anchors[1:-1])
    boundaries = np.array([segments[0].start, *(segment.end for segment in segments)])

    def laid_out(kinks: tuple[float, ...]) -> Problem:
        profile = make_profile(
            centreline, segments, breaks=breaks, kinks=kinks, transition=transition, longest_piece=longest_piece
        )
        return Problem(profile, targets, anchors, boundaries, scale, downhill, uphill, through, level_out)

    problem = laid_out(())
    tight = _stretches_out_of_reach(problem)
    if len(tight):
        ends = stations_of(anchors)
        problem = laid_out(tuple(float(ends[index]) for index in np.unique(np.concatenate([tight, tight + 1]))))
        tight = _stretches_out_of_reach(problem)
    if len(tight):
        raise TargetError(stretch_sentence(problem, int(tight[0])))
    return problem


def stretch_sentence(problem: Problem, index: int) -> str:
    """Say which stretch asks for more than the limits allow, with numbers."""
    start, end = problem.anchors[index], problem.anchors[index + 1]
    length = problem.scale * (end.station - start.station)
    fall = start.elevation - end.elevation
    low, high = problem.targets.min_gradient * length, problem.targets.max_gradient * length
    return (
        f"between {start.station:g} m and {end.station:g} m the elevation must fall by {fall:.2f} m,"
        f" but with gradients from {100 * problem.targets.min_gradient:g} % to"
        f" {100 * problem.targets.max_gradient:g} % it can fall by {low:.2f} m to {high:.2f} m only:"
        " doubt the elevations there or the limits"
    )


def _stretches_out_of_reach(problem: Problem) -> IntArray:
    lowest, highest = problem.feasible_set.reach()
    falls = problem.feasible_set.falls
    slack = 1e-9 * np.maximum(1.0, np.abs(falls))
    return np.flatnonzero((falls < lowest - slack) | (falls > highest + slack))

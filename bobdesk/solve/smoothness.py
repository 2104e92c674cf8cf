"""The two objectives of the recommended method: the smoothest profile, and swings about it."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.linalg import solveh_banded
from scipy.sparse.linalg import spsolve

from bobdesk.arrays import FloatArray, IntArray
from bobdesk.solve.problem import Problem
from bobdesk.solve.projection import FeasibleSet

SMOOTHNESS_SCALE = 1e4


class Smoothness:
    """Changes of gradient between neighbouring pieces.

    J = sum (b_{m+1} - b_m)^2 / ((D_m + D_{m+1}) / 2), scaled by 1e4, which brings it near 1. b is the
    gradient g divided by its taper: the drop is to the lowest point, where a track is level, so that
    the gradient is taken to die out over the last metres and not to end as it was before. The
    difference between plan and 3D curvature needs no term of its own: with gradients that change
    gently it is some 1e-4 1/m by itself.
    """

    def __init__(self, problem: Problem) -> None:
        lengths = problem.piece_lengths
        self._problem = problem
        self._weights = SMOOTHNESS_SCALE / (0.5 * (lengths[1:] + lengths[:-1]))

    def __call__(self, v: FloatArray) -> tuple[float, FloatArray]:
        """Return value and derivative at the solvers' variables."""
        jumps = np.diff(self._problem.gradients(v) / self._problem.tapers)
        weighted = self._weights * jumps
        derivative = np.zeros(len(v))
        derivative[:-1] -= 2 * weighted
        derivative[1:] += 2 * weighted
        derivative /= self._problem.roots * self._problem.tapers
        return float(jumps @ weighted), derivative


def smoothest_without_limits(problem: Problem) -> FloatArray:
    """Return the variables of the smoothest profile that keeps the equations and heeds no limits, (p,).

    A good start: where it lies within the limits it is the optimum already.
    """
    lengths = problem.piece_lengths
    feasible = problem.feasible_set
    count, stretches = len(lengths), len(feasible.falls)
    jumps = sparse.csr_array(sparse.eye_array(count - 1, count, k=1) - sparse.eye_array(count - 1, count))
    jumps = jumps @ sparse.diags_array(1 / problem.tapers)
    weights = sparse.diags_array(1 / (0.5 * (lengths[1:] + lengths[:-1])))
    rows = sparse.csr_array(
        (feasible.weights * problem.roots, (feasible.stretch_of, np.arange(count))), shape=(stretches, count)
    )
    right = feasible.falls
    if feasible.mean_weights is not None:
        rows = sparse.vstack([rows, sparse.csr_array(feasible.mean_weights[None, :] * problem.roots)])
        right = np.append(right, feasible.mean)
    bends = jumps.T @ weights @ jumps
    # A trace on the diagonal keeps the system regular where equations repeat each other.
    corner = sparse.eye_array(len(right)) * -1e-12
    upper = sparse.hstack([bends, rows.T])
    system = sparse.csc_array(sparse.vstack([upper, sparse.hstack([rows, corner])]))
    solved = np.asarray(spsolve(system, np.concatenate([np.zeros(count), right])), dtype=np.float64)
    if not np.isfinite(solved).all():
        return problem.even_start()
    start: FloatArray = solved[:count] * problem.roots
    return start


class Swings:
    """The variables of stage two: one change of gradient for each segment, or part of a long one.

    Real tracks alternate steep and flat from segment to segment; so all pieces of a segment change by
    the same amount, and what stage one made of them inside the segment stays.

    Parameters
    ----------
    problem
        The problem.
    smoothest : (p,)
        Gradients of stage one, within the feasible set.
    longest
        Segments longer than this swing in parts, m.
    """

    def __init__(self, problem: Problem, smoothest: FloatArray, longest: float) -> None:
        lengths = problem.piece_lengths
        self._smoothest = smoothest
        self._group_of = _groups(problem, longest)
        self._starts = np.flatnonzero(np.diff(self._group_of, prepend=-1))
        self.lengths = self._summed(lengths)
        self._roots = np.sqrt(self.lengths)
        feasible = problem.feasible_set
        self.count = len(self._starts)
        self.feasible_set = FeasibleSet(
            weights=self._summed(feasible.weights * problem.roots) / self._roots,
            stretch_of=problem.stretch_of[self._starts],
            falls=np.zeros(len(feasible.falls)),
            low=np.minimum(np.maximum.reduceat(problem.lowest_gradients - smoothest, self._starts), 0.0) * self._roots,
            high=np.maximum(np.minimum.reduceat(problem.highest_gradients - smoothest, self._starts), 0.0)
            * self._roots,
            mean_weights=None
            if feasible.mean_weights is None
            else self._summed(feasible.mean_weights * problem.roots) / self._roots,
        )

    def _summed(self, by_piece: FloatArray) -> FloatArray:
        summed: FloatArray = np.asarray(np.add.reduceat(by_piece, self._starts), dtype=np.float64)
        return summed

    def pattern(self) -> FloatArray:
        """Return swings of +1 and -1 in turn, (groups,)."""
        turn: FloatArray = np.where(np.arange(self.count) % 2, -1.0, 1.0) * self._roots
        return turn

    def difference(self, swings: FloatArray) -> FloatArray:
        """Return the change of each piece's gradient, (p,)."""
        return (swings / self._roots)[self._group_of]

    def gradients(self, swings: FloatArray) -> FloatArray:
        """Return the gradients of the pieces, (p,)."""
        return self._smoothest + self.difference(swings)

    def derivative(self, by_gradient: FloatArray) -> FloatArray:
        """Return a derivative by the variables from one by the gradients, (groups,)."""
        return self._summed(by_gradient) / self._roots


def _groups(problem: Problem, longest: float) -> IntArray:
    """Return the group of each piece: its segment and stretch, divided where that is too long, (p,)."""
    lengths = problem.piece_lengths
    key = problem.profile.segment_of * (int(problem.stretch_of[-1]) + 1) + problem.stretch_of
    starts = np.flatnonzero(np.diff(key, prepend=-1))
    of_run = np.cumsum(np.diff(key, prepend=key[0]) != 0)
    total = np.add.reduceat(lengths, starts)[of_run]
    before = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
    middle = before - before[starts][of_run] + 0.5 * lengths
    # A piece that lies in the middle between two parts goes to the later one, whatever the rounding.
    part = np.floor(middle / total * np.maximum(np.ceil(total / longest - 1e-9), 1.0) + 1e-6).astype(np.int64)
    changes = (np.diff(of_run, prepend=0) != 0) | (np.diff(part, prepend=0) != 0)
    changes[0] = False
    groups: IntArray = np.cumsum(changes)
    return groups


class Swinging:
    """Swings of a given size in turn, that change the elevation as little as they can.

    J = 1/S [ integral (z - z_s)^2 ds + evenness * integral (g - g_s - size * turn)^2 ds ]

    where turn is +1 and -1 from segment to segment. For each size it is convex, so that there is one
    answer; the size is then what the length asks for. (The length as an equation beside the change
    of elevation alone has many local optima, and rounding decides which one is found.)
    """

    def __init__(self, problem: Problem, swings: Swings, turn: FloatArray, evenness: float) -> None:
        self._lengths = problem.piece_lengths
        self._total = float(self._lengths.sum())
        self._swings = swings
        self._turn = swings.difference(turn)
        self._evenness = evenness / self._total
        self.size = 0.0

    def __call__(self, swings: FloatArray) -> tuple[float, FloatArray]:
        """Return value and derivative at the variables of stage two."""
        difference = self._swings.difference(swings)
        off = difference - self.size * self._turn
        change, by_gradient = self._change_of_elevation(difference)
        weighted = self._evenness * self._lengths * off
        return change + float(weighted @ off), self._swings.derivative(by_gradient + 2 * weighted)

    def start(self, turn: FloatArray) -> FloatArray:
        """Return the variables for a size of 1 where no limit is reached, (groups,).

        In the elevations at the groups' edges J is a chain, 0 at the anchors: one banded solve. On a
        long line descent from anywhere else would take thousands of steps.
        """
        lengths = self._swings.lengths
        steps = turn / np.sqrt(lengths)
        inner = np.flatnonzero(np.diff(self._swings.feasible_set.stretch_of) == 0)
        evenness = self._evenness * self._total
        bands = np.zeros((2, len(lengths) - 1))
        bands[1] = (lengths[:-1] + lengths[1:]) / 3 + evenness * (1 / lengths[:-1] + 1 / lengths[1:])
        bands[0, 1:] = lengths[1:-1] / 6 - evenness / lengths[1:-1]
        right = evenness * (steps[1:] - steps[:-1])
        held = np.setdiff1d(np.arange(len(right)), inner)
        bands[1, held], right[held] = 1.0, 0.0
        bands[0, held] = 0.0
        bands[0, held[held + 1 < len(right)] + 1] = 0.0
        if len(right) == 0:
            return np.zeros_like(turn)
        edges = np.concatenate([[0.0], solveh_banded(bands, right), [0.0]])
        start: FloatArray = -np.diff(edges) / np.sqrt(lengths)
        return start

    def change(self, swings: FloatArray) -> float:
        """Return the mean square change of the elevation, m²."""
        return self._change_of_elevation(self._swings.difference(swings))[0]

    def _change_of_elevation(self, difference: FloatArray) -> tuple[float, FloatArray]:
        fallen = np.concatenate([[0.0], np.cumsum(-self._lengths * difference)])
        before, after = fallen[:-1], fallen[1:]
        thirds = self._lengths / (3 * self._total)
        value = float(thirds @ (before * before + before * after + after * after))
        by_edge = np.zeros(len(fallen))
        by_edge[:-1] += thirds * (2 * before + after)
        by_edge[1:] += thirds * (before + 2 * after)
        return value, -self._lengths * np.cumsum(by_edge[:0:-1])[::-1]

"""The two objectives of the recommended method: the smoothest profile, and the least change from it."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import spsolve

from bobdesk.arrays import FloatArray
from bobdesk.solve.problem import Problem

SMOOTHNESS_SCALE = 1e4


class Smoothness:
    """Changes of gradient between neighbouring pieces.

    J = sum (g_{m+1} - g_m)^2 / ((D_m + D_{m+1}) / 2), scaled by 1e4, which brings it near 1. The
    difference between plan and 3D curvature needs no term of its own: with gradients that change
    gently it is some 1e-4 1/m by itself.
    """

    def __init__(self, problem: Problem) -> None:
        lengths = problem.piece_lengths
        self._problem = problem
        self._weights = SMOOTHNESS_SCALE / (0.5 * (lengths[1:] + lengths[:-1]))

    def __call__(self, v: FloatArray) -> tuple[float, FloatArray]:
        """Return value and derivative at the solvers' variables."""
        jumps = np.diff(self._problem.gradients(v))
        weighted = self._weights * jumps
        derivative = np.zeros(len(v))
        derivative[:-1] -= 2 * weighted
        derivative[1:] += 2 * weighted
        derivative /= self._problem.roots
        return float(jumps @ weighted), derivative


def smoothest_without_limits(problem: Problem) -> FloatArray:
    """Return the variables of the smoothest profile that keeps the equations and heeds no limits, (p,).

    A good start: where it lies within the limits it is the optimum already.
    """
    lengths = problem.piece_lengths
    feasible = problem.feasible_set
    count, stretches = len(lengths), len(feasible.falls)
    jumps = sparse.csr_array(sparse.eye_array(count - 1, count, k=1) - sparse.eye_array(count - 1, count))
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


class ChangeToLength:
    """The least change of elevation from the smoothest profile, spread evenly, that meets the length.

    J = 1/S [ integral (z - z_s)^2 ds + mu * integral (g - g_s)^4 ds ]

    under the length, by the augmented Lagrangian: multiplier * eL + penalty / 2 * eL^2 with
    eL = length - target. The quartic term keeps the change from piling up in a few short pieces.
    """

    def __init__(self, problem: Problem, smoothest: FloatArray, spread: float, length: float) -> None:
        self._problem = problem
        self._smoothest = smoothest
        self._spread = spread
        self._target = length
        self._total = float(problem.piece_lengths.sum())
        self.multiplier = 0.0
        self.penalty = 10.0

    def excess(self, v: FloatArray) -> float:
        """Return the length over the target, m."""
        return self._problem.length_of(self._problem.gradients(v))[0] - self._target

    def change(self, v: FloatArray) -> float:
        """Return J without the terms of the length."""
        return self._change(self._problem.gradients(v) - self._smoothest)[0]

    def __call__(self, v: FloatArray) -> tuple[float, FloatArray]:
        """Return value and derivative of the augmented Lagrangian at the solvers' variables."""
        gradients = self._problem.gradients(v)
        value, by_gradient = self._change(gradients - self._smoothest)
        length, by_length = self._problem.length_of(gradients)
        excess = length - self._target
        value += self.multiplier * excess + 0.5 * self.penalty * excess * excess
        by_gradient += (self.multiplier + self.penalty * excess) * by_length
        derivative = np.zeros(len(v))
        derivative[: len(gradients)] = by_gradient / self._problem.roots
        return value, derivative

    def _change(self, difference: FloatArray) -> tuple[float, FloatArray]:
        lengths = self._problem.piece_lengths
        fallen = np.concatenate([[0.0], np.cumsum(-lengths * difference)])
        before, after = fallen[:-1], fallen[1:]
        thirds = lengths / (3 * self._total)
        value = float(thirds @ (before * before + before * after + after * after))
        by_edge = np.zeros(len(fallen))
        by_edge[:-1] += thirds * (2 * before + after)
        by_edge[1:] += thirds * (before + 2 * after)
        derivative = -lengths * np.cumsum(by_edge[:0:-1])[::-1]
        cubes = (self._spread / self._total) * lengths * difference**3
        return value + float(cubes @ difference), derivative + 4 * cubes

"""The exact projection onto limits, height difference, known elevations and a mean gradient."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray, IntArray, frozen
from bobdesk.errors import TargetError

_STEPS = 200
_CLOSE = 1e-14
_BARELY = 1e-7
_NEWTON_STEPS = 6


@dataclass(frozen=True, eq=False)
class FeasibleSet:
    """The set of variables {v : low <= v <= high, the sum of weights * v over each stretch = falls}.

    Attributes
    ----------
    weights : (p,)
        Positive weight of each piece in its stretch.
    stretch_of : (p,)
        Index of the stretch between known elevations that each piece lies in, ascending from 0.
    falls : (m,)
        What the weighted sum over each stretch must be, m.
    low, high : (p,)
        Limits.
    mean_weights : (p,) or None
        Weights of a mean over all pieces that must be `mean`: the only equation that ties the
        stretches together.
    mean
        Its value.
    """

    weights: FloatArray
    stretch_of: IntArray
    falls: FloatArray
    low: FloatArray
    high: FloatArray
    mean_weights: FloatArray | None = None
    mean: float = 0.0

    def __post_init__(self) -> None:
        for name in ("weights", "falls", "low", "high"):
            object.__setattr__(self, name, frozen(getattr(self, name)))

    def reach(self) -> tuple[FloatArray, FloatArray]:
        """Return the smallest and the largest fall that the limits allow over each stretch, (m,), m."""
        count = len(self.falls)
        lowest: FloatArray = np.bincount(self.stretch_of, self.weights * self.low, count).astype(np.float64)
        highest: FloatArray = np.bincount(self.stretch_of, self.weights * self.high, count).astype(np.float64)
        return lowest, highest


class Projection:
    """The nearest point of a feasible set, by Euclidean distance.

    The known elevations part the pieces into stretches that do not share any, so that the problem
    falls apart into one continuous knapsack each: v = clip(w + multiplier * weights, low, high),
    where the multiplier is the root of a monotone, piecewise linear function. All stretches are
    solved at once by Newton's method inside a bracket. A mean over all pieces adds one multiplier
    around them, the root of a monotone function again; most often the pieces at their limits are
    nearly those of the last projection, and all multipliers are found at once.
    """

    def __init__(self, feasible: FeasibleSet) -> None:
        self._set = feasible
        self._starts = np.flatnonzero(np.diff(feasible.stretch_of, prepend=-1))
        self._single = len(feasible.falls) == 1
        self._squares = feasible.weights**2
        self._to_low, self._to_high = feasible.low / feasible.weights, feasible.high / feasible.weights
        self._mean_multiplier = 0.0
        self._last = 0.5 * (feasible.low + feasible.high)
        self._multipliers = np.zeros(len(feasible.falls))
        lowest, highest = feasible.reach()
        slack = 1e-9 * np.maximum(1.0, np.abs(feasible.falls))
        if (feasible.falls < lowest - slack).any() or (feasible.falls > highest + slack).any():
            raise TargetError("the limits, the drop and the known elevations contradict each other")
        self._falls = np.clip(feasible.falls, lowest, highest)

    def __call__(self, point: FloatArray) -> FloatArray:
        """Return the nearest point of the set to `point`, (p,).

        Raises
        ------
        TargetError
            If the set is empty because of the mean.
        """
        if self._set.mean_weights is None:
            return self._knapsacks(point)
        projected = self._from_the_last(point, self._set.mean_weights)
        if projected is None:
            projected = self._with_mean(point, self._set.mean_weights)
        self._last = projected
        return projected

    def _sum(self, values: FloatArray) -> FloatArray:
        return np.add.reduceat(values, self._starts)

    def _knapsacks(self, point: FloatArray) -> FloatArray:
        weights, low, high = self._set.weights, self._set.low, self._set.high
        stretch = self._set.stretch_of
        multiplier = (self._falls - self._sum(weights * point)) / self._sum(self._squares)
        scaled = point / weights
        lower = np.minimum.reduceat(self._to_low - scaled, self._starts)
        upper = np.maximum.reduceat(self._to_high - scaled, self._starts)
        exact = _CLOSE * (1.0 + np.abs(self._falls))
        close = exact + 1e-16 * float(np.abs(point).max())
        for _ in range(_STEPS):
            unclipped = point + (multiplier[0] if self._single else multiplier[stretch]) * weights
            projected = np.minimum(np.maximum(unclipped, low), high)
            residual = self._falls - self._sum(weights * projected)
            off = np.abs(residual) > close
            if not off.any():
                # From far away the multiplier is as good as it gets, but its rounding shows in the sums.
                return projected if (np.abs(residual) <= exact).all() else self._polished(projected)
            slope = self._sum(np.where(projected == unclipped, self._squares, 0.0))
            np.copyto(lower, multiplier, where=residual > 0)
            np.copyto(upper, multiplier, where=residual < 0)
            newton = multiplier + residual / np.maximum(slope, 1e-300)
            inside = (newton > lower) & (newton < upper)
            following = np.where(off, np.where(inside, newton, 0.5 * (lower + upper)), multiplier)
            if (following == multiplier).all():
                break
            multiplier = following
        return self._polished(projected)

    def _polished(self, projected: FloatArray) -> FloatArray:
        """Take what rounding left in the equations out of the pieces that are free to move."""
        weights, low, high = self._set.weights, self._set.low, self._set.high
        for _ in range(4):
            residual = self._falls - self._sum(weights * projected)
            room = np.where(residual[self._set.stretch_of] > 0, high - projected, projected - low)
            share = weights * np.minimum(room, 1.0) * weights
            power = np.maximum(self._sum(share), 1e-300)
            moved = projected + (residual / power)[self._set.stretch_of] * share / weights
            projected = np.minimum(np.maximum(moved, low), high)
        return projected

    def _from_the_last(self, point: FloatArray, mean_weights: FloatArray) -> FloatArray | None:
        """Solve for all multipliers at once, with the pieces free that were free the last time.

        A method's points lie close together, and so do the pieces at their limits. Newton's method on
        all equations is not safe from afar, but what it finds is tried against every equation.
        """
        weights, low, high, stretch = self._set.weights, self._set.low, self._set.high, self._set.stretch_of
        exact = _CLOSE * (1.0 + np.abs(self._falls))
        close = 1e4 * exact  # what polishing takes out
        mean_close = 1e-13 * max(1.0, abs(self._set.mean))
        projected, multipliers = self._last, self._multipliers
        free = (projected > low) & (projected < high)
        for _ in range(_NEWTON_STEPS):
            freed = np.where(free, weights, 0.0)
            tied = np.where(free, mean_weights, 0.0)
            held = np.where(free, point, projected)
            squares, cross = self._sum(freed * freed), self._sum(freed * tied)
            moves = squares > 0
            squares[~moves] = 1.0
            missing = self._falls - self._sum(weights * held)
            curvature = float(tied @ tied - cross @ (cross / squares))
            if curvature <= 1e-12 * float(tied @ tied):
                return None
            of_mean = (self._set.mean - float(mean_weights @ held) - float(cross @ (missing / squares))) / curvature
            # A stretch with all its pieces at their limits moves no equation: its multiplier stays.
            multipliers = np.where(moves, (missing - of_mean * cross) / squares, multipliers)
            unclipped = point + multipliers[stretch] * weights + of_mean * mean_weights
            projected = np.minimum(np.maximum(unclipped, low), high)
            residual = np.abs(self._falls - self._sum(weights * projected))
            if (residual <= close).all():
                solved = projected if (residual <= exact).all() else self._polished(projected)
                residual = np.abs(self._falls - self._sum(weights * solved))
                if (residual <= exact).all() and abs(float(mean_weights @ solved) - self._set.mean) <= mean_close:
                    self._mean_multiplier, self._multipliers = of_mean, multipliers
                    return solved
            free = projected == unclipped
            stuck = (residual > close) & (self._sum(free.astype(np.float64)) == 0)
            free |= stuck[stretch]
        return None

    def _with_mean(self, point: FloatArray, mean_weights: FloatArray) -> FloatArray:
        """Find the multiplier of the mean: bracket it by doubling, then regula falsi (Illinois)."""

        def over(multiplier: float) -> tuple[float, FloatArray]:
            projected = self._knapsacks(point + multiplier * mean_weights)
            return float(mean_weights @ projected) - self._set.mean, projected

        at = self._mean_multiplier
        excess, projected = over(at)
        close = 1e-13 * max(1.0, abs(self._set.mean))
        if abs(excess) <= close:
            return projected
        width = max(1.0, abs(at)) * (-1.0 if excess > 0 else 1.0)
        for _ in range(80):
            other = at + width
            other_excess, projected = over(other)
            if other_excess * excess <= 0:
                break
            width *= 2
        else:
            if abs(other_excess) <= _BARELY:
                return projected
            raise TargetError("the mean of the segments' gradients cannot be met within limits and elevations")
        for _ in range(_STEPS):
            if abs(other_excess) <= close or abs(other - at) <= 1e-16 * abs(other):
                break
            middle = other - other_excess * (other - at) / (other_excess - excess)
            middle_excess, projected = over(middle)
            if middle_excess * other_excess < 0:
                at, excess = other, other_excess
            else:
                excess *= 0.5
            other, other_excess = middle, middle_excess
        self._mean_multiplier = other
        return projected

"""Projected gradient descent with spectral steps, for any objective on any feasible set."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Generator
from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.solve.projection import Projection

Objective = Callable[[FloatArray], tuple[float, FloatArray]]


@dataclass(frozen=True)
class DescentSettings:
    """When descent ends and how far back its line search looks.

    Attributes
    ----------
    tolerance
        On the optimality measure, the largest component of P(v - derivative) - v.
    max_iterations
        Iterations at most.
    memory
        The line search compares with the largest of this many last values, so that spectral steps
        may go up now and then.
    """

    tolerance: float = 1e-9
    max_iterations: int = 3000
    memory: int = 8


@dataclass(frozen=True, eq=False)
class Descent:
    """A point on the way: variables, objective, optimality, step; evaluations so far."""

    v: FloatArray
    objective: float
    optimality: float
    step: float
    evaluations: int


_DECREASE = 1e-4
_SHORTEST, _LONGEST = 1e-12, 1e12


def descend(
    objective: Objective, start: FloatArray, project: Projection, settings: DescentSettings
) -> Generator[Descent, None, Descent]:
    """Minimise an objective over a feasible set; yields each accepted point, returns the last.

    Parameters
    ----------
    objective
        Value and derivative at a point, (p,).
    start
        Any point; it is projected first.
    project
        The projection onto the feasible set. Every iterate lies in the set.

    References
    ----------
    E. G. Birgin, J. M. Martínez, M. Raydan, Nonmonotone spectral projected gradient methods on
    convex sets, SIAM J. Optim. 10 (2000); step lengths by J. Barzilai, J. M. Borwein (1988).
    """
    v = project(start)
    value, derivative = objective(v)
    evaluations = 1
    recent = deque([value], maxlen=settings.memory)
    step = 1.0 / max(float(np.abs(derivative).max(initial=0.0)), 1e-300)
    for _ in range(settings.max_iterations):
        optimality = float(np.abs(project(v - derivative) - v).max(initial=0.0))
        current = Descent(v, value, optimality, step, evaluations)
        yield current
        if optimality <= settings.tolerance:
            return current
        direction = project(v - step * derivative) - v
        slope = float(derivative @ direction)
        if slope >= 0:
            return current
        highest, share = max(recent), 1.0
        while True:
            trial = v + share * direction
            trial_value, trial_derivative = objective(trial)
            evaluations += 1
            if trial_value <= highest + _DECREASE * share * slope:
                break
            if share < _SHORTEST:
                return current
            share = _shorter(share, slope, trial_value - value)
        move, change = trial - v, trial_derivative - derivative
        bend = float(move @ change)
        step = min(max(float(move @ move) / bend, _SHORTEST), _LONGEST) if bend > 0 else min(10 * step, _LONGEST)
        v, value, derivative = trial, trial_value, trial_derivative
        recent.append(value)
    return Descent(v, value, float(np.abs(project(v - derivative) - v).max(initial=0.0)), step, evaluations)


def _shorter(share: float, slope: float, rise: float) -> float:
    """Return the minimum of the parabola through the last trial, kept within a tenth and a half of it."""
    curved = rise - share * slope
    if curved <= 0:
        return 0.5 * share
    return max(0.1 * share, min(0.5 * share, -0.5 * share * share * slope / curved))

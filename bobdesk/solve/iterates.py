"""What a solver yields and returns."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bobdesk.arrays import FloatArray

if TYPE_CHECKING:
    from bobdesk.solve.profile import Profile


@dataclass(frozen=True, eq=False)
class Iterate:
    """One accepted step of a solver.

    Attributes
    ----------
    number
        Counts from 0, where the run begins, without a gap.
    stage
        What is being minimised, for a person.
    gradients : (p,)
        Of the pieces.
    objective
        Its value.
    length, drop
        Of this iterate, m.
    optimality
        Largest component of the projected-gradient step, 0 at an optimum; NaN where a method has none.
    step
        Step length along the negative derivative.
    scale
        Factor on the plan.
    profile, edge_gradients
        Rows and pieces that the gradients belong to, and the gradients given at the held edges: a run that is
        stopped before its end has its line from these.
    """

    number: int
    stage: str
    gradients: FloatArray
    objective: float
    length: float
    drop: float
    optimality: float
    step: float
    scale: float = 1.0
    profile: Profile | None = None
    edge_gradients: FloatArray | None = None


@dataclass(frozen=True, eq=False)
class Solution:
    """The end of a run; the names follow SciPy's OptimizeResult.

    Attributes
    ----------
    method
        Key of the solver.
    profile
        Rows and pieces, in the plan's own scale.
    gradients : (p,)
        Of the pieces.
    edge_gradients : (p-1,) or (1,)
        Given at the held edges.
    scale
        Factor on the plan.
    start_elevation
        Of the first row, m.
    status
        0 converged, 1 stopped at a limit of the number of iterations, 2 a target cannot be met.
    message
        Why it ended, one sentence.
    nit, nfev, njev
        Iterations, which is the number of the last iterate; evaluations of the objective; of its derivative.
    objective, optimality
        At the end.
    """

    method: str
    profile: Profile
    gradients: FloatArray
    edge_gradients: FloatArray
    scale: float
    start_elevation: float
    status: int
    message: str
    nit: int
    nfev: int
    njev: int
    objective: float
    optimality: float


Run = Generator[Iterate, None, Solution]

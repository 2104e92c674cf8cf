"""Second opinions: SciPy's methods on the published objective, within the same limits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.optimize import Bounds, OptimizeResult, differential_evolution, minimize

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.solve.anchors import anchors_of, elevations_of, stations_of
from bobdesk.solve.iterates import Iterate, Run, Solution
from bobdesk.solve.objective import PublishedObjective, Weights
from bobdesk.solve.problem import Problem, make_problem
from bobdesk.solve.profile import falls_between
from bobdesk.solve.targets import Targets

SecondOpinion = Literal["lbfgsb", "slsqp", "de"]


@dataclass(frozen=True)
class SecondOpinionSettings:
    """Weights of the objective, and how long a method may take.

    Attributes
    ----------
    weights
        a, b, c, d of the published objective.
    max_iterations
        Iterations, or generations.
    numeric_derivatives
        Let SLSQP difference the objective itself instead of using the exact derivative.
    seed
        Of the differential evolution.
    """

    weights: Weights = Weights()
    max_iterations: int = 1000
    numeric_derivatives: bool = False
    seed: int = 1


def second_opinion(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    method: SecondOpinion,
    settings: SecondOpinionSettings | None = None,
) -> Run:
    """Minimise the published objective by another method; yields its end, returns the solution.

    L-BFGS-B and differential evolution know limits only. SLSQP holds drop and known elevations as
    equations besides.

    Raises
    ------
    InputError
        If the scale is unknown; the recommended and the published method can find it.
    """
    settings = settings or SecondOpinionSettings()
    if targets.unknown_scale:
        raise InputError(f"the method {method} cannot find an unknown scale; pgd and published can")
    problem = make_problem(centreline, segments, targets, anchors_of(targets, centreline.length))
    objective = PublishedObjective(problem.profile, targets, settings.weights)
    count = len(problem.piece_lengths)
    start = np.clip(np.full(count, targets.drop / problem.profile.length), targets.min_gradient, targets.max_gradient)
    if method == "lbfgsb":
        result = minimize(
            objective.value_and_derivative,
            start,
            jac=True,
            bounds=_bounds(targets, count),
            method="L-BFGS-B",
            options={"maxiter": settings.max_iterations, "ftol": 1e-16, "gtol": 1e-10},
        )
    elif method == "slsqp":
        result = _slsqp(problem, objective, start, settings)
    else:
        result = differential_evolution(
            objective.value,
            _bounds(targets, count),
            maxiter=min(settings.max_iterations, 300),
            popsize=8,
            rng=settings.seed,
            x0=start,
            polish=False,
        )
    return (yield from _solution(problem, objective, result, method))


def _bounds(targets: Targets, count: int) -> Bounds:
    return Bounds(np.full(count, targets.min_gradient), np.full(count, targets.max_gradient))


def _slsqp(
    problem: Problem, objective: PublishedObjective, start: FloatArray, settings: SecondOpinionSettings
) -> OptimizeResult:
    rows = falls_between(problem.profile, stations_of(problem.anchors)).by_piece.toarray()
    wanted = -np.diff(elevations_of(problem.anchors))
    equations = {"type": "eq", "fun": lambda g: rows @ g - wanted, "jac": lambda g: rows}
    exact = not settings.numeric_derivatives
    return minimize(
        objective.value_and_derivative if exact else objective.value,
        start,
        jac=exact,
        bounds=_bounds(problem.targets, len(start)),
        constraints=[equations],
        method="SLSQP",
        options={"maxiter": settings.max_iterations, "ftol": 1e-14},
    )


def _solution(problem: Problem, objective: PublishedObjective, result: OptimizeResult, method: SecondOpinion) -> Run:
    gradients = np.clip(result.x, problem.targets.min_gradient, problem.targets.max_gradient)
    value, derivative = objective.value_and_derivative(gradients)
    terms = objective.terms(gradients)
    limited = np.clip(gradients - derivative, problem.targets.min_gradient, problem.targets.max_gradient)
    optimality = float(np.abs(limited - gradients).max())
    number = int(result.nit)
    yield Iterate(
        number=0,
        stage=method,
        gradients=gradients,
        objective=value,
        length=problem.targets.length - terms.length,
        drop=problem.targets.drop - terms.height,
        optimality=optimality,
        step=float("nan"),
    )
    return Solution(
        method=method,
        profile=problem.profile,
        gradients=gradients,
        edge_gradients=problem.edge_gradients,
        scale=1.0,
        start_elevation=problem.targets.drop,
        status=0 if result.success else 1,
        message=str(result.message).strip().rstrip(".") + ".",
        nit=number,
        nfev=objective.nfev - 1,
        njev=max(objective.njev - 1, 0),
        objective=value,
        optimality=optimality,
    )

"""Second opinions: SciPy's methods on the published objective, within the same limits."""

from __future__ import annotations

import warnings
from typing import Any, Literal

import numpy as np
from scipy.optimize import SR1, Bounds, LinearConstraint, differential_evolution, minimize

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.solve.anchors import anchors_of, elevations_of, stations_of
from bobdesk.solve.iterates import Iterate, Run, Solution
from bobdesk.solve.objective import PublishedObjective
from bobdesk.solve.problem import Problem, make_problem
from bobdesk.solve.profile import falls_between
from bobdesk.solve.settings import SecondOpinionSettings
from bobdesk.solve.targets import Targets

SecondOpinion = Literal["lbfgsb", "slsqp", "trustconstr", "de"]
_SCIPY_NAMES = {"lbfgsb": "L-BFGS-B", "slsqp": "SLSQP"}
_MOST_GENERATIONS = 300


def second_opinion(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    method: SecondOpinion,
    settings: SecondOpinionSettings | None = None,
) -> Run:
    """Minimise the published objective by another method; yields its end, returns the solution.

    L-BFGS-B and differential evolution know limits only. SLSQP and trust-constr hold drop and known
    elevations as equations besides.

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
    path: list[FloatArray] = []
    # SciPy's own types do not know that a function may return its derivative beside its value.
    options: dict[str, Any] = {"callback": lambda intermediate_result: path.append(intermediate_result.x.copy())}
    bounds = _bounds(targets, count)
    result: Any
    if method == "de":
        generations = min(settings.max_iterations, _MOST_GENERATIONS)
        result = differential_evolution(
            objective.value,
            bounds,
            maxiter=generations,
            popsize=8,
            rng=settings.seed,
            x0=start,
            polish=False,
            **options,
        )
    elif method == "trustconstr":
        result = _trust_constr(objective, problem, start, settings, path)
    else:
        exact = not settings.numeric_derivatives
        options |= {"jac": exact, "bounds": bounds, "method": _SCIPY_NAMES[method]}
        options["options"] = {"maxiter": settings.max_iterations, "ftol": 1e-16}
        if method == "slsqp":
            options["constraints"] = [_equations(problem)]
        result = minimize(objective.value_and_derivative if exact else objective.value, start, **options)
    return (yield from _solution(problem, objective, result, path, method))


def _trust_constr(
    objective: PublishedObjective,
    problem: Problem,
    start: FloatArray,
    settings: SecondOpinionSettings,
    path: list[FloatArray],
) -> Any:
    """Minimise in gradient * sqrt(length), in which it needs a tenth of the steps."""
    roots = problem.roots
    equations = _equations(problem)
    rows = equations["jac"](start)
    wanted = rows @ start - equations["fun"](start)
    targets = problem.targets

    def scaled(v: FloatArray) -> tuple[float, FloatArray]:
        value, derivative = objective.value_and_derivative(v / roots)
        return value, derivative / roots

    minimise: Any = minimize
    with warnings.catch_warnings():
        # Near the bottom two derivatives in a row can be equal to rounding, which SciPy tells every time.
        warnings.filterwarnings("ignore", "delta_grad == 0.0", UserWarning)
        result = minimise(
            scaled,
            start * roots,
            jac=True,
            hess=SR1(),
            method="trust-constr",
            bounds=Bounds(targets.min_gradient * roots, targets.max_gradient * roots),
            constraints=[LinearConstraint(rows / roots, wanted, wanted)],
            options={"maxiter": settings.max_iterations, "gtol": 1e-9, "xtol": 1e-10},
            callback=lambda intermediate_result: path.append(intermediate_result.x / roots),
        )
    result.x = result.x / roots
    return result


def _bounds(targets: Targets, count: int) -> Bounds:
    return Bounds(np.full(count, targets.min_gradient), np.full(count, targets.max_gradient))


def _equations(problem: Problem) -> dict[str, Any]:
    """Return drop and known elevations as SciPy's equations."""
    rows = falls_between(problem.profile, stations_of(problem.anchors)).by_piece.toarray()
    wanted = -np.diff(elevations_of(problem.anchors))
    return {"type": "eq", "fun": lambda gradients: rows @ gradients - wanted, "jac": lambda gradients: rows}


def _solution(
    problem: Problem, objective: PublishedObjective, result: Any, path: list[FloatArray], method: SecondOpinion
) -> Run:
    targets = problem.targets
    evaluations, derivatives = objective.nfev, objective.njev
    gradients = np.clip(result.x, targets.min_gradient, targets.max_gradient)
    optimality = float("nan")
    for number, at in enumerate([*path, gradients]):
        value, derivative = objective.value_and_derivative(at)
        terms = objective.terms(at)
        limited = np.clip(at - derivative, targets.min_gradient, targets.max_gradient)
        optimality = float(np.abs(limited - at).max())
        yield Iterate(
            number=number,
            stage=method,
            gradients=at,
            objective=value,
            length=targets.length - terms.length,
            drop=targets.drop - terms.height,
            optimality=optimality,
            step=float("nan"),
            profile=problem.profile,
            edge_gradients=problem.edge_gradients,
        )
    return Solution(
        method=method,
        profile=problem.profile,
        gradients=gradients,
        edge_gradients=problem.edge_gradients,
        scale=1.0,
        start_elevation=targets.drop,
        status=0 if result.success else 1,
        message=str(result.message).strip().rstrip(".").capitalize() + ".",
        nit=int(result.nit),
        nfev=evaluations,
        njev=derivatives,
        objective=objective.value(gradients),
        optimality=optimality,
    )

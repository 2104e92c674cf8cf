"""Second opinions: SciPy's methods on the published objective, within the same limits."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from contextlib import closing
from typing import Any, Literal

import numpy as np
from scipy.optimize import SR1, Bounds, LinearConstraint, differential_evolution, minimize

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.solve.anchors import anchors_of, elevations_of, stations_of
from bobdesk.solve.called_back import Calls, called_back
from bobdesk.solve.iterates import Iterate, Run, Solution
from bobdesk.solve.objective import PublishedObjective
from bobdesk.solve.problem import Problem, make_problem
from bobdesk.solve.profile import falls_between
from bobdesk.solve.settings import SecondOpinionSettings
from bobdesk.solve.targets import Targets
from bobdesk.solve.tolerances import settled

SecondOpinion = Literal["lbfgsb", "slsqp", "trustconstr", "de"]
_SCIPY_NAMES = {"lbfgsb": "L-BFGS-B", "slsqp": "SLSQP"}
_MOST_GENERATIONS = 300


def _go_on() -> bool:
    return False


def second_opinion(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    method: SecondOpinion,
    settings: SecondOpinionSettings | None = None,
    *,
    asked: Callable[[], bool] = _go_on,
) -> Run:
    """Minimise the published objective by another method; yields its iterates, returns the solution.

    L-BFGS-B and differential evolution know limits only. SLSQP and trust-constr hold drop and known
    elevations as equations besides.

    Parameters
    ----------
    asked
        Asked at each evaluation, on a thread of its own: whether to end. It may take its time.

    Raises
    ------
    InputError
        If the scale is unknown; the recommended and the published method can find it.
    StoppedWithinError
        If `asked` said to end.
    """
    settings = settings or SecondOpinionSettings()
    if targets.unknown_scale:
        raise InputError(f"the method {method} cannot find an unknown scale; pgd and published can")
    anchors = settled(anchors_of(targets, centreline.length), targets)
    problem = make_problem(centreline, segments, targets, anchors)
    count = len(problem.piece_lengths)
    start = np.clip(np.full(count, targets.drop / problem.profile.length), targets.min_gradient, targets.max_gradient)
    looks = _Looks(problem, settings, method)
    yield looks.iterate(start)
    objective = PublishedObjective(problem.profile, targets, settings.weights)

    def work(calls: Calls[FloatArray]) -> Any:
        return _minimised(objective, problem, start, method, settings, calls)

    job = called_back(work, asked)
    with closing(job):
        while True:
            try:
                at = next(job)
            except StopIteration as end:
                result = end.value
                break
            yield looks.iterate(at)
    gradients = np.clip(result.x, targets.min_gradient, targets.max_gradient)
    if not np.array_equal(gradients, looks.newest.gradients):
        yield looks.iterate(gradients)
    return Solution(
        method=method,
        profile=problem.profile,
        gradients=gradients,
        edge_gradients=problem.edge_gradients,
        scale=1.0,
        start_elevation=targets.drop,
        status=0 if result.success else 1,
        message=str(result.message).strip().rstrip(".").capitalize() + ".",
        nit=looks.newest.number,
        nfev=objective.nfev,
        njev=objective.njev,
        objective=looks.newest.objective,
        optimality=looks.newest.optimality,
    )


class _Looks:
    """Looks at a method's iterates with an objective of its own, so that the method's evaluations alone are counted."""

    def __init__(self, problem: Problem, settings: SecondOpinionSettings, method: SecondOpinion) -> None:
        self._problem = problem
        self._objective = PublishedObjective(problem.profile, problem.targets, settings.weights)
        self._method = method
        self._number = 0
        self.newest: Iterate

    def iterate(self, at: FloatArray) -> Iterate:
        """Return the next iterate."""
        targets = self._problem.targets
        value, derivative = self._objective.value_and_derivative(at)
        terms = self._objective.terms(at)
        limited = np.clip(at - derivative, targets.min_gradient, targets.max_gradient)
        self.newest = Iterate(
            number=self._number,
            stage=self._method,
            gradients=at,
            objective=value,
            length=targets.length - terms.length,
            drop=targets.drop - terms.height,
            optimality=float(np.abs(limited - at).max()),
            step=float("nan"),
            profile=self._problem.profile,
            edge_gradients=self._problem.edge_gradients,
        )
        self._number += 1
        return self.newest


def _minimised(
    objective: PublishedObjective,
    problem: Problem,
    start: FloatArray,
    method: SecondOpinion,
    settings: SecondOpinionSettings,
    calls: Calls[FloatArray],
) -> Any:
    """Return what SciPy makes of it; every evaluation checks whether to go on."""

    def value(gradients: FloatArray) -> float:
        calls.check()
        return objective.value(gradients)

    def value_and_derivative(gradients: FloatArray) -> tuple[float, FloatArray]:
        calls.check()
        return objective.value_and_derivative(gradients)

    if method == "trustconstr":
        return _trust_constr(value_and_derivative, problem, start, settings, calls)
    bounds = _bounds(problem.targets, len(start))
    # SciPy's own types do not know that a function may return its derivative beside its value.
    options: dict[str, Any] = {"callback": lambda intermediate_result: calls.give(intermediate_result.x.copy())}
    if method == "de":
        generations = min(settings.max_iterations, _MOST_GENERATIONS)
        return differential_evolution(
            value, bounds, maxiter=generations, popsize=8, rng=settings.seed, x0=start, polish=False, **options
        )
    exact = not settings.numeric_derivatives
    options |= {"jac": exact, "bounds": bounds, "method": _SCIPY_NAMES[method]}
    options["options"] = {"maxiter": settings.max_iterations, "ftol": 1e-16}
    if method == "slsqp":
        options["constraints"] = [_equations(problem)]
    minimise: Any = minimize
    return minimise(value_and_derivative if exact else value, start, **options)


class _CheckedHessian(SR1):
    """Its products are what trust-constr spends its time on between two evaluations."""

    def __init__(self, calls: Calls[FloatArray]) -> None:
        super().__init__()
        self._calls = calls

    def dot(self, p: Any) -> Any:
        """Return the product with a vector."""
        self._calls.check()
        return super().dot(p)


def _trust_constr(
    value_and_derivative: Callable[[FloatArray], tuple[float, FloatArray]],
    problem: Problem,
    start: FloatArray,
    settings: SecondOpinionSettings,
    calls: Calls[FloatArray],
) -> Any:
    """Minimise in gradient * sqrt(length), in which it needs a tenth of the steps."""
    roots = problem.roots
    equations = _equations(problem)
    rows = equations["jac"](start)
    wanted = rows @ start - equations["fun"](start)
    targets = problem.targets

    def scaled(v: FloatArray) -> tuple[float, FloatArray]:
        value, derivative = value_and_derivative(v / roots)
        return value, derivative / roots

    minimise: Any = minimize
    with warnings.catch_warnings():
        # Near the bottom two derivatives in a row can be equal to rounding, which SciPy tells every time.
        warnings.filterwarnings("ignore", "delta_grad == 0.0", UserWarning)
        result = minimise(
            scaled,
            start * roots,
            jac=True,
            hess=_CheckedHessian(calls),
            method="trust-constr",
            bounds=Bounds(targets.min_gradient * roots, targets.max_gradient * roots),
            constraints=[LinearConstraint(rows / roots, wanted, wanted)],
            options={"maxiter": settings.max_iterations, "gtol": 1e-9, "xtol": 1e-10},
            callback=lambda intermediate_result: calls.give(intermediate_result.x / roots),
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

"""Start a solver by its name: the one list of methods.

The solvers are imported where they are started: the window lists them before scipy is loaded.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Protocol

from bobdesk.alignment.segments import Segments
from bobdesk.errors import InputError
from bobdesk.solve.iterates import Run
from bobdesk.solve.settings import PublishedSettings, SecondOpinionSettings, SolverSettings
from bobdesk.solve.targets import Targets, check_targets

if TYPE_CHECKING:
    from bobdesk.alignment.centreline import Centreline
    from bobdesk.solve.second_opinions import SecondOpinion
    from bobdesk.solve.warm_start import WarmStart


class Solver(Protocol):
    """Finds the gradients of all pieces: a generator of iterates that returns the solution.

    It may raise InputError and TargetError, with one sentence.
    """

    def __call__(self, centreline: Centreline, segments: Segments, targets: Targets, settings: SolverSettings) -> Run:
        """Start; `targets` are checked, and their known elevations count along the centreline."""


class WarmSolver(Protocol):
    """A solver that can begin where another run ended."""

    def __call__(
        self,
        centreline: Centreline,
        segments: Segments,
        targets: Targets,
        settings: SolverSettings,
        *,
        warm: WarmStart | None,
    ) -> Run:
        """Start; None begins as `solve` does."""


class AskingSolver(Protocol):
    """A solver that asks while it works, and not only between two iterates, whether to end."""

    def __call__(
        self,
        centreline: Centreline,
        segments: Segments,
        targets: Targets,
        settings: SolverSettings,
        *,
        asked: Callable[[], bool],
    ) -> Run:
        """Start; raise StoppedWithinError once `asked`, which may take its time, has said to end."""


@dataclass(frozen=True)
class SolverMethod:
    """A method; what an entry point of the group "bobdesk.solvers" must be.

    Attributes
    ----------
    key
        Short name in lower case, as `--method` takes it and `Solution.method` holds it.
    title
        For a person.
    solve
        Starts it.
    holds_known
        Whether known elevations are held; else they are left out.
    solve_from
        Starts it where an earlier run ended; None where that is of no use. The recommended method has none, since
        its first stage begins at the exact optimum without limits.
    solve_asking
        Starts it so that it can be stopped between two iterates; None where these follow each other fast.
    """

    key: str
    title: str
    solve: Solver
    holds_known: bool = True
    solve_from: WarmSolver | None = None
    solve_asking: AskingSolver | None = None


def _pgd(centreline: Centreline, segments: Segments, targets: Targets, settings: SolverSettings) -> Run:
    from bobdesk.solve.pgd import pgd

    return pgd(centreline, segments, targets, settings.pgd)


def _published(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: SolverSettings,
    *,
    warm: WarmStart | None = None,
) -> Run:
    from bobdesk.solve.published import published

    chosen = PublishedSettings(weights=settings.weights, rate=settings.rate, threshold=settings.threshold)
    return published(centreline, segments, targets, chosen, warm=warm)


def _go_on() -> bool:
    return False


def _second_opinion(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: SolverSettings,
    *,
    method: SecondOpinion,
    asked: Callable[[], bool] = _go_on,
) -> Run:
    from bobdesk.solve.second_opinions import second_opinion

    chosen = SecondOpinionSettings(weights=settings.weights)
    return second_opinion(centreline, segments, targets, method, chosen, asked=asked)


def _second(key: SecondOpinion, title: str, *, holds_known: bool) -> SolverMethod:
    solver = partial(_second_opinion, method=key)
    return SolverMethod(key, title, solver, holds_known=holds_known, solve_asking=solver)


METHODS: tuple[SolverMethod, ...] = (
    SolverMethod("pgd", "Projected gradient descent, recommended", _pgd),
    SolverMethod("published", "The published method", _published, holds_known=False, solve_from=_published),
    _second("lbfgsb", "L-BFGS-B", holds_known=False),
    _second("slsqp", "SLSQP", holds_known=True),
    _second("trustconstr", "trust-constr", holds_known=True),
    _second("de", "Differential evolution", holds_known=False),
)


def solve(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: SolverSettings,
    *,
    methods: tuple[SolverMethod, ...] = METHODS,
    warm: WarmStart | None = None,
    asked: Callable[[], bool] = _go_on,
) -> Run:
    """Start the solver of the settings; a generator of iterates that returns the solution.

    Parameters
    ----------
    centreline, segments, targets
        In one scale.
    settings
        The method, and what is set of it.
    methods
        Those that there are; `bobdesk.files.solvers` adds other packages'.
    warm
        Where to begin, for methods that can make use of it.
    asked
        For methods that compute long between two iterates: whether to end, asked while they do, on any thread. It may
        take its time.

    Raises
    ------
    InputError
        If a target is no usable number, there is no such method, or it cannot do what is asked.
    TargetError
        If limits, drop and known elevations contradict each other.
    StoppedWithinError
        If `asked` said to end.
    """
    check_targets(targets)
    method = method_named(settings.method, methods)
    if warm is not None and method.solve_from is not None:
        return method.solve_from(centreline, segments, targets, settings, warm=warm)
    if method.solve_asking is not None:
        return method.solve_asking(centreline, segments, targets, settings, asked=asked)
    return method.solve(centreline, segments, targets, settings)


def method_named(key: str, methods: tuple[SolverMethod, ...] = METHODS) -> SolverMethod:
    """Return the method with a key.

    Raises
    ------
    InputError
        If there is none.
    """
    for method in methods:
        if method.key == key:
            return method
    known = ", ".join(method.key for method in methods)
    raise InputError(f"there is no method '{key[:40]}'; there are {known}, and others come with plug-ins")

"""Start a solver by its name: the one list of methods.

The solvers are imported where they are started: the window lists them before scipy is loaded.
"""

from __future__ import annotations

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
    """

    key: str
    title: str
    solve: Solver
    holds_known: bool = True
    solve_from: WarmSolver | None = None


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


def _second_opinion(
    centreline: Centreline, segments: Segments, targets: Targets, settings: SolverSettings, *, method: SecondOpinion
) -> Run:
    from bobdesk.solve.second_opinions import second_opinion

    return second_opinion(centreline, segments, targets, method, SecondOpinionSettings(weights=settings.weights))


METHODS: tuple[SolverMethod, ...] = (
    SolverMethod("pgd", "Projected gradient descent, recommended", _pgd),
    SolverMethod("published", "The published method", _published, holds_known=False, solve_from=_published),
    SolverMethod("lbfgsb", "L-BFGS-B", partial(_second_opinion, method="lbfgsb"), holds_known=False),
    SolverMethod("slsqp", "SLSQP", partial(_second_opinion, method="slsqp")),
    SolverMethod("trustconstr", "trust-constr", partial(_second_opinion, method="trustconstr")),
    SolverMethod("de", "Differential evolution", partial(_second_opinion, method="de"), holds_known=False),
)


def solve(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: SolverSettings,
    *,
    methods: tuple[SolverMethod, ...] = METHODS,
    warm: WarmStart | None = None,
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

    Raises
    ------
    InputError
        If a target is no usable number, there is no such method, or it cannot do what is asked.
    TargetError
        If limits, drop and known elevations contradict each other.
    """
    check_targets(targets)
    method = method_named(settings.method, methods)
    if warm is not None and method.solve_from is not None:
        return method.solve_from(centreline, segments, targets, settings, warm=warm)
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

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


class Solver(Protocol):
    """Finds the gradients of all pieces: a generator of iterates that returns the solution.

    It may raise InputError and TargetError, with one sentence.
    """

    def __call__(self, centreline: Centreline, segments: Segments, targets: Targets, settings: SolverSettings) -> Run:
        """Start; `targets` are checked, and their known elevations count along the centreline."""


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
    """

    key: str
    title: str
    solve: Solver
    holds_known: bool = True


def _pgd(centreline: Centreline, segments: Segments, targets: Targets, settings: SolverSettings) -> Run:
    from bobdesk.solve.pgd import pgd

    return pgd(centreline, segments, targets, settings.pgd)


def _published(centreline: Centreline, segments: Segments, targets: Targets, settings: SolverSettings) -> Run:
    from bobdesk.solve.published import published

    return published(centreline, segments, targets, PublishedSettings(weights=settings.weights, rate=settings.rate))


def _second_opinion(
    centreline: Centreline, segments: Segments, targets: Targets, settings: SolverSettings, *, method: SecondOpinion
) -> Run:
    from bobdesk.solve.second_opinions import second_opinion

    return second_opinion(centreline, segments, targets, method, SecondOpinionSettings(weights=settings.weights))


METHODS: tuple[SolverMethod, ...] = (
    SolverMethod("pgd", "Projected gradient descent, recommended", _pgd),
    SolverMethod("published", "The published method", _published, holds_known=False),
    SolverMethod("lbfgsb", "L-BFGS-B", partial(_second_opinion, method="lbfgsb"), holds_known=False),
    SolverMethod("slsqp", "SLSQP", partial(_second_opinion, method="slsqp")),
    SolverMethod("de", "Differential evolution", partial(_second_opinion, method="de"), holds_known=False),
)


def solve(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: SolverSettings,
    *,
    methods: tuple[SolverMethod, ...] = METHODS,
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

    Raises
    ------
    InputError
        If a target is no usable number, there is no such method, or it cannot do what is asked.
    TargetError
        If limits, drop and known elevations contradict each other.
    """
    check_targets(targets)
    return method_named(settings.method, methods).solve(centreline, segments, targets, settings)


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

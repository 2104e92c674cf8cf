"""Start a solver by its name: the one list of methods."""

from __future__ import annotations

from dataclasses import dataclass, field

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.solve.iterates import Method, Run
from bobdesk.solve.objective import Weights
from bobdesk.solve.pgd import pgd
from bobdesk.solve.published import PublishedSettings, published
from bobdesk.solve.second_opinions import SecondOpinionSettings, second_opinion
from bobdesk.solve.stages import PgdSettings
from bobdesk.solve.targets import Targets, check_targets


@dataclass(frozen=True)
class SolverSettings:
    """The method and what can be set of it.

    Attributes
    ----------
    method
        One of `Method`.
    pgd
        Settings of the recommended method.
    weights
        a, b, c, d of the published objective, for all other methods.
    rate
        η of the published method, or None for its usual value.
    """

    method: Method = "pgd"
    pgd: PgdSettings = field(default_factory=PgdSettings)
    weights: Weights = field(default_factory=Weights)
    rate: float | None = None


def solve(centreline: Centreline, segments: Segments, targets: Targets, settings: SolverSettings) -> Run:
    """Start the solver of the settings; a generator of iterates that returns the solution.

    Raises
    ------
    InputError
        If a target is no usable number, or the method cannot do what is asked.
    TargetError
        If limits, drop and known elevations contradict each other.
    """
    check_targets(targets)
    if settings.method == "pgd":
        return pgd(centreline, segments, targets, settings.pgd)
    if settings.method == "published":
        return published(centreline, segments, targets, PublishedSettings(weights=settings.weights, rate=settings.rate))
    return second_opinion(
        centreline, segments, targets, settings.method, SecondOpinionSettings(weights=settings.weights)
    )

"""Start a solver by its name: the one list of methods."""

from __future__ import annotations

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.solve.iterates import Run
from bobdesk.solve.pgd import pgd
from bobdesk.solve.published import published
from bobdesk.solve.second_opinions import second_opinion
from bobdesk.solve.settings import PublishedSettings, SecondOpinionSettings, SolverSettings
from bobdesk.solve.targets import Targets, check_targets


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

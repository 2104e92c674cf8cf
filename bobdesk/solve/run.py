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
from bobdesk.solve.warm_start import WarmStart


def solve(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: SolverSettings,
    *,
    warm: WarmStart | None = None,
) -> Run:
    """Start the solver of the settings; a generator of iterates that returns the solution.

    Parameters
    ----------
    warm
        Where the published method begins, instead of equal height differences. The recommended method has no
        use for it, since its first stage begins at the exact optimum without limits.

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
        chosen = PublishedSettings(
            weights=settings.weights, rate=settings.rate, threshold=settings.threshold
        )
        return published(centreline, segments, targets, chosen, warm=warm)
    return second_opinion(
        centreline, segments, targets, settings.method, SecondOpinionSettings(weights=settings.weights)
    )

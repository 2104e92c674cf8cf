"""The guard against dips: a profile that lay below its lowest point would have a larger drop than asked for."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.problem import Problem, make_problem
from bobdesk.solve.settings import PgdSettings
from bobdesk.solve.targets import Targets
from bobdesk.solve.tolerances import settled

_ROUNDS_OF_LOWEST = 12
_BELOW = 1e-9


@dataclass(frozen=True)
class Guard:
    """What keeps a profile from dipping below the lowest point, which would make the drop too large.

    Attributes
    ----------
    downhill
        Ranges of stations before a lowest point, in which the track may not climb.
    held
        Stations held level at 0, where it must climb afterwards.
    """

    downhill: tuple[tuple[float, float], ...] = ()
    held: tuple[float, ...] = ()


def laid_out(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: PgdSettings,
    scale: float,
    guard: Guard,
    *,
    through: FloatArray | None = None,
    end: float | None = None,
) -> Problem:
    """Put plan and targets together under a guard; elevations with tolerances, and a free end, are settled.

    Parameters
    ----------
    through
        As for `Problem`.
    end
        Elevation that a free end is held at, m; None for the smoothest course.

    Raises
    ------
    TargetError
        If limits, drop and known elevations contradict each other.
    """
    anchors = settled(anchors_of(targets, centreline.length, guard.held), targets, scale=scale)
    if end is not None:
        anchors = (*anchors[:-1], replace(anchors[-1], elevation=end))
    return make_problem(
        centreline,
        segments,
        targets,
        anchors,
        transition=settings.transition,
        longest_piece=settings.longest_piece,
        scale=scale,
        downhill=guard.downhill,
        through=through,
        level_out=settings.level_out,
    )


def stronger_guard(problem: Problem, v: FloatArray, guard: Guard) -> Guard:
    """Return a guard against the deepest dip of a profile below the lowest point, or the same one."""
    dip = _deepest_dip(problem, problem.gradients(v))
    rounds = len(guard.held) + len(guard.downhill)
    if dip is None or rounds >= _ROUNDS_OF_LOWEST:
        return guard
    following = next(anchor for anchor in problem.anchors if anchor.station > dip)
    if following.elevation == 0 and not any(start <= dip < end for start, end in guard.downhill):
        return replace(guard, downhill=(*guard.downhill, (dip, following.station)))
    return replace(guard, held=(*guard.held, dip))


def _deepest_dip(problem: Problem, gradients: FloatArray) -> float | None:
    """Return the break nearest to where the profile lies deepest below the lowest point, or None."""
    if problem.targets.min_gradient >= 0:
        return None
    falls = problem.scale * problem.profile.falls(gradients, problem.edge_gradients)
    elevations = problem.targets.drop - np.concatenate([[0.0], np.cumsum(falls)])
    row = int(elevations.argmin())
    if elevations[row] >= -max(_BELOW, 1e-12 * problem.targets.drop):
        return None
    inner = problem.profile.edges[1:-1]
    if len(inner) == 0:
        return None
    return float(inner[np.abs(inner - problem.profile.stations[row]).argmin()])

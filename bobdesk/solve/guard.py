"""The guard against dips: a profile that lay below its lowest point would have a larger drop than asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.errors import TargetError
from bobdesk.solve.anchors import anchors_of, stations_of
from bobdesk.solve.problem import Problem, Ranges, make_problem
from bobdesk.solve.settings import PgdSettings
from bobdesk.solve.smoothness import Smoothness, smoothest_without_limits
from bobdesk.solve.targets import KnownElevation, Targets
from bobdesk.solve.tolerances import room_of_free_end, settled

_ROUNDS = 24
_BELOW = 1e-9


@dataclass(frozen=True)
class Guard:
    """What keeps a profile from dipping below the lowest point, which would make the drop too large.

    Attributes
    ----------
    downhill
        Ranges of stations before a lowest point, in which the track may not climb.
    uphill
        Ranges in which it may not fall.
    held
        Stations held level at 0, where it must climb afterwards.
    """

    downhill: Ranges = ()
    uphill: Ranges = ()
    held: tuple[float, ...] = ()

    @property
    def rounds(self) -> int:
        """How many dips it was made against."""
        return len(self.downhill) + len(self.uphill) + len(self.held)

    def is_new(self, other: Guard) -> bool:
        """Return whether it asks for what another one did not."""
        mine, others = ({*one.downhill, *one.uphill, *one.held} for one in (self, other))
        return not mine <= others


def laid_out(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: PgdSettings,
    scale: float,
    *,
    guard: Guard,
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

    def with_end(elevation: float) -> Problem:
        return make_problem(
            centreline,
            segments,
            targets,
            (*anchors[:-1], replace(anchors[-1], elevation=elevation)),
            transition=settings.transition,
            longest_piece=settings.longest_piece,
            scale=scale,
            downhill=guard.downhill,
            uphill=guard.uphill,
            through=through,
            level_out=settings.level_out,
        )

    if end is None and targets.segments_mean is not None:
        room = room_of_free_end(targets, centreline.length, scale=scale)
        if room is not None and room[0] < room[1]:
            end = _smoothest_end(with_end, *room)
    return with_end(anchors[-1].elevation if end is None else end)


def _smoothest_end(with_end: Callable[[float], Problem], low: float, high: float) -> float | None:
    """Return the elevation of a free end with which a profile of the wanted mean gradient is smoothest, m.

    The mean over the segments asks for a climb where they are short. Without limits the smoothness of the best profile
    is a parabola over the elevation of the end. None where a guard lets the line climb no more behind its lowest point.
    """
    ends = low + (high - low) * np.array([0.25, 0.5, 0.75])
    values = []
    for end in ends.tolist():
        try:
            problem = with_end(end)
        except TargetError:
            return None
        values.append(Smoothness(problem)(smoothest_without_limits(problem))[0])
    bend, slope, _ = np.polyfit(ends, values, 2)
    best = -0.5 * slope / bend if bend > 0 else ends[int(np.argmin(values))]
    return float(np.clip(best, low, high))


def stronger_guard(problem: Problem, v: FloatArray, guard: Guard) -> Guard:
    """Return a guard against the deepest dip of a profile below the lowest point, or the same one if it has none.

    Raises
    ------
    TargetError
        If all guards were tried and it still dips, which would make the drop too large.
    """
    dip = _deepest_dip(problem, problem.gradients(v))
    if dip is None:
        return guard
    ends = stations_of(problem.anchors)
    index = int(np.searchsorted(ends, dip, side="right"))
    before, after = problem.anchors[index - 1], problem.anchors[index]
    inner = problem.profile.edges[(problem.profile.edges > before.station) & (problem.profile.edges < after.station)]
    edge = float(inner[np.abs(inner - dip).argmin()]) if len(inner) else before.station
    stretch = (before.station, after.station)
    tried: list[Guard] = []
    if after.elevation == 0:
        tried.append(replace(guard, downhill=(*guard.downhill, (edge, after.station))))
    if len(inner) and _can_touch_down(problem, before, after, edge):
        tried.append(replace(guard, held=(*guard.held, edge)))
    if before.elevation >= after.elevation:
        tried.append(replace(guard, downhill=(*guard.downhill, stretch)))
    else:
        tried.append(replace(guard, uphill=(*guard.uphill, stretch)))
    for stronger in tried:
        if stronger.rounds <= _ROUNDS and stronger.is_new(guard):
            return stronger
    raise TargetError(
        f"around {dip:.1f} m no profile was found that keeps the known elevations and lies nowhere below the lowest"
        " point: doubt the elevations there, or where the lowest point is"
    )


def _can_touch_down(problem: Problem, before: KnownElevation, after: KnownElevation, edge: float) -> bool:
    """Return whether the limits let a track lie at 0 between two anchors."""
    fall = problem.scale * (edge - before.station) * problem.targets.max_gradient
    climb = -problem.scale * (after.station - edge) * problem.targets.min_gradient
    return before.elevation <= fall and after.elevation <= climb


def _deepest_dip(problem: Problem, gradients: FloatArray) -> float | None:
    """Return the station where the profile lies deepest below the lowest point, or None."""
    if problem.targets.min_gradient >= 0:
        return None
    falls = problem.scale * problem.profile.falls(gradients, problem.edge_gradients)
    elevations = problem.targets.drop - np.concatenate([[0.0], np.cumsum(falls)])
    row = int(elevations.argmin())
    if elevations[row] >= -max(_BELOW, 1e-12 * problem.targets.drop):
        return None
    return float(problem.profile.stations[row])

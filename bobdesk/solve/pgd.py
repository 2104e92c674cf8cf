"""The recommended method: projected gradient descent in two stages on the exact feasible set."""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import dataclass, replace

import numpy as np

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.errors import TargetError
from bobdesk.solve.guard import Guard, laid_out, stronger_guard
from bobdesk.solve.iterates import Iterate, Run, Solution
from bobdesk.solve.problem import Problem
from bobdesk.solve.projection import Projection
from bobdesk.solve.settings import PgdSettings
from bobdesk.solve.stages import (
    LENGTH_TOLERANCE,
    Reach,
    Result,
    Tally,
    reachable_lengths,
    smoothest_profile,
    solve_stages,
)
from bobdesk.solve.targets import Targets
from bobdesk.solve.tolerances import room_of_free_end

_ROUNDS_OF_SCALE = 20
_PASSES = 3
_SPIKE = 0.002
_CLOSE_ENDS = 0.05


def pgd(centreline: Centreline, segments: Segments, targets: Targets, settings: PgdSettings | None = None) -> Run:
    """Reconstruct the gradients; a generator of iterates that returns the solution.

    Drop, limits, known elevations and a mean over the segments' gradients hold at every iterate.
    Stage one finds the smoothest profile, stage two the least change of elevation from it that
    meets the length. With an unknown scale the factor f on the plan meets the length instead.
    A profile that dips below the lowest point is solved again under a guard.

    Raises
    ------
    TargetError
        If limits, drop and known elevations contradict each other.
    """
    settings = settings or PgdSettings()
    tally = Tally()
    solved = yield from _solved(centreline, segments, targets, settings, tally, None)
    if not solved.result.met and settings.meet_length and not targets.unknown_scale:
        solved = yield from _with_another_end(centreline, segments, targets, settings, tally, solved)
    problem, result, settings = solved.problem, solved.result, solved.settings
    yield _last(problem, result, tally)
    return _solution(problem, result, settings, tally)


@dataclass(frozen=True, eq=False)
class _Solved:
    problem: Problem
    result: Result
    settings: PgdSettings


def _solved(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: PgdSettings,
    tally: Tally,
    end: float | None,
) -> Generator[Iterate, None, _Solved]:
    """Solve until no profile dips, the transitions at known elevations are smooth, and the scale is found."""
    guard = Guard()
    scale = 1.0
    through: FloatArray | None = None
    passes = 0
    while True:
        problem = laid_out(centreline, segments, targets, settings, scale, guard, through=through, end=end)
        if targets.unknown_scale:
            problem = yield from _with_scale(problem, settings, tally)
            scale = problem.scale
        result = yield from solve_stages(problem, settings, tally)
        if targets.unknown_scale and settings.typical_swing > 0 and not result.met:
            # The limits leave no room for the swing that tracks have: the smoothest profile it is.
            settings = replace(settings, typical_swing=0.0)
            continue
        stronger = stronger_guard(problem, result.v, guard)
        if stronger != guard:
            guard, through = stronger, None
            continue
        smoother = _through_anchors(problem, problem.gradients(result.v))
        passes += 1
        if passes > _PASSES or np.abs(smoother - problem.edge_gradients[: len(smoother)]).max(initial=0.0) < _SPIKE:
            return _Solved(problem, result, settings)
        through = smoother[problem.profile.held]


def _with_another_end(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: PgdSettings,
    tally: Tally,
    smoothest: _Solved,
) -> Generator[Iterate, None, _Solved]:
    """Move a free end away from its smoothest course by as little as the length asks for, if that meets it."""
    near = smoothest.problem.anchors[-1].elevation
    length = smoothest.problem.length_of(smoothest.problem.gradients(smoothest.result.v))[0]
    room = room_of_free_end(targets, centreline.length)
    if room is None:
        return smoothest
    far = room[1] if length < targets.length else room[0]
    found = smoothest
    while abs(far - near) > _CLOSE_ENDS:
        end = far if found is smoothest else 0.5 * (near + far)
        try:
            tried = yield from _solved(centreline, segments, targets, settings, tally, end)
        except TargetError:
            tried = smoothest
        if tried.result.met:
            found, far = tried, end
        elif found is smoothest:
            break
        else:
            near = end
    return found


def _through_anchors(problem: Problem, gradients: FloatArray) -> FloatArray:
    """Return the mean gradient of the pieces beside each inner edge that is held, 0 at others, (p-1,).

    With it a transition at a known elevation passes straight from one gradient to the next, where
    one that is guessed beforehand would make it go up and down again. Level edges stay level.
    """
    means = 0.5 * (gradients[:-1] + gradients[1:])
    given = problem.edge_gradients[: len(means)]
    level = np.zeros(len(means), dtype=np.bool_)
    inner = np.array([anchor.elevation for anchor in problem.anchors[1:-1]])
    level[np.flatnonzero(problem.profile.held)] = (inner == 0) & problem.climbs
    smoother: FloatArray = np.where(problem.profile.held & ~level, means, given)
    return smoother


def reach(
    centreline: Centreline, segments: Segments, targets: Targets, settings: PgdSettings, *, scale: float
) -> Generator[Iterate, None, tuple[float, float]]:
    """Find the shortest and the longest plausible length that keep drop, limits and elevations, m.

    A free end may lie anywhere for that.

    Raises
    ------
    TargetError
        If no profile keeps those.
    """
    low, high = yield from _reach(centreline, segments, targets, settings, scale, None)
    for end in room_of_free_end(targets, centreline.length, scale=scale) or ():
        try:
            others = yield from _reach(centreline, segments, targets, settings, scale, end)
        except TargetError:
            continue
        low, high = min(low, others[0]), max(high, others[1])
    return low, high


def _reach(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: PgdSettings,
    scale: float,
    end: float | None,
) -> Generator[Iterate, None, tuple[float, float]]:
    guard = Guard()
    low: float | None = None
    while True:
        problem = laid_out(centreline, segments, targets, settings, scale, guard, end=end)
        found: Reach = yield from reachable_lengths(problem, settings)
        low = found.low if low is None else low
        stronger = stronger_guard(problem, found.longest, guard)
        if stronger == guard:
            return low, max(found.high, low)
        guard = stronger


def find_scale(
    centreline: Centreline, segments: Segments, targets: Targets, settings: PgdSettings
) -> Generator[Iterate, None, float]:
    """Find the factor on the plan at which a profile with a typical swing has the wanted length.

    Raises
    ------
    TargetError
        If no profile keeps drop, limits and known elevations.
    """
    start = max(targets.length - targets.drop, 0.1 * targets.length) / centreline.length
    problem = laid_out(centreline, segments, targets, settings, start, Guard())
    found = yield from _with_scale(problem, settings, Tally())
    return found.scale


def _with_scale(problem: Problem, settings: PgdSettings, tally: Tally) -> Generator[Iterate, None, Problem]:
    """Find the factor on the plan at which the smoothest profile, with a typical swing, has the length."""
    swung = 0.5 * settings.typical_swing**2 if settings.meet_length else 0.0
    target = problem.targets.length / (1 + swung)
    for _ in range(_ROUNDS_OF_SCALE):
        project = Projection(problem.feasible_set)
        first = yield from smoothest_profile(problem, project, settings, tally)
        gradients = problem.gradients(first.v)
        length = problem.length_of(gradients)[0]
        if abs(length - target) <= LENGTH_TOLERANCE * target:
            break
        # Falls stay and plan lengths grow with the scale: d length / d scale = sum D cos / scale.
        flat = float((problem.piece_lengths / np.sqrt(1 + gradients**2)).sum())
        scale = problem.scale * (1 + (target - length) / flat)
        if not 0 < scale < math.inf:
            raise TargetError("no scale of this plan meets length and drop")
        problem = replace(problem, scale=scale)
    return problem


def _last(problem: Problem, result: Result, tally: Tally) -> Iterate:
    """Return the result as an iterate: of several ways the best was chosen, which need not be the last one tried."""
    gradients = problem.gradients(result.v)
    tally.iterates += 1
    return Iterate(
        number=tally.iterates - 1,
        stage="result",
        gradients=gradients,
        objective=result.objective,
        length=problem.length_of(gradients)[0],
        drop=problem.targets.drop,
        optimality=result.optimality,
        step=math.nan,
        scale=problem.scale,
        profile=problem.profile,
        edge_gradients=problem.edge_gradients,
    )


def _solution(problem: Problem, result: Result, settings: PgdSettings, tally: Tally) -> Solution:
    length = problem.length_of(problem.gradients(result.v))[0]
    short = length - problem.targets.length
    if result.met or not settings.meet_length:
        status, message = 0, "Converged: the optimality measure is within its tolerance."
    elif result.at_plausible_edge:
        status = 2
        message = (
            f"The length stays {-short:.3f} m short: to meet it, gradients would have to swing by more than"
            f" {100 * settings.plausible:.0f} % about the smoothest profile."
        )
    else:
        status = 2
        way = "long" if short > 0 else "short"
        message = f"Converged, but the length cannot be met: the nearest profile is {abs(short):.3f} m too {way}."
    return Solution(
        method="pgd",
        profile=problem.profile,
        gradients=problem.gradients(result.v),
        edge_gradients=problem.edge_gradients,
        scale=problem.scale,
        start_elevation=problem.targets.drop,
        status=status,
        message=message,
        nit=tally.iterates - 1,
        nfev=tally.nfev,
        njev=tally.nfev,
        objective=result.objective,
        optimality=result.optimality,
    )

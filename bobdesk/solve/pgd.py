"""The recommended method: projected gradient descent in two stages on the exact feasible set."""

from __future__ import annotations

import math
from collections.abc import Generator

import numpy as np

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.errors import TargetError
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.iterates import Iterate, Run, Solution
from bobdesk.solve.problem import Problem, make_problem
from bobdesk.solve.projection import Projection
from bobdesk.solve.stages import (
    LENGTH_TOLERANCE,
    PgdSettings,
    Reach,
    Result,
    Tally,
    reachable_lengths,
    smoothest_profile,
    solve_stages,
)
from bobdesk.solve.targets import Targets
from bobdesk.solve.tolerances import settled

_ROUNDS_OF_LOWEST = 12
_ROUNDS_OF_SCALE = 20
_BELOW = 1e-9


def pgd(centreline: Centreline, segments: Segments, targets: Targets, settings: PgdSettings | None = None) -> Run:
    """Reconstruct the gradients; a generator of iterates that returns the solution.

    Drop, limits, known elevations and a mean over the segments' gradients hold at every iterate.
    Stage one finds the smoothest profile, stage two the least change of elevation from it that
    meets the length. With an unknown scale the factor f on the plan meets the length instead.
    A profile that dips below the lowest point is held level at 0 there and solved again.

    Raises
    ------
    TargetError
        If limits, drop and known elevations contradict each other.
    """
    settings = settings or PgdSettings()
    tally = Tally()
    lowest: tuple[float, ...] = ()
    scale = 1.0
    while True:
        problem = _laid_out(centreline, segments, targets, settings, scale, lowest)
        if targets.unknown_scale:
            problem = yield from _with_scale(problem, settings, tally)
            scale = problem.scale
        result = yield from solve_stages(problem, settings, tally)
        held = _held_at_lowest(problem, result.v, lowest)
        if held == lowest:
            return _solution(problem, result, settings, tally)
        lowest = held


def reach(
    centreline: Centreline, segments: Segments, targets: Targets, settings: PgdSettings, *, scale: float
) -> Generator[Iterate, None, tuple[float, float]]:
    """Find the shortest and the longest plausible length that keep drop, limits and elevations, m.

    Raises
    ------
    TargetError
        If no profile keeps those.
    """
    lowest: tuple[float, ...] = ()
    low: float | None = None
    while True:
        problem = _laid_out(centreline, segments, targets, settings, scale, lowest)
        found: Reach = yield from reachable_lengths(problem, settings)
        low = found.low if low is None else low
        held = _held_at_lowest(problem, found.longest, lowest)
        if held == lowest:
            return low, max(found.high, low)
        lowest = held


def find_scale(
    centreline: Centreline, segments: Segments, targets: Targets, settings: PgdSettings
) -> Generator[Iterate, None, float]:
    """Find the factor on the plan at which the smoothest profile has the wanted length.

    Raises
    ------
    TargetError
        If no profile keeps drop, limits and known elevations.
    """
    start = max(targets.length - targets.drop, 0.1 * targets.length) / centreline.length
    problem = _laid_out(centreline, segments, targets, settings, start, ())
    found = yield from _with_scale(problem, settings, Tally())
    return found.scale


def _laid_out(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: PgdSettings,
    scale: float,
    lowest: tuple[float, ...],
) -> Problem:
    return make_problem(
        centreline,
        segments,
        targets,
        settled(anchors_of(targets, centreline.length, lowest), targets, scale=scale),
        transition=settings.transition,
        longest_piece=settings.longest_piece,
        scale=scale,
    )


def _held_at_lowest(problem: Problem, v: FloatArray, lowest: tuple[float, ...]) -> tuple[float, ...]:
    """Return the stations to be held at 0: those before, and where the profile dips deepest below."""
    dip = _deepest_dip(problem, problem.gradients(v))
    if dip is None or dip in lowest or len(lowest) >= _ROUNDS_OF_LOWEST:
        return lowest
    return (*lowest, dip)


def _with_scale(problem: Problem, settings: PgdSettings, tally: Tally) -> Generator[Iterate, None, Problem]:
    """Find the factor on the plan at which the smoothest profile has the wanted length."""
    target = problem.targets.length
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
        problem = Problem(problem.profile, problem.targets, problem.anchors, scale)
    return problem


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
        nit=tally.nit,
        nfev=tally.nfev,
        njev=tally.nfev,
        objective=result.objective,
        optimality=result.optimality,
    )

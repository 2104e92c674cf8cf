"""The recommended method: projected gradient descent in two stages on the exact feasible set."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator
from dataclasses import dataclass, replace
from functools import partial

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
    Result,
    Tally,
    longest_line,
    shortest_line,
    smoothest_profile,
    solve_stages,
)
from bobdesk.solve.targets import Targets

_ROUNDS_OF_SCALE = 20
_PASSES = 3
_SPIKE = 0.002


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
    scale = _first_scale(centreline, targets) if targets.unknown_scale else 1.0
    work = _Refining()
    while not work.done:
        lay_out = partial(laid_out, centreline, segments, targets, settings, guard=work.guard, through=work.through)
        if targets.unknown_scale:
            problem = yield from _with_scale(lay_out, scale, settings, tally)
            scale = problem.scale
        else:
            problem = lay_out(scale)
        result = yield from solve_stages(problem, settings, tally)
        if targets.unknown_scale and settings.typical_swing > 0 and not result.met:
            # The limits leave no room for the swing that tracks have: the smoothest profile it is.
            settings = replace(settings, typical_swing=0.0)
            continue
        work.look(problem, result.v)
    yield _last(problem, result, tally)
    return _solution(problem, result, settings, tally)


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


@dataclass(frozen=True)
class Reach:
    """The lengths that a plan can have under drop, limits and known elevations.

    Attributes
    ----------
    shortest, longest
        3D length, m; the longest is where gradients begin to swing implausibly.
    guarded
        True if one of the two lines had to be kept from dipping below the lowest point. What lies between them may
        dip elsewhere, so that a run need not meet each length.
    """

    shortest: float
    longest: float
    guarded: bool


def reach(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: PgdSettings,
    *,
    scale: float,
    end: float | None = None,
) -> Generator[Iterate, None, Reach]:
    """Find the shortest and the longest plausible length that keep drop, limits and elevations.

    Parameters
    ----------
    end
        Elevation that a free end is held at, m; None for the smoothest course, as a run has it.

    Raises
    ------
    TargetError
        If no profile keeps those.
    """
    found = []
    guarded = False
    for line in (shortest_line, longest_line):
        # Both go through what a run goes through; a guard against dips of the one would narrow the other.
        work = _Refining()
        while not work.done:
            problem = laid_out(
                centreline, segments, targets, settings, scale, guard=work.guard, through=work.through, end=end
            )
            v = yield from line(problem, settings)
            work.look(problem, v)
        found.append(problem.length_of(problem.gradients(v))[0])
        guarded |= work.guard != Guard()
    return Reach(found[0], max(found), guarded)


class _Refining:
    """What is learnt from one solution for the next: where it dips, and how it passes the known elevations."""

    def __init__(self) -> None:
        self.guard = Guard()
        self.through: FloatArray | None = None
        self.done = False
        self._passes = 0

    def look(self, problem: Problem, v: FloatArray) -> None:
        """Decide whether a solution, (p,), can stay."""
        stronger = stronger_guard(problem, v, self.guard)
        if stronger != self.guard:
            self.guard, self.through = stronger, None
            return
        smoother = _through_anchors(problem, problem.gradients(v))
        self._passes += 1
        apart = np.abs(smoother - problem.edge_gradients[: len(smoother)]).max(initial=0.0)
        self.done = bool(self._passes > _PASSES or apart < _SPIKE)
        self.through = smoother[problem.profile.held]


def find_scale(
    centreline: Centreline, segments: Segments, targets: Targets, settings: PgdSettings
) -> Generator[Iterate, None, float]:
    """Find the factor on the plan at which a profile with a typical swing has the wanted length.

    Raises
    ------
    TargetError
        If no profile keeps drop, limits and known elevations.
    """
    lay_out = partial(laid_out, centreline, segments, targets, settings, guard=Guard())
    found = yield from _with_scale(lay_out, _first_scale(centreline, targets), settings, Tally())
    return found.scale


def _first_scale(centreline: Centreline, targets: Targets) -> float:
    """Return the factor on the plan with which one even gradient would meet length and drop.

    Swings make the true one a little smaller. A smaller guess makes all stretches steeper than they are, and refuses
    what can be met.
    """
    return math.sqrt(targets.length**2 - targets.drop**2) / centreline.length


def _with_scale(
    lay_out: Callable[[float], Problem], scale: float, settings: PgdSettings, tally: Tally
) -> Generator[Iterate, None, Problem]:
    """Find the factor on the plan at which the smoothest profile, with a typical swing, has the length."""
    swung = 0.5 * settings.typical_swing**2 if settings.meet_length else 0.0
    problem = lay_out(scale)
    target = problem.targets.length / (1 + swung)
    for _ in range(_ROUNDS_OF_SCALE):
        try:
            project = Projection(problem.feasible_set)
        except TargetError:
            # At this scale a stretch is too steep for transitions; another layout leaves them out there.
            problem = lay_out(problem.scale)
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

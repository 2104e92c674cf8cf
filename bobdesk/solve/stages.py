"""The stages of the recommended method on one problem: smoothest, shortest, and lengthened profile."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from bobdesk.arrays import FloatArray
from bobdesk.solve.iterates import Iterate
from bobdesk.solve.problem import Problem
from bobdesk.solve.projection import Projection
from bobdesk.solve.settings import PgdSettings
from bobdesk.solve.smoothness import Smoothness, Swinging, Swings, smoothest_without_limits
from bobdesk.solve.spectral_gradient import Descent, DescentSettings, descend

_ROUNDS_OF_LENGTH = 30
_OVERSHOOT = 1.05
_BARELY_PLAUSIBLE = 1.02
_SWING_TOLERANCE = 1e-9
_STEPS_A_SIZE = 200
_LARGEST_SWING = 0.5
_CLEARLY = 0.95
LENGTH_TOLERANCE = 1e-8
_MET = 1e-6


@dataclass
class Tally:
    """Counts that run through all stages."""

    iterates: int = 0
    nfev: int = 0


@dataclass(frozen=True, eq=False)
class Result:
    """What the two stages of one problem end with: variables in v, and how they ended."""

    v: FloatArray
    smoothest: FloatArray
    objective: float
    optimality: float
    met: bool
    at_plausible_edge: bool


def solve_stages(
    problem: Problem, settings: PgdSettings, tally: Tally | None = None
) -> Generator[Iterate, None, Result]:
    """Run both stages on a problem whose scale is known."""
    tally = tally or Tally()
    project = Projection(problem.feasible_set)
    first = yield from smoothest_profile(problem, project, settings, tally)
    smoothest = problem.gradients(first.v)
    length = problem.length_of(smoothest)[0]
    target = problem.targets.length
    close = LENGTH_TOLERANCE * target
    if not settings.meet_length or abs(length - target) <= close:
        met = abs(length - target) <= _MET * target
        return Result(first.v, smoothest, first.objective, first.optimality, met, at_plausible_edge=False)
    if length > target:
        shortest = yield from _shortest(problem, project, first.v, settings, tally)
        v = _between(problem, shortest.v, first.v, target)
        met = abs(problem.length_of(problem.gradients(v))[0] - target) <= _MET * target
        return Result(v, smoothest, first.objective, first.optimality, met, at_plausible_edge=False)
    return (yield from _lengthened(problem, first, settings, tally, target))


def smoothest_profile(
    problem: Problem, project: Projection, settings: PgdSettings, tally: Tally
) -> Generator[Iterate, None, Descent]:
    """Stage one: the profile whose gradient changes least between neighbouring pieces."""
    descent = DescentSettings(settings.tolerance, settings.max_iterations)
    objective = Smoothness(problem)
    return (
        yield from report(
            problem,
            "smoothest profile",
            descend(objective, smoothest_without_limits(problem), project, descent),
            problem.gradients,
            tally,
        )
    )


def _shortest(
    problem: Problem, project: Projection, start: FloatArray, settings: PgdSettings, tally: Tally
) -> Generator[Iterate, None, Descent]:
    """Descend to the shortest line; the length is convex in the gradients."""

    def length(v: FloatArray) -> tuple[float, FloatArray]:
        value, derivative = problem.length_of(problem.gradients(v))
        return value, derivative / problem.roots

    descent = DescentSettings(1e-7, settings.max_iterations)
    return (
        yield from report(problem, "shortest line", descend(length, start, project, descent), problem.gradients, tally)
    )


def _between(problem: Problem, shorter: FloatArray, longer: FloatArray, target: float) -> FloatArray:
    """Return the profile between two, both feasible, that has the wanted length, or the shorter one."""

    def excess(share: float) -> float:
        return problem.length_of(problem.gradients(shorter + share * (longer - shorter)))[0] - target

    if excess(0.0) >= 0:
        return shorter
    share = float(brentq(excess, 0.0, 1.0, xtol=1e-14))
    return shorter + share * (longer - shorter)


def _lengthened(
    problem: Problem, first: Descent, settings: PgdSettings, tally: Tally, target: float
) -> Generator[Iterate, None, Result]:
    """Let the gradient swing about the smoothest profile until the length is met; both ways round, the better one."""
    smoothest = problem.gradients(first.v)
    swings = Swings(problem, smoothest, settings.longest_swing)
    best: tuple[float, Descent] | None = None
    for turn in (swings.pattern(), -swings.pattern()):
        objective = Swinging(problem, swings, turn, settings.evenness)
        last = yield from _swung(problem, swings, objective, turn, settings, tally, target)
        missed = max(0.0, abs(_excess(problem, swings, last.v, target)) - _MET * target)
        rank = objective.change(last.v) + 1e6 * missed
        # The second way must be clearly better, so that rounding does not choose between equals.
        if best is None or rank < _CLEARLY * best[0]:
            best = (rank, last)
    assert best is not None
    last = best[1]
    v = swings.gradients(last.v) * problem.roots
    swing = swing_of(problem, v, smoothest)
    met = abs(_excess(problem, swings, last.v, target)) <= _MET * target
    if swing <= _BARELY_PLAUSIBLE * settings.plausible:
        return Result(v, smoothest, last.objective, last.optimality, met, at_plausible_edge=False)
    # The feasible set is convex: a point between the two profiles keeps all that both keep.
    v = first.v + settings.plausible / swing * (v - first.v)
    return Result(v, smoothest, last.objective, last.optimality, met=False, at_plausible_edge=True)


def _excess(problem: Problem, swings: Swings, at: FloatArray, target: float) -> float:
    return problem.length_of(swings.gradients(at))[0] - target


def _swung(
    problem: Problem,
    swings: Swings,
    objective: Swinging,
    turn: FloatArray,
    settings: PgdSettings,
    tally: Tally,
    target: float,
) -> Generator[Iterate, None, Descent]:
    """Find the size of the swings that meets the length: bracket it, then regula falsi (Illinois)."""
    project = Projection(swings.feasible_set)
    close = LENGTH_TOLERANCE * target
    unlimited = objective.start(turn)
    descent = DescentSettings(_SWING_TOLERANCE, min(settings.max_iterations, _STEPS_A_SIZE))
    last: Descent | None = None

    def of_size(size: float) -> Generator[Iterate, None, Descent]:
        before, objective.size = objective.size, size
        starts = [project(size * unlimited)]
        if last is not None:
            starts.append(project(size / before * last.v))
        start = min(starts, key=lambda v: objective(v)[0])
        return (
            yield from report(problem, "length", descend(objective, start, project, descent), swings.gradients, tally)
        )

    lower, lower_excess = 0.0, _excess(problem, swings, np.zeros_like(turn), target)
    # To second order a swing of root mean square r lengthens the line by r²/2.
    upper = math.sqrt(2 * max(-lower_excess, 0.0) / float(problem.piece_lengths.sum()))
    while True:
        last = yield from of_size(upper)
        upper_excess = _excess(problem, swings, last.v, target)
        if upper_excess >= -close or upper > _LARGEST_SWING:
            break
        lower, lower_excess, upper = upper, upper_excess, 1.3 * upper
    side = 0
    for _ in range(_ROUNDS_OF_LENGTH):
        if abs(upper_excess) <= close or upper_excess < 0:
            break
        middle = upper - upper_excess * (upper - lower) / (upper_excess - lower_excess)
        last = yield from of_size(middle)
        excess = _excess(problem, swings, last.v, target)
        if abs(excess) <= close:
            break
        if excess > 0:
            lower_excess, side = (0.5 * lower_excess if side > 0 else lower_excess), 1
            upper, upper_excess = middle, excess
        else:
            upper_excess, side = (0.5 * upper_excess if side < 0 else upper_excess), -1
            lower, lower_excess = middle, excess
    return last


def shortest_line(problem: Problem, settings: PgdSettings) -> Generator[Iterate, None, FloatArray]:
    """Find the shortest line of the feasible set; return it in the solvers' variables, (p,)."""
    tally = Tally()
    project = Projection(problem.feasible_set)
    first = yield from smoothest_profile(problem, project, settings, tally)
    return (yield from _shortest(problem, project, first.v, settings, tally)).v


def longest_line(problem: Problem, settings: PgdSettings) -> Generator[Iterate, None, FloatArray]:
    """Find the longest plausible line of the feasible set; return it in the solvers' variables, (p,)."""
    tally = Tally()
    first = yield from smoothest_profile(problem, Projection(problem.feasible_set), settings, tally)
    smooth = problem.length_of(problem.gradients(first.v))[0]
    # To second order a swing of root mean square r lengthens the line by r²/2.
    swung = 0.5 * settings.plausible**2 * float(problem.piece_lengths.sum())
    longest = yield from _lengthened(problem, first, settings, tally, smooth + _OVERSHOOT * swung)
    high = problem.length_of(problem.gradients(longest.v))[0]
    return first.v if high < smooth else longest.v


def swing_of(problem: Problem, v: FloatArray, smoothest: FloatArray) -> float:
    """Return the root mean square of the change of gradient from the smoothest profile."""
    lengths = problem.piece_lengths
    return math.sqrt(float(lengths @ (problem.gradients(v) - smoothest) ** 2) / float(lengths.sum()))


def report(
    problem: Problem,
    stage: str,
    descent: Generator[Descent, None, Descent],
    gradients_of: Callable[[FloatArray], FloatArray],
    tally: Tally,
) -> Generator[Iterate, None, Descent]:
    """Turn each step of a descent into an iterate, and count."""
    while True:
        try:
            at = next(descent)
        except StopIteration as end:
            last: Descent = end.value
            tally.nfev += last.evaluations
            return last
        gradients = gradients_of(at.v)
        yield Iterate(
            number=tally.iterates,
            stage=stage,
            gradients=gradients,
            objective=at.objective,
            length=problem.length_of(gradients)[0],
            drop=problem.targets.drop,
            optimality=at.optimality,
            step=at.step,
            scale=problem.scale,
            profile=problem.profile,
            edge_gradients=problem.edge_gradients,
        )
        tally.iterates += 1

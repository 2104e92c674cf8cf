"""The recommended method: projected gradient descent in two stages on the exact feasible set."""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.errors import TargetError
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.iterates import Iterate, Run, Solution
from bobdesk.solve.problem import Problem, make_problem
from bobdesk.solve.projection import Projection
from bobdesk.solve.smoothness import ChangeToLength, Smoothness, smoothest_without_limits
from bobdesk.solve.spectral_gradient import Descent, DescentSettings, descend
from bobdesk.solve.targets import Targets

_ROUNDS_OF_LENGTH = 30
_ROUNDS_OF_LOWEST = 12
_ROUNDS_OF_SCALE = 20
_FIRST_SWING = 0.03
_LENGTH_TOLERANCE = 1e-8
_MET = 1e-6
_BELOW = 1e-9


@dataclass(frozen=True)
class PgdSettings:
    """What the user can set of the recommended method.

    Attributes
    ----------
    meet_length
        Meet the length (stage two), or leave the smoothest profile.
    spread
        Weight of the fourth power in stage two, m²: larger spreads the change more evenly.
    plausible
        Largest root mean square of the change of gradient in stage two. A length that asks for
        more is met only as far as that.
    transition
        Length of the vertical transitions at gradient breaks, m; 0 for kinks.
    longest_piece
        Longer segments are divided into equal pieces, m: an even gradient over 100 m and more is
        not what tracks have. (At most some 300 divisions a line.)
    tolerance
        On the optimality measure in stage one.
    max_iterations
        Of each descent.
    """

    meet_length: bool = True
    spread: float = 1e6
    plausible: float = 0.06
    transition: float = 8.0
    longest_piece: float = 40.0
    tolerance: float = 1e-8
    max_iterations: int = 5000


@dataclass
class _Tally:
    """Counts that run through all stages."""

    nit: int = 0
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
    tally = _Tally()
    lowest: tuple[float, ...] = ()
    scale = 1.0
    for _ in range(_ROUNDS_OF_LOWEST):
        anchors = anchors_of(targets, centreline.length, lowest)
        problem = make_problem(
            centreline,
            segments,
            targets,
            anchors,
            transition=settings.transition,
            longest_piece=settings.longest_piece,
            scale=scale,
        )
        if targets.unknown_scale:
            problem = yield from _with_scale(problem, settings, tally)
            scale = problem.scale
        result = yield from solve_stages(problem, settings, tally)
        dip = _deepest_dip(problem, problem.gradients(result.v))
        if dip is None or dip in lowest:
            break
        lowest = (*lowest, dip)
    return _solution(problem, result, settings, tally)


def solve_stages(
    problem: Problem, settings: PgdSettings, tally: _Tally | None = None
) -> Generator[Iterate, None, Result]:
    """Run both stages on a problem whose scale is known."""
    tally = tally or _Tally()
    project = Projection(problem.feasible_set)
    first = yield from _smoothest(problem, project, settings, tally)
    smoothest = problem.gradients(first.v)
    length = problem.length_of(smoothest)[0]
    target = problem.targets.length
    close = _LENGTH_TOLERANCE * target
    if not settings.meet_length or abs(length - target) <= close:
        met = abs(length - target) <= _MET * target
        return Result(first.v, smoothest, first.objective, first.optimality, met, at_plausible_edge=False)
    if length > target:
        shortest = yield from _shortest(problem, project, first.v, settings, tally)
        v = _between(problem, shortest.v, first.v, target)
        met = abs(problem.length_of(problem.gradients(v))[0] - target) <= _MET * target
        return Result(v, smoothest, first.objective, first.optimality, met, at_plausible_edge=False)
    return (yield from _lengthened(problem, project, first, settings, tally, target))


def _smoothest(
    problem: Problem, project: Projection, settings: PgdSettings, tally: _Tally
) -> Generator[Iterate, None, Descent]:
    descent = DescentSettings(settings.tolerance, settings.max_iterations)
    objective = Smoothness(problem)
    return (
        yield from _report(
            problem, "smoothest profile", descend(objective, smoothest_without_limits(problem), project, descent), tally
        )
    )


def _shortest(
    problem: Problem, project: Projection, start: FloatArray, settings: PgdSettings, tally: _Tally
) -> Generator[Iterate, None, Descent]:
    """Descend to the shortest line; the length is convex in the gradients."""

    def length(v: FloatArray) -> tuple[float, FloatArray]:
        value, derivative = problem.length_of(problem.gradients(v))
        return value, derivative / problem.roots

    descent = DescentSettings(1e-7, settings.max_iterations)
    return (yield from _report(problem, "shortest line", descend(length, start, project, descent), tally))


def _between(problem: Problem, shorter: FloatArray, longer: FloatArray, target: float) -> FloatArray:
    """Return the profile between two, both feasible, that has the wanted length, or the shorter one."""

    def excess(share: float) -> float:
        return problem.length_of(problem.gradients(shorter + share * (longer - shorter)))[0] - target

    if excess(0.0) >= 0:
        return shorter
    share = float(brentq(excess, 0.0, 1.0, xtol=1e-14))
    return shorter + share * (longer - shorter)


def _lengthened(
    problem: Problem,
    project: Projection,
    first: Descent,
    settings: PgdSettings,
    tally: _Tally,
    target: float,
) -> Generator[Iterate, None, Result]:
    """Change the smoothest profile as little as meets the length; both ways round, the better one."""
    smoothest = problem.gradients(first.v)
    pieces = len(smoothest)
    best: tuple[float, Descent, float] | None = None
    for sign in (1.0, -1.0):
        objective = ChangeToLength(problem, smoothest, settings.spread, target)
        start = first.v.copy()
        start[:pieces] += sign * _FIRST_SWING * (-1.0) ** np.arange(pieces) * problem.roots
        last = yield from _meet(problem, project, objective, start, settings, tally, target)
        excess = objective.excess(last.v)
        rank = objective.change(last.v) + 1e3 * max(0.0, abs(excess) - _MET * target)
        if best is None or rank < best[0]:
            best = (rank, last, excess)
    assert best is not None
    _, last, excess = best
    swing = swing_of(problem, last.v, smoothest)
    met = abs(excess) <= _MET * target
    if swing <= settings.plausible:
        return Result(last.v, smoothest, last.objective, last.optimality, met, at_plausible_edge=False)
    # The feasible set is convex: a point between the two profiles keeps all that both keep.
    v = first.v + settings.plausible / swing * (last.v - first.v)
    return Result(v, smoothest, last.objective, last.optimality, met=False, at_plausible_edge=True)


def _meet(
    problem: Problem,
    project: Projection,
    objective: ChangeToLength,
    start: FloatArray,
    settings: PgdSettings,
    tally: _Tally,
    target: float,
) -> Generator[Iterate, None, Descent]:
    """Augmented Lagrangian: descend, move the multiplier by the excess, until the length is met."""
    tolerance, before = 1e-2, math.inf
    last: Descent | None = None
    for _ in range(_ROUNDS_OF_LENGTH):
        descent = DescentSettings(tolerance, settings.max_iterations)
        steps = descend(objective, start if last is None else last.v, project, descent)
        last = yield from _report(problem, "length", steps, tally)
        excess = objective.excess(last.v)
        objective.multiplier += objective.penalty * excess
        if abs(excess) <= _LENGTH_TOLERANCE * target and tolerance <= 1e-4:
            break
        if abs(excess) > 0.25 * before:
            objective.penalty = min(5 * objective.penalty, 1e6)
        before = abs(excess)
        tolerance = max(0.1 * tolerance, 1e-5)
    assert last is not None
    return last


def swing_of(problem: Problem, v: FloatArray, smoothest: FloatArray) -> float:
    """Return the root mean square of the change of gradient from the smoothest profile."""
    lengths = problem.piece_lengths
    return math.sqrt(float(lengths @ (problem.gradients(v) - smoothest) ** 2) / float(lengths.sum()))


def _with_scale(problem: Problem, settings: PgdSettings, tally: _Tally) -> Generator[Iterate, None, Problem]:
    """Find the factor on the plan at which the smoothest profile has the wanted length."""
    target = problem.targets.length
    for _ in range(_ROUNDS_OF_SCALE):
        project = Projection(problem.feasible_set)
        first = yield from _smoothest(problem, project, settings, tally)
        gradients = problem.gradients(first.v)
        length = problem.length_of(gradients)[0]
        if abs(length - target) <= _LENGTH_TOLERANCE * target:
            break
        # Falls stay and plan lengths grow with the scale: d length / d scale = sum D cos / scale.
        flat = float((problem.piece_lengths / np.sqrt(1 + gradients**2)).sum())
        scale = problem.scale * (1 + (target - length) / flat)
        if not 0 < scale < math.inf:
            raise TargetError("no scale of this plan meets length and drop")
        problem = Problem(problem.profile, problem.targets, problem.anchors, scale)
    return problem


def _report(
    problem: Problem, stage: str, descent: Generator[Descent, None, Descent], tally: _Tally
) -> Generator[Iterate, None, Descent]:
    """Turn each step of a descent into an iterate, and count."""
    while True:
        try:
            at = next(descent)
        except StopIteration as end:
            last: Descent = end.value
            tally.nfev += last.evaluations
            return last
        gradients = problem.gradients(at.v)
        yield Iterate(
            number=tally.nit,
            stage=stage,
            gradients=gradients,
            objective=at.objective,
            length=problem.length_of(gradients)[0],
            drop=problem.targets.drop,
            optimality=at.optimality,
            step=at.step,
            scale=problem.scale,
        )
        tally.nit += 1


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


def _solution(problem: Problem, result: Result, settings: PgdSettings, tally: _Tally) -> Solution:
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

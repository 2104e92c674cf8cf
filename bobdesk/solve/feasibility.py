"""Before a run: can length, drop, limits and known elevations be met together, and what to doubt."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace

import numpy as np

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.errors import TargetError
from bobdesk.progress import finish
from bobdesk.sentences import as_sentence
from bobdesk.solve.anchors import anchors_of, last_before_a_free_end
from bobdesk.solve.envelope import cone_of
from bobdesk.solve.iterates import Iterate
from bobdesk.solve.pgd import find_scale, pgd, reach
from bobdesk.solve.settings import PgdSettings
from bobdesk.solve.targets import Targets, check_targets
from bobdesk.solve.tolerances import room_of_free_end

_SAME_FIGURE = 0.02
_DIGITISING = 1e-3
_WORTH_SAYING = 0.05
_CLOSE_TO_AN_END = 0.2


@dataclass(frozen=True)
class Feasibility:
    """Whether the targets can be met together with this plan.

    Attributes
    ----------
    feasible
        True if a run meets all.
    sentence
        What a person should know, with numbers.
    reachable_length
        Shortest and longest 3D length of this plan under drop, limits and known elevations, m; the
        longest is where gradients begin to swing implausibly. None if no profile meets those.
    scale
        The factor on the plan at which a typical profile has the wanted length, or None.
    plan_length
        Length in plan, m.
    doubt
        The part of the sentence about a mean gradient that does not follow from the other figures,
        or "".
    open_end
        The part of the sentence about an end of which nothing is known, or "".
    """

    feasible: bool
    sentence: str
    reachable_length: tuple[float, float] | None
    scale: float | None
    plan_length: float
    doubt: str = ""
    open_end: str = ""


def feasibility(
    centreline: Centreline, segments: Segments, targets: Targets, settings: PgdSettings | None = None
) -> Feasibility:
    """Find out whether a run meets the targets together; takes about as long as one or two runs.

    Raises
    ------
    InputError
        If a figure is unusable by itself.
    """
    check_targets(targets)
    settings = settings or PgdSettings()
    plan = centreline.length
    scale = 1.0
    agreeing = _scale_that_agrees(centreline, segments, targets, settings)
    if targets.unknown_scale:
        if agreeing is None:
            return Feasibility(False, _without_scale(centreline, segments, targets, settings), None, None, plan)
        scale = agreeing
    try:
        shortest, longest, ends_at = _reachable(centreline, segments, targets, settings, scale)
    except TargetError as error:
        return Feasibility(False, as_sentence(str(error)), None, agreeing, plan)
    within = bool(shortest * (1 - 1e-7) <= targets.length <= longest * (1 + 1e-7))
    feasible = (within and ends_at is None) or targets.unknown_scale
    end = _about_the_end(targets, plan, scale)
    if targets.unknown_scale:
        sentence = (
            f"With a scale factor of {scale:.4f} on the plan all figures can be met: it is then"
            f" {scale * plan:.2f} m long in plan."
        )
    elif ends_at is not None:
        sentence = _missed(targets, shortest, longest, ends_at)
    elif within:
        sentence = (
            "These figures can all be met: with this plan the length can lie between"
            f" {shortest:.2f} m and {longest:.2f} m."
        )
    elif targets.length < shortest:
        sentence = _too_short(targets, plan, shortest, agreeing)
    else:
        higher = _longest_with_a_climb(centreline, segments, targets, settings)
        sentence = _too_long(targets, settings, longest, agreeing, higher)
    doubt = _about_mean_gradient(targets, scale * plan)
    sentence += doubt + end
    return Feasibility(feasible, sentence, (shortest, longest), agreeing, plan, doubt.strip(), end.strip())


def _reachable(
    centreline: Centreline, segments: Segments, targets: Targets, settings: PgdSettings, scale: float
) -> tuple[float, float, float | None]:
    """Return the shortest and the longest length, m, and where a run ends that misses a length between them, or None.

    Close to their ends, and where dips below the lowest point have to be avoided, the run itself is asked.
    """
    found = finish(reach(centreline, segments, targets, settings, scale=scale))
    shortest, longest = found.shortest, found.longest
    margin = _CLOSE_TO_AN_END * (longest - shortest)
    from_an_end = min(abs(targets.length - shortest), abs(targets.length - longest))
    between = shortest < targets.length < longest
    if targets.unknown_scale or not (from_an_end < margin or (found.guarded and between)):
        return shortest, longest, None
    iterates: deque[Iterate] = deque(maxlen=1)
    solution = finish(pgd(centreline, segments, targets, settings), iterates.append)
    ends_at = targets.length if solution.status == 0 else iterates[-1].length
    missed = between and solution.status != 0
    return min(shortest, ends_at), max(longest, ends_at), ends_at if missed else None


def _scale_that_agrees(
    centreline: Centreline, segments: Segments, targets: Targets, settings: PgdSettings
) -> float | None:
    try:
        return float(finish(find_scale(centreline, segments, replace(targets, unknown_scale=True), settings)))
    except TargetError:
        return None


def _without_scale(centreline: Centreline, segments: Segments, targets: Targets, settings: PgdSettings) -> str:
    """Say why no scale could be found."""
    try:
        finish(find_scale(centreline, segments, targets, settings))
    except TargetError as error:
        return as_sentence(str(error))
    return "No scale of this plan meets length and drop."


def _too_short(targets: Targets, plan: float, shortest: float, scale: float | None) -> str:
    over = shortest - targets.length
    small = " That is less than digitising a plan is often off by." if over < _DIGITISING * plan else ""
    held = f"with a drop of {targets.drop:.2f} m" + (" and the known elevations" if targets.known else "")
    return (
        f"No 3D line of this plan is as short as {targets.length:.2f} m: {held} the shortest is {shortest:.2f} m,"
        f" {over:.2f} m ({100 * over / targets.length:.2f} %) more, since the plan alone is {plan:.2f} m long."
        f" Doubt the length, which may be measured in plan or be rounded, {_or_scale(scale)}.{small}"
    )


def _missed(targets: Targets, shortest: float, longest: float, ends_at: float) -> str:
    """Say that a run does not find what may well exist."""
    off = abs(ends_at - targets.length)
    way = "more" if ends_at > targets.length else "less"
    return (
        f"Lines of this plan can be {shortest:.2f} m to {longest:.2f} m long, but none of {targets.length:.2f} m was"
        " found that swings plausibly, keeps the known elevations and lies nowhere below the lowest point: a run ends"
        f" at {ends_at:.2f} m, {off:.2f} m ({100 * off / targets.length:.2f} %) {way}. Doubt the length, or the"
        " elevations known around the lowest point."
    )


def _longest_with_a_climb(
    centreline: Centreline, segments: Segments, targets: Targets, settings: PgdSettings
) -> tuple[float, float] | None:
    """Return the steepest end that a free one may have and the longest plausible length with it, m."""
    room = room_of_free_end(targets, centreline.length)
    if room is None:
        return None
    try:
        longest = finish(reach(centreline, segments, targets, settings, scale=1.0, end=room[1])).longest
    except TargetError:
        return None
    return room[1], longest


def _too_long(
    targets: Targets,
    settings: PgdSettings,
    longest: float,
    scale: float | None,
    higher: tuple[float, float] | None,
) -> str:
    under = targets.length - longest
    climb = ""
    if higher is not None and higher[1] > longest:
        climb = (
            f" That is with the smoothest course to the end, whose elevation is not known; with a climb to"
            f" {higher[0]:.1f} m there the longest is {higher[1]:.2f} m."
        )
    return (
        f"No plausible 3D line of this plan is as long as {targets.length:.2f} m: within the limits, and with"
        f" gradients that swing by at most {100 * settings.plausible:g} % about the smoothest profile, the longest"
        f" is {longest:.2f} m, {under:.2f} m ({100 * under / targets.length:.2f} %) less.{climb}"
        f" Doubt the length, which may count a start or braking stretch that the plan leaves out, {_or_scale(scale)}."
    )


def _or_scale(scale: float | None) -> str:
    if scale is None:
        return "or the drop"
    return f"or the plan's scale, which a factor of {scale:.4f} would make agree"


def _about_the_end(targets: Targets, plan: float, scale: float) -> str:
    """Say how high the end may lie if the lowest point is known to come before it, and nothing of the end."""
    anchors = anchors_of(targets, plan)
    lowest = last_before_a_free_end(anchors)
    if lowest is None:
        return ""
    highest = float(cone_of(np.array([scale * plan]), anchors, targets, scale=scale)[1][0])
    if highest < _WORTH_SAYING:
        return ""
    return (
        f" Nothing is known of the elevation of the end: behind the lowest point at {lowest.station:g} m the track may"
        f" climb to {highest:.1f} m there. The result takes the smoothest course; a known elevation at the end"
        " would tell."
    )


def _about_mean_gradient(targets: Targets, plan: float) -> str:
    """Compare a mean gradient that follows from other figures with what follows."""
    if targets.mean_gradient is None or targets.mean_gradient_is == "segments":
        return ""
    by_length = targets.mean_gradient_is == "drop-per-length"
    follows = targets.drop / (targets.length if by_length else plan)
    if abs(targets.mean_gradient / follows - 1) <= _SAME_FIGURE:
        return ""
    what = "drop / length" if by_length else "drop / plan length"
    return (
        f" The mean gradient of {100 * targets.mean_gradient:.2f} % does not follow from the other figures:"
        f" {what} is {100 * follows:.2f} %; one of the three is wrong, or it is defined otherwise."
    )

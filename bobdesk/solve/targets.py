"""What is known of a track: the figures the result must meet, limits and known elevations."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal, get_args

from bobdesk.errors import InputError

MeanGradientDefinition = Literal["drop-per-length", "drop-per-plan", "segments"]
DEFINITIONS: tuple[MeanGradientDefinition, ...] = get_args(MeanGradientDefinition)
LOWEST_GRADIENT, HIGHEST_GRADIENT = -0.2, 0.25
STEEPEST_GRADIENT = 2.0
_LONGEST, _SHORTEST = 1e6, 1.0


@dataclass(frozen=True)
class KnownElevation:
    """An elevation that is known at a station.

    Attributes
    ----------
    station
        Along the plan line, m; with an unknown scale it counts in the drawing, before scaling.
    elevation
        Above the lowest point, m.
    tolerance
        How far the result may lie from it, m; 0 holds it exactly. Infinite (as an anchor, never as what a user
        knows) if nothing is known.
    """

    station: float
    elevation: float
    tolerance: float = 0.0


@dataclass(frozen=True)
class Targets:
    """The figures a result must meet.

    Attributes
    ----------
    length
        3D length, m.
    drop
        Height difference between start and lowest point, m.
    mean_gradient
        Mean gradient, downhill positive, or None if it is not known.
    mean_gradient_is
        Which of the three definitions in use it follows: drop / 3D length, drop / plan length (both
        follow from length and drop and are a check), or the mean of the segments' gradients (the
        paper's; it is a target of its own).
    min_gradient, max_gradient
        Limits of the gradient, downhill positive.
    known
        Known elevations.
    unknown_scale
        The plan's scale is not known; the factor f is solved for.
    """

    length: float
    drop: float
    mean_gradient: float | None = None
    mean_gradient_is: MeanGradientDefinition = "drop-per-length"
    min_gradient: float = LOWEST_GRADIENT
    max_gradient: float = HIGHEST_GRADIENT
    known: tuple[KnownElevation, ...] = ()
    unknown_scale: bool = False

    @property
    def segments_mean(self) -> float | None:
        """The mean of the segments' gradients, where that is what the target means."""
        return self.mean_gradient if self.mean_gradient_is == "segments" else None


def check_targets(targets: Targets) -> Targets:
    """Return the targets if each is a usable number by itself.

    Raises
    ------
    InputError
        Otherwise; the sentence names the figure.
    """
    if not (math.isfinite(targets.length) and _SHORTEST <= targets.length <= _LONGEST):
        raise InputError(f"the length must lie between 1 m and 1,000 km, not {targets.length:g} m")
    if not (math.isfinite(targets.drop) and 0 < targets.drop < targets.length):
        raise InputError(f"the drop must be more than 0 m and less than the length, not {targets.drop:g} m")
    for name, gradient in (("smallest", targets.min_gradient), ("largest", targets.max_gradient)):
        if not abs(gradient) <= STEEPEST_GRADIENT:
            raise InputError(
                f"the {name} gradient must lie between -2 and 2 (0.1 is 10 %, downhill positive), not {gradient:g}"
            )
    if targets.min_gradient >= targets.max_gradient:
        raise InputError(
            f"the smallest gradient, {targets.min_gradient:g}, must be less than the largest, {targets.max_gradient:g}"
        )
    if targets.mean_gradient is not None:
        if not abs(targets.mean_gradient) <= STEEPEST_GRADIENT:
            raise InputError(
                f"the mean gradient must lie between -2 and 2 (0.1 is 10 %), not {targets.mean_gradient:g}"
            )
        check_mean_gradient(targets.mean_gradient, targets.mean_gradient_is)
    for known in targets.known:
        if not (math.isfinite(known.station) and math.isfinite(known.elevation)):
            raise InputError("a known elevation must be two finite numbers, STATION:ELEVATION")
        if not (math.isfinite(known.tolerance) and known.tolerance >= 0):
            raise InputError(f"the tolerance of the elevation at {known.station:g} m must be 0 or more")
    return targets


def check_mean_gradient(mean: float, mean_is: MeanGradientDefinition) -> None:
    """Refuse a mean gradient that no track can have which goes down from its start.

    The mean of the segments' gradients may be 0 or less: short steep climbs count as much in it as long descents.

    Raises
    ------
    InputError
        If it is the drop divided by a length, and not more than 0.
    """
    if mean_is != "segments" and not mean > 0:
        by = "length" if mean_is == "drop-per-length" else "length in plan"
        raise InputError(f"the mean gradient is the drop divided by the {by}, so it must be more than 0")


def in_scale(targets: Targets, factor: float) -> Targets:
    """Return the targets with the known elevations' stations multiplied by a plan's scale factor."""
    known = tuple(replace(item, station=item.station * factor) for item in targets.known)
    return replace(targets, known=known)

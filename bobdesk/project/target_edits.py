"""What a user does to targets, limits and known elevations."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import asdict, replace

from bobdesk.errors import InputError
from bobdesk.project.project import Project, TargetSet
from bobdesk.solve.settings import SolverSettings
from bobdesk.solve.targets import STEEPEST_GRADIENT, KnownElevation, MeanGradientDefinition, check_mean_gradient

STEEPEST_CHANGE, LARGEST_PLAN_ERROR = 1.0, 0.5


def set_length(project: Project, length: float | None) -> Project:
    """Give the 3D length of the set in force, m; None says that it is not known."""
    return _with_targets(project, replace(project.targets, length=_positive(length, "the length")))


def set_drop(project: Project, drop: float | None) -> Project:
    """Give the height difference of the set in force, m; None says that it is not known."""
    return _with_targets(project, replace(project.targets, drop=_positive(drop, "the drop")))


def set_mean_gradient(
    project: Project, mean: float | None, mean_is: MeanGradientDefinition = "drop-per-length"
) -> Project:
    """Give the mean gradient, downhill positive, and what it is a mean of; None says that it is not known."""
    value = None if mean is None else _mean_gradient(mean, mean_is)
    return _with_targets(project, replace(project.targets, mean_gradient=value, mean_gradient_is=mean_is))


def add_target_set(project: Project, targets: TargetSet) -> Project:
    """Add a start-house variant, and put it in force."""
    _check_name(project, targets.name)
    _positive(targets.length, "the length")
    _positive(targets.drop, "the drop")
    if targets.mean_gradient is not None:
        _mean_gradient(targets.mean_gradient, targets.mean_gradient_is)
    return replace(project, target_sets=(*project.target_sets, targets), chosen_targets=len(project.target_sets))


def choose_target_set(project: Project, index: int) -> Project:
    """Put another set in force."""
    _check_set(project, index)
    return replace(project, chosen_targets=index)


def name_target_set(project: Project, name: str) -> Project:
    """Rename the set in force."""
    name = name.strip()
    if name == project.targets.name:
        return project
    _check_name(project, name)
    return _with_targets(project, replace(project.targets, name=name))


def remove_target_set(project: Project, index: int) -> Project:
    """Take a set away; one always stays."""
    _check_set(project, index)
    if len(project.target_sets) == 1:
        raise InputError("one set of targets must stay")
    left = (*project.target_sets[:index], *project.target_sets[index + 1 :])
    chosen = project.chosen_targets - (project.chosen_targets > index)
    return replace(project, target_sets=left, chosen_targets=min(chosen, len(left) - 1))


def set_limits(project: Project, min_gradient: float, max_gradient: float) -> Project:
    """Set the limits of the gradient, downhill positive."""
    low, high = _gradient(min_gradient, "the smallest gradient"), _gradient(max_gradient, "the largest gradient")
    if low >= high:
        raise InputError(f"the smallest gradient, {low:g}, must be less than the largest, {high:g}")
    return replace(project, limits=replace(project.limits, min_gradient=low, max_gradient=high))


def set_gradient_change(project: Project, change: float | None) -> Project:
    """Give the largest change of the gradient per metre, 1/m, for the band; None for no limit."""
    if change is not None and not 0 < change <= STEEPEST_CHANGE:
        raise InputError(
            f"the largest change of the gradient must be more than 0 and at most {STEEPEST_CHANGE:g} per metre,"
            f" not {change:g}"
        )
    return replace(project, limits=replace(project.limits, gradient_change=change))


def set_plan_error(project: Project, share: float | None) -> Project:
    """Say how sure the plan's scale is: 1 sigma as a share; None for what the calibration says."""
    if share is not None and not 0 <= share <= LARGEST_PLAN_ERROR:
        raise InputError(
            f"the error of the plan's scale must lie between 0 and {100 * LARGEST_PLAN_ERROR:g} %,"
            f" not {100 * share:g} %"
        )
    return replace(project, plan_error=share)


def add_known_elevation(project: Project, known: KnownElevation) -> Project:
    """Add an elevation that is known at a station; they are kept in running order."""
    return set_known_elevations(project, (*project.known_elevations, known))


def change_known_elevation(project: Project, index: int, known: KnownElevation) -> Project:
    """Drag a known elevation, or correct it."""
    return set_known_elevations(project, (*_known_without(project, index), known))


def remove_known_elevation(project: Project, index: int) -> Project:
    """Take a known elevation away."""
    return replace(project, known_elevations=_known_without(project, index))


def set_known_elevations(project: Project, known: Iterable[KnownElevation]) -> Project:
    """Take all known elevations from a file in the place of those there are."""
    checked = [_known(item) for item in known]
    return replace(project, known_elevations=tuple(sorted(checked, key=lambda item: item.station)))


def set_solver(project: Project, settings: SolverSettings) -> Project:
    """Choose method, and what can be set of it."""
    numbers = (*asdict(settings.pgd).values(), *asdict(settings.weights).values(), settings.rate or 1.0)
    if not all(math.isfinite(number) for number in (*numbers, settings.threshold)):
        raise InputError("a setting of the solver is no number")
    return replace(project, solver=settings)


def _with_targets(project: Project, targets: TargetSet) -> Project:
    if targets == project.targets:
        return project
    at = project.chosen_targets
    return replace(project, target_sets=(*project.target_sets[:at], targets, *project.target_sets[at + 1 :]))


def _check_name(project: Project, name: str) -> None:
    if not name.strip():
        raise InputError("a set of targets needs a name")
    if any(name == other.name for other in project.target_sets):
        raise InputError(f"there is a set of targets named {name} already")


def _check_set(project: Project, index: int) -> None:
    if not 0 <= index < len(project.target_sets):
        raise InputError(f"there is no set of targets {index + 1}")


def _known_without(project: Project, index: int) -> tuple[KnownElevation, ...]:
    known = project.known_elevations
    if not 0 <= index < len(known):
        raise InputError(f"there is no known elevation {index + 1}")
    return (*known[:index], *known[index + 1 :])


def _known(item: KnownElevation) -> KnownElevation:
    numbers = (item.station, item.elevation, item.tolerance)
    if not all(math.isfinite(number) for number in numbers) or item.tolerance < 0:
        raise InputError("a known elevation is a station, an elevation and a tolerance of 0 or more, m")
    return KnownElevation(*map(float, numbers))


def _positive(value: float | None, what: str) -> float | None:
    if value is None:
        return None
    if not (math.isfinite(value) and 0 < value <= 1e6):
        raise InputError(f"{what} must be more than 0 m and at most 1,000 km, not {value:g} m")
    return float(value)


def _mean_gradient(mean: float, mean_is: MeanGradientDefinition) -> float:
    value = _gradient(mean, "the mean gradient")
    check_mean_gradient(value, mean_is)
    return value


def _gradient(value: float, what: str) -> float:
    if not abs(value) <= STEEPEST_GRADIENT:
        raise InputError(f"{what} must lie between -2 and 2 (0.1 is 10 %, downhill positive), not {value:g}")
    return float(value)

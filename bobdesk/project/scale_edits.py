"""What a user does to the scale: control points, known distances, and the way that is chosen."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import TypeVar

from bobdesk.errors import InputError
from bobdesk.plan.control_points import ControlPoint, KnownDistance
from bobdesk.project import derive
from bobdesk.project.project import CalibrationChoice, CalibrationWay, Project

Item = TypeVar("Item")


def add_control_point(project: Project, point: ControlPoint) -> Project:
    """Place a pixel whose position is known."""
    return replace(project, control_points=(*project.control_points, point))


def change_control_point(project: Project, index: int, point: ControlPoint) -> Project:
    """Move, rename or correct a control point, or switch it on or off."""
    return replace(project, control_points=_with(project.control_points, index, point, "control point"))


def move_control_point(project: Project, index: int, x_px: float, y_px: float) -> Project:
    """Put a control point at another pixel; what is digitised already is scaled anew."""
    point = _at(project.control_points, index, "control point")
    return change_control_point(project, index, replace(point, x_px=float(x_px), y_px=float(y_px)))


def use_control_point(project: Project, index: int, *, used: bool) -> Project:
    """Switch a control point on or off; its residual is shown all the same."""
    return change_control_point(project, index, replace(_at(project.control_points, index, "control point"), used=used))


def remove_control_point(project: Project, index: int) -> Project:
    """Take a control point away."""
    return replace(project, control_points=_without(project.control_points, index, "control point"))


def set_control_points(project: Project, points: Iterable[ControlPoint]) -> Project:
    """Take all control points from a file in the place of those there are."""
    return replace(project, control_points=tuple(points))


def add_known_distance(project: Project, known: KnownDistance) -> Project:
    """Give a distance between two pixels."""
    return replace(project, known_distances=(*project.known_distances, known))


def change_known_distance(project: Project, index: int, known: KnownDistance) -> Project:
    """Correct a known distance, or switch it on or off."""
    return replace(project, known_distances=_with(project.known_distances, index, known, "known distance"))


def remove_known_distance(project: Project, index: int) -> Project:
    """Take a known distance away."""
    return replace(project, known_distances=_without(project.known_distances, index, "known distance"))


def add_check_distance(project: Project, known: KnownDistance) -> Project:
    """Give a distance that only checks the scale."""
    return replace(project, check_distances=(*project.check_distances, known))


def change_check_distance(project: Project, index: int, known: KnownDistance) -> Project:
    """Correct a check distance."""
    return replace(project, check_distances=_with(project.check_distances, index, known, "check distance"))


def remove_check_distance(project: Project, index: int) -> Project:
    """Take a check distance away."""
    return replace(project, check_distances=_without(project.check_distances, index, "check distance"))


def choose_scale_way(project: Project, way: CalibrationWay) -> Project:
    """Choose how pixels become metres; a number that the way needs may be given afterwards."""
    return _calibrated(project, replace(project.calibration, way=way))


def scale_by_points(project: Project) -> Project:
    """Let control points and known distances make the scale."""
    return _calibrated(project, replace(project.calibration, way="points"))


def scale_by_number(project: Project, metres_per_pixel: float) -> Project:
    """Give the scale as metres per pixel."""
    value = _positive(metres_per_pixel, "the scale must be a positive number of metres per pixel")
    return _calibrated(project, replace(project.calibration, way="scale", metres_per_pixel=value))


def scale_of_drawing(project: Project, one_to: float) -> Project:
    """Give the scale of the drawing, 1 : `one_to`, for a picture that says its dpi."""
    value = _positive(one_to, "a drawing scale is 1 : a positive number")
    return _calibrated(project, replace(project.calibration, way="drawing scale", one_to=value))


def scale_by_position(project: Project) -> Project:
    """Let the picture's own tags or world file make the scale."""
    return _calibrated(project, replace(project.calibration, way="world"))


def find_the_scale(project: Project) -> Project:
    """Say that the scale is unknown, so that it is solved for; known elevations then count in pixels."""
    return _calibrated(project, replace(project.calibration, way="unknown"))


def _calibrated(project: Project, choice: CalibrationChoice) -> Project:
    """Choose how pixels become metres; known elevations stay at their places where their unit becomes another."""
    after = replace(project, calibration=choice)
    known = derive.scale_is_known(after)
    if project.picture is None or derive.scale_is_known(project) == known:
        return after
    found = derive.calibration(after if known else project).value
    if found is None:
        return after
    factor = found.metres_per_pixel if known else 1 / found.metres_per_pixel
    moved = (replace(each, station=round(factor * each.station, 6)) for each in project.known_elevations)
    return replace(after, known_elevations=tuple(moved))


def _positive(value: float, sentence: str) -> float:
    if not (math.isfinite(value) and value > 0):
        raise InputError(f"{sentence}, not {value:g}")
    return float(value)


def _at(items: tuple[Item, ...], index: int, what: str) -> Item:
    if not 0 <= index < len(items):
        raise InputError(f"there is no {what} {index + 1}")
    return items[index]


def _with(items: tuple[Item, ...], index: int, item: Item, what: str) -> tuple[Item, ...]:
    _at(items, index, what)
    return (*items[:index], item, *items[index + 1 :])


def _without(items: tuple[Item, ...], index: int, what: str) -> tuple[Item, ...]:
    _at(items, index, what)
    return (*items[:index], *items[index + 1 :])

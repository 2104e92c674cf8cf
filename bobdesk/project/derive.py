"""What follows from a project: everything shown before a run. Pure, and remembered by identity.

Each function takes the project and hands the few values it needs to a remembered one below, so that
renaming a run never fits a centreline again. Whatever needs scipy is imported where it is called: the
window shows a project before that is loaded.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Generic, TypeVar

import numpy as np

from bobdesk.alignment.fit_settings import FitSettings
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segment, Segments, stretched
from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError, TargetError
from bobdesk.plan.calibration import (
    Calibration,
    DistanceCheck,
    calibration_from_drawing_scale,
    calibration_from_scale,
    calibration_from_world,
    unknown_scale,
)
from bobdesk.plan.calibration import check_distances as checks_of
from bobdesk.plan.calibration_fit import CalibrationFit, fit_calibration
from bobdesk.plan.control_points import ControlPoint, KnownDistance
from bobdesk.plan.polyline import Polyline, edge_lengths, polyline_from_points
from bobdesk.plan.polyline_geometry import arc_lengths, part_between
from bobdesk.plan.projection import Georeference
from bobdesk.plan.traced_line import Trace
from bobdesk.plan.world import PixelToWorld
from bobdesk.project.project import CalibrationChoice, Extent, Project, SourceLine
from bobdesk.project.runs import RunInputs
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.targets import KnownElevation, Targets, check_targets, in_scale

if TYPE_CHECKING:
    from bobdesk.alignment.centreline import Centreline
    from bobdesk.alignment.segment_figures import SegmentFigures

Value = TypeVar("Value")
_LONGEST_MITRE = 3.0
_BEYOND_THE_END = 0.005


@dataclass(frozen=True, eq=False)
class Derived(Generic[Value]):
    """A value, or the sentence that says why there is none yet."""

    value: Value | None
    problem: str | None = None

    def needed(self) -> Value:
        """Return the value, or raise InputError with the sentence."""
        if self.value is None:
            raise InputError(self.problem or "there is nothing yet")
        return self.value


def scale_is_known(project: Project) -> bool:
    """Return whether lengths in the plan are metres; if not, the factor f is solved for."""
    return project.calibration.way != "unknown"


def calibration(project: Project) -> Derived[Calibration]:
    """Return how the picture's pixels become metres."""
    picture = project.picture
    return _calibration(
        project.calibration,
        project.control_points,
        project.known_distances,
        None if picture is None else picture.file_dpi,
        None if picture is None else picture.world,
        "the picture" if picture is None else picture.name,
    )


def scale_error(project: Project) -> float | None:
    """Return 1 sigma of the scale as a share of it: the user's, else the calibration's; None if neither says it."""
    if project.plan_error is not None:
        return project.plan_error
    found = None if project.source is not None else calibration(project).value
    if found is None or found.scale_sigma is None:
        return None
    return found.scale_sigma / found.metres_per_pixel


def calibration_fit(project: Project) -> Derived[CalibrationFit]:
    """Return the residuals of control points and known distances, whatever way is chosen."""
    return _calibration_fit(project.control_points, project.known_distances)


def distance_checks(project: Project) -> tuple[DistanceCheck, ...]:
    """Return the check distances beside what the plan gives; none while there is no scale."""
    found = calibration(project).value
    if found is None or not found.scale_known:
        return ()
    return checks_of(found, project.check_distances)


def digitised_length(project: Project) -> float | None:
    """Return the length of the whole digitised line, in pixels of a trace or metres of a source."""
    if project.source is not None:
        return _length_of(project.source)
    return None if project.trace is None else _length_of(project.trace)


def polyline(project: Project) -> Derived[Polyline]:
    """Return the track's line in plan, m: cut at start and finish, moved from an edge to the centre."""
    if project.source is not None:
        return _polyline(project.source, None, project.extent)
    if project.trace is None:
        return Derived(None, "there is no line yet: trace it in the picture, or open coordinates")
    found = calibration(project)
    if found.value is None:
        return Derived(None, found.problem)
    return _polyline(project.trace, found.value, project.extent)


def georeference(project: Project) -> Georeference | None:
    """Return where the polyline's origin lies on the Earth, or None if nothing says so.

    World files and GeoTIFF tags give metres in a grid that BobDesk does not know, so a picture has none;
    nor has a plan of unknown scale, whose metres are not metres on the ground.
    """
    source = project.source
    if source is None or source.longitude is None or source.latitude is None or not scale_is_known(project):
        return None
    return Georeference(source.longitude, source.latitude)


def plan_factor(project: Project) -> float:
    """Return the factor that brings a plan of unknown scale near true size; 1 where the scale is known."""
    chosen = project.targets
    line = polyline(project).value
    if scale_is_known(project) or chosen.length is None or line is None:
        return 1.0
    drop = chosen.drop or 0.0
    if not 0 <= drop < chosen.length:
        return 1.0
    return math.sqrt(chosen.length**2 - drop**2) / float(edge_lengths(line).sum())


def working_polyline(project: Project) -> Derived[Polyline]:
    """Return the polyline near true size, as centreline and runs use it."""
    found = polyline(project)
    factor = plan_factor(project)
    return found if found.value is None or factor == 1.0 else Derived(_multiplied(found.value, factor))


def centreline(project: Project) -> Derived[Centreline]:
    """Return the smooth line at equal stations."""
    found = working_polyline(project)
    if found.value is None:
        return Derived(None, found.problem)
    return _centreline(found.value, project.fit)


def curvature(project: Project) -> FloatArray | None:
    """Return the curvature at every station of the centreline, (n,), 1/m, left positive."""
    from bobdesk.alignment.curvature import curvature as curvature_of

    found = centreline(project).value
    return None if found is None else curvature_of(found)


def segments(project: Project) -> Derived[Segments]:
    """Return the segments in force: the user's, brought to the line's present length, or automatic ones."""
    found = centreline(project)
    if found.value is None:
        return Derived(None, found.problem)
    if project.segments is not None:
        return _stretched(project.segments, found.value.length)
    return _detected(found.value, project.segmentation)


def segment_figures(project: Project) -> tuple[SegmentFigures, ...]:
    """Return radius, turn and fit of each segment in force."""
    line, found = centreline(project).value, segments(project).value
    return () if line is None or found is None else _segment_figures(line, found)


def targets(project: Project) -> Derived[Targets]:
    """Return the targets in force, with known elevations in the plan's own scale."""
    chosen = project.targets
    missing = [name for name, value in (("length", chosen.length), ("drop", chosen.drop)) if value is None]
    if chosen.length is None or chosen.drop is None:
        return Derived(None, f"the {' and the '.join(missing)} of {chosen.name or 'the track'} must be given")
    wanted = Targets(
        length=chosen.length,
        drop=chosen.drop,
        mean_gradient=chosen.mean_gradient,
        mean_gradient_is=chosen.mean_gradient_is,
        min_gradient=project.limits.min_gradient,
        max_gradient=project.limits.max_gradient,
        known=elevations_on_the_line(project),
        unknown_scale=not scale_is_known(project),
    )
    try:
        return Derived(check_targets(wanted))
    except InputError as error:
        return Derived(None, str(error))


def elevations_on_the_line(project: Project) -> tuple[KnownElevation, ...]:
    """Return the known elevations between start and finish; others wait until the line reaches them."""
    line = polyline(project).value
    if line is None:
        return project.known_elevations
    length = (1 + _BEYOND_THE_END) * float(edge_lengths(line).sum())
    return tuple(item for item in project.known_elevations if 0 <= item.station <= length)


def run_inputs(project: Project) -> Derived[RunInputs]:
    """Return what a run, or the feasibility check, is given."""
    line, found, wanted = working_polyline(project), segments(project), targets(project)
    if line.value is None or found.value is None:
        return Derived(None, line.problem or found.problem)
    if wanted.value is None:
        return Derived(None, wanted.problem)
    factor = plan_factor(project)
    scaled = in_scale(wanted.value, factor)
    try:
        anchors_of(scaled, centreline(project).needed().length)
    except TargetError as error:
        return Derived(None, str(error))
    return Derived(RunInputs(line.value, factor, project.fit, found.value, scaled, project.solver))


@lru_cache(maxsize=8)
def _calibration(
    choice: CalibrationChoice,
    points: tuple[ControlPoint, ...],
    distances: tuple[KnownDistance, ...],
    dpi: tuple[float, float] | None,
    world: PixelToWorld | None,
    name: str,
) -> Derived[Calibration]:
    try:
        if choice.way == "unknown":
            return Derived(unknown_scale())
        if choice.way == "points":
            return Derived(fit_calibration(points, distances=distances).calibration)
        if choice.way == "scale" and choice.metres_per_pixel is not None:
            return Derived(calibration_from_scale(choice.metres_per_pixel))
        if choice.way == "drawing scale" and choice.one_to is not None:
            return Derived(calibration_from_drawing_scale(dpi, one_to=choice.one_to))
        if choice.way == "world" and world is not None:
            return Derived(calibration_from_world(world, name=name))
    except InputError as error:
        return Derived(None, str(error))
    missing = {
        "scale": "the metres per pixel must be given",
        "drawing scale": "the scale of the drawing, 1 : something, must be given",
        "world": "the picture does not say where it lies",
    }
    return Derived(None, missing[choice.way])


@lru_cache(maxsize=8)
def _calibration_fit(points: tuple[ControlPoint, ...], distances: tuple[KnownDistance, ...]) -> Derived[CalibrationFit]:
    try:
        return Derived(fit_calibration(points, distances=distances))
    except InputError as error:
        return Derived(None, str(error))


@lru_cache(maxsize=8)
def _length_of(line: Trace | SourceLine) -> float:
    return float(arc_lengths(_points_of(line))[-1])


def _points_of(line: Trace | SourceLine) -> FloatArray:
    return line.polyline.vertices if isinstance(line, SourceLine) else line.points


@lru_cache(maxsize=8)
def _polyline(line: Trace | SourceLine, pixels: Calibration | None, extent: Extent) -> Derived[Polyline]:
    points = _points_of(line)
    whole = _length_of(line)
    end = whole if extent.end is None else min(extent.end, whole)
    if extent.start >= end:
        return Derived(None, "the finish lies before the start; move one of them")
    if extent.start > 0 or end < whole:
        points = part_between(points, start=extent.start, end=end)
    metres = points if pixels is None else pixels.to_metres(points)
    try:
        found, _ = polyline_from_points(metres)
    except InputError as error:
        return Derived(None, str(error))
    if extent.digitised != "centre" and extent.offset:
        # The left edge has the centreline on its right.
        aside = -extent.offset if extent.digitised == "left edge" else extent.offset
        found = Polyline(moved_aside(found.vertices, distance=aside))
    return Derived(found)


def moved_aside(points: FloatArray, *, distance: float) -> FloatArray:
    """Return each vertex (n, 2), y up, moved so that every edge lies `distance` further to its left.

    Vertex by vertex, so that a line that crosses itself keeps its loop.
    """
    way = np.diff(points, axis=0)
    way /= np.hypot(way[:, 0], way[:, 1])[:, None]
    normal = np.column_stack([-way[:, 1], way[:, 0]])
    before, after = np.vstack([normal[:1], normal]), np.vstack([normal, normal[-1:]])
    middle = before + after
    # |middle|² / 2 is 1 + cos of the turn: dividing by it keeps both edges at the distance.
    size = np.maximum((middle**2).sum(axis=1) / 2, 2 / _LONGEST_MITRE**2)
    moved: FloatArray = points + distance * middle / size[:, None]
    return moved


@lru_cache(maxsize=8)
def _multiplied(line: Polyline, factor: float) -> Polyline:
    return Polyline(factor * line.vertices)


@lru_cache(maxsize=8)
def _centreline(line: Polyline, fit: FitSettings) -> Derived[Centreline]:
    from bobdesk.alignment.centreline import fit_centreline

    try:
        return Derived(fit_centreline(line, fit))
    except InputError as error:
        return Derived(None, str(error))


@lru_cache(maxsize=8)
def _detected(line: Centreline, settings: SegmentationSettings) -> Derived[Segments]:
    from bobdesk.alignment.segmentation import detect_segments

    try:
        return Derived(detect_segments(line, settings))
    except InputError as error:
        return Derived(None, str(error))


@lru_cache(maxsize=8)
def _stretched(stored: Segments, length: float) -> Derived[Segments]:
    return Derived(stretched(stored, length))


@lru_cache(maxsize=8)
def _segment_figures(line: Centreline, found: Segments) -> tuple[SegmentFigures, ...]:
    return tuple(figures_of_one(line, segment) for segment in found)


@lru_cache(maxsize=4096)
def figures_of_one(line: Centreline, segment: Segment) -> SegmentFigures:
    """Return radius, turn and fit of one segment; of hundreds, a drag changes two."""
    from bobdesk.alignment.segment_figures import segment_figures as figures_of_segment

    return figures_of_segment(line, segment)

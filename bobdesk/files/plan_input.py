"""A plan made ready to be solved: brought near true size, its centreline fitted, its segments found."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from bobdesk.alignment.centreline import Centreline, fit_centreline
from bobdesk.alignment.fit_settings import FitSettings
from bobdesk.alignment.segmentation import detect_segments
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segments, stretched
from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.importers.segments_csv import read_segments
from bobdesk.plan.polyline import Polyline, edge_lengths
from bobdesk.project import derive
from bobdesk.solve.settings import SolverSettings
from bobdesk.solve.targets import Targets, in_scale


@dataclass(frozen=True)
class PlanInput:
    """A plan with its targets, both brought near true size.

    Attributes
    ----------
    centreline, segments, targets
        In the same scale.
    factor
        By which the plan was multiplied first: 1 where its scale is known.
    asked
        The targets as they were given, in the plan's own scale.
    solver
        A project's settings of the solver, else the usual ones.
    vertices
        How many the plan has.
    wavelength
        Of the smoothing in force, m.
    scale_error
        1 sigma of the plan's scale as a share, where a project says it.
    gradient_change
        A project's largest change of the gradient per metre, 1/m, if it has one.
    actual : (n, 3) or None
        The line with its elevations, or a project's actual track, m, where there is one.
    """

    centreline: Centreline
    segments: Segments
    targets: Targets
    factor: float
    asked: Targets
    solver: SolverSettings
    vertices: int
    wavelength: float
    scale_error: float | None
    gradient_change: float | None
    actual: FloatArray | None


def plan_input(
    found: ImportedLine,
    asked: Targets,
    *,
    name: str,
    spacing: float | None = None,
    wavelength: float | None = None,
    count: int | None = None,
    threshold: float | None = None,
    segments_from: Path | None = None,
) -> PlanInput:
    """Fit a line and find its segments; a project brings what is None.

    A plan of unknown scale is first enlarged to about the wanted length, so that spacing, smoothing
    and curvature threshold mean metres.

    Parameters
    ----------
    found
        The plan as it was read.
    asked
        Its targets, in its own scale.
    name
        Of the plan, for sentences.

    Raises
    ------
    InputError
        If no centreline or segments can be found.
    """
    targets = asked
    polyline, factor = found.polyline, 1.0
    if targets.unknown_scale:
        drawn = float(edge_lengths(polyline).sum())
        factor = (targets.length**2 - targets.drop**2) ** 0.5 / drawn
        polyline = Polyline(factor * polyline.vertices)
        targets = in_scale(targets, factor)
    fit = fit_settings(found, spacing, wavelength)
    centreline = fitted(name, polyline, fit)
    if segments_from is not None:
        segments = read_segments(segments_from, length=centreline.length, scale=factor)
    else:
        segments = segments_in_force(found, centreline, count, threshold)
    project = found.project
    solver = SolverSettings() if project is None else project.solver
    scale_error = change = None
    if project is not None:
        scale_error, change = derive.scale_error(project), project.limits.gradient_change
    return PlanInput(
        centreline, segments, targets, factor, asked, solver, len(polyline.vertices), fit.wavelength, scale_error,
        change, _actual(found),
    )  # fmt: skip


def has_own_segments(found: ImportedLine, count: int | None, threshold: float | None) -> bool:
    """Return whether the segments that come with a plan are the ones in force."""
    return found.segments is not None and count is None and threshold is None


def segments_in_force(
    found: ImportedLine, centreline: Centreline, count: int | None, threshold: float | None
) -> Segments:
    """Return a plan's own segments, unless others are asked for."""
    if found.segments is not None and has_own_segments(found, count, threshold):
        return stretched(found.segments, centreline.length)
    usual = SegmentationSettings() if found.project is None else found.project.segmentation
    if count is not None or threshold is not None:
        usual = replace(usual, count=count, threshold=threshold)
    return detect_segments(centreline, usual)


def fit_settings(found: ImportedLine, spacing: float | None, wavelength: float | None) -> FitSettings:
    """Return the settings of the centreline that are given, a project's own, or the usual ones."""
    usual = FitSettings() if found.project is None else found.project.fit
    return FitSettings(
        usual.spacing if spacing is None else spacing, usual.wavelength if wavelength is None else wavelength
    )


def fitted(name: str, polyline: Polyline, settings: FitSettings) -> Centreline:
    """Return the centreline of a plan; a sentence about what is wrong with it names the plan."""
    try:
        return fit_centreline(polyline, settings)
    except InputError as error:
        raise InputError(f"{name}: {error}") from error


def _actual(found: ImportedLine) -> FloatArray | None:
    if found.project is not None:
        return None if found.project.actual is None else found.project.actual.points
    if found.elevations is None:
        return None
    return np.column_stack([found.polyline.vertices, found.elevations])

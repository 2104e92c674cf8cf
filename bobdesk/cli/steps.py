"""The steps that commands have in common: plan, segments, targets, progress."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Generator, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

import click
import numpy as np

from bobdesk.alignment.centreline import Centreline, fit_centreline
from bobdesk.alignment.fit_settings import FitSettings
from bobdesk.alignment.segmentation import detect_segments
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segments, stretched
from bobdesk.arrays import FloatArray
from bobdesk.cli.targets import TargetOptions, targets_of
from bobdesk.errors import InputError
from bobdesk.files.atomic import check_writable, resolved
from bobdesk.files.importers.formats import import_formats, read_line
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.importers.segments_csv import read_segments
from bobdesk.plan.polyline import Polyline, edge_lengths
from bobdesk.progress import Progress
from bobdesk.project import derive
from bobdesk.solve.settings import SolverSettings
from bobdesk.solve.targets import Targets, in_scale

Result = TypeVar("Result")
_QUIET_FOR = 0.5
_BAR = 30


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
        1 sigma of the plan's scale as a share, where a project's calibration says it, else 0.
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
    scale_error: float
    actual: FloatArray | None


def check_outputs(outputs: Iterable[Path | None], *, inputs: Iterable[Path | None]) -> None:
    """Refuse outputs that cannot be written, are the same file, or would overwrite an input."""
    given = [path for path in outputs if path is not None]
    for path in given:
        check_writable(path)
    places = [resolved(path) for path in given]
    if len(set(places)) < len(places):
        raise click.UsageError("two outputs have the same name")
    read = [path for path in inputs if path is not None]
    for path, place in zip(given, places, strict=True):
        if any(_leads_to(other, place) for other in read):
            raise click.UsageError(f"{path}: the output would overwrite an input; give it another name")


def _leads_to(path: Path, place: Path) -> bool:
    try:
        return resolved(path) == place
    except OSError:  # a link in a circle leads nowhere; reading it says so
        return False


def read_plan(path: Path) -> ImportedLine:
    """Read a plan and say on stderr what was changed or assumed."""
    for finding in import_formats().findings:
        click.echo(f"note: {finding.sentence}", err=True)
    line = read_line(path)
    for note in line.notes:
        click.echo(f"note: {path}: {note}", err=True)
    return line


def fitted_plan(
    path: Path, *, spacing: float | None, wavelength: float | None, count: int | None, threshold: float | None
) -> tuple[Centreline, Segments]:
    """Read a plan, fit its centreline, and return it with the segments in force."""
    found = read_plan(path)
    centreline = _fitted(path, found.polyline, _fit_settings(found, spacing, wavelength))
    return centreline, _segments(path, found, centreline, count, threshold)


def plan_and_segments(
    path: Path,
    options: TargetOptions,
    *,
    spacing: float | None,
    wavelength: float | None,
    count: int | None,
    threshold: float | None,
    segments_from: Path | None,
    quiet: bool = False,
) -> PlanInput:
    """Read the plan, fit it and find its segments; a project brings what the command line leaves open.

    A plan of unknown scale is first enlarged to about the wanted length, so that spacing, smoothing
    and curvature threshold mean metres.
    """
    if segments_from is not None and (count is not None or threshold is not None):
        raise click.UsageError("--segments gives the segments, so --count and --threshold cannot be given too")
    found = read_line(path) if quiet else read_plan(path)
    asked = targets = targets_of(options, found.project, plan=path)
    polyline, factor = found.polyline, 1.0
    if targets.unknown_scale:
        drawn = float(edge_lengths(polyline).sum())
        factor = (targets.length**2 - targets.drop**2) ** 0.5 / drawn
        polyline = Polyline(factor * polyline.vertices)
        targets = in_scale(targets, factor)
    fit = _fit_settings(found, spacing, wavelength)
    centreline = _fitted(path, polyline, fit)
    if segments_from is not None:
        segments = read_segments(segments_from, length=centreline.length, scale=factor)
    else:
        segments = _segments(path, found, centreline, count, threshold)
    solver = SolverSettings() if found.project is None else found.project.solver
    scale_error = 0.0 if found.project is None else derive.scale_error(found.project)
    return PlanInput(
        centreline, segments, targets, factor, asked, solver, len(polyline.vertices), fit.wavelength, scale_error,
        _actual(found),
    )  # fmt: skip


def _actual(found: ImportedLine) -> FloatArray | None:
    if found.project is not None:
        return None if found.project.actual is None else found.project.actual.points
    if found.elevations is None:
        return None
    return np.column_stack([found.polyline.vertices, found.elevations])


def _fit_settings(found: ImportedLine, spacing: float | None, wavelength: float | None) -> FitSettings:
    usual = FitSettings() if found.project is None else found.project.fit
    return FitSettings(
        usual.spacing if spacing is None else spacing, usual.wavelength if wavelength is None else wavelength
    )


def _segments(
    path: Path, found: ImportedLine, centreline: Centreline, count: int | None, threshold: float | None
) -> Segments:
    """Return the file's own segments, unless the command line asks for others to be found."""
    usual = SegmentationSettings() if found.project is None else found.project.segmentation
    if count is not None or threshold is not None:
        usual = replace(usual, count=count, threshold=threshold)
    elif found.segments is not None:
        click.echo(f"note: {path}: its own {len(found.segments)} segments are used", err=True)
        return stretched(found.segments, centreline.length)
    return detect_segments(centreline, usual)


def _fitted(path: Path, polyline: Polyline, settings: FitSettings) -> Centreline:
    try:
        return fit_centreline(polyline, settings)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def with_progress(job: Generator[Any, None, Result], doing: str) -> Result:
    """Pull a job to its end; a bar on stderr where that is a terminal and it takes over half a second."""
    started = shown = time.monotonic()
    # A program with a window has no standard error on Windows.
    terminal = sys.stderr is not None and sys.stderr.isatty()
    drawn = False
    count = 0
    while True:
        try:
            step = next(job)
        except StopIteration as end:
            if drawn:
                click.echo("\r" + " " * 79 + "\r", err=True, nl=False)
            result: Result = end.value
            return result
        count += 1
        now = time.monotonic()
        if terminal and now - started > _QUIET_FOR and now - shown > 0.1:
            shown, drawn = now, True
            click.echo("\r" + _bar(step, doing, count).ljust(79)[:79], err=True, nl=False)


def _bar(step: object, doing: str, count: int) -> str:
    if isinstance(step, Progress):
        filled = round(_BAR * step.fraction)
        return f"{step.doing} [{'#' * filled}{'.' * (_BAR - filled)}] {100 * step.fraction:3.0f} %"
    objective = getattr(step, "objective", float("nan"))
    return f"{doing}: iteration {count:,}, objective {objective:.3g}"


def to_json(report: dict[str, Any]) -> bytes:
    """Return a report as JSON; figures that do not exist are null."""
    return (json.dumps(_plain(report), indent=2, allow_nan=False, ensure_ascii=False) + "\n").encode()


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return value if value - value == 0 else None
    return value

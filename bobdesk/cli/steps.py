"""The steps that commands have in common: plan, segments, targets, progress."""

from __future__ import annotations

import json
import re
import sys
import time
from collections.abc import Generator, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import click

from bobdesk.alignment.centreline import Centreline, fit_centreline
from bobdesk.alignment.fit_settings import FitSettings
from bobdesk.alignment.segmentation import detect_segments
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segments
from bobdesk.cli.project_plan import line_of_project
from bobdesk.errors import InputError
from bobdesk.files.atomic import check_writable
from bobdesk.files.importers.formats import import_formats, read_line
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.importers.segments_csv import read_segments
from bobdesk.files.project_file import is_project
from bobdesk.plan.polyline import Polyline, edge_lengths
from bobdesk.progress import Progress
from bobdesk.solve.targets import DEFINITIONS, KnownElevation, Targets, check_targets, in_scale

Result = TypeVar("Result")
_QUIET_FOR = 0.5
_BAR = 30
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")


@dataclass(frozen=True)
class PlanInput:
    """A plan with its targets, both brought near true size.

    Attributes
    ----------
    centreline, segments, targets
        In the same scale.
    factor
        By which the plan was multiplied first: 1 where its scale is known.
    """

    centreline: Centreline
    segments: Segments
    targets: Targets
    factor: float


def check_outputs(outputs: Iterable[Path | None], *, inputs: Iterable[Path | None]) -> None:
    """Refuse outputs that cannot be written, are the same file, or would overwrite an input."""
    given = [path for path in outputs if path is not None]
    for path in given:
        check_writable(path)
    places = [path.resolve() for path in given]
    if len(set(places)) < len(places):
        raise click.UsageError("two outputs have the same name")
    read = [path for path in inputs if path is not None]
    for path, place in zip(given, places, strict=True):
        if any(place == other.resolve() for other in read):
            raise click.UsageError(f"{path}: the output would overwrite an input; give it another name")


def read_plan(path: Path) -> ImportedLine:
    """Read a plan and say on stderr what was changed or assumed."""
    for finding in import_formats().findings:
        click.echo(f"note: {finding.sentence}", err=True)
    line = line_of_project(path) if is_project(path) else read_line(path)
    for note in line.notes:
        click.echo(f"note: {path}: {note}", err=True)
    return line


def fitted_plan(path: Path, *, spacing: float, wavelength: float) -> Centreline:
    """Read a plan and fit its centreline."""
    return _fitted(path, read_plan(path).polyline, FitSettings(spacing, wavelength))


def plan_and_segments(
    path: Path,
    targets: Targets,
    *,
    spacing: float,
    wavelength: float,
    count: int | None,
    threshold: float | None,
    segments_from: Path | None,
) -> PlanInput:
    """Read the plan, fit it and find its segments.

    A plan of unknown scale is first enlarged to about the wanted length, so that spacing, smoothing
    and curvature threshold mean metres.
    """
    if segments_from is not None and (count is not None or threshold is not None):
        raise click.UsageError("--segments gives the segments, so --count and --threshold cannot be given too")
    polyline = read_plan(path).polyline
    factor = 1.0
    if targets.unknown_scale:
        drawn = float(edge_lengths(polyline).sum())
        factor = (targets.length**2 - targets.drop**2) ** 0.5 / drawn
        polyline = Polyline(factor * polyline.vertices)
        targets = in_scale(targets, factor)
    centreline = _fitted(path, polyline, FitSettings(spacing, wavelength))
    if segments_from is not None:
        segments = read_segments(segments_from, length=centreline.length, scale=factor)
    else:
        segments = detect_segments(centreline, SegmentationSettings(threshold=threshold, count=count))
    return PlanInput(centreline, segments, targets, factor)


def _fitted(path: Path, polyline: Polyline, settings: FitSettings) -> Centreline:
    try:
        return fit_centreline(polyline, settings)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def targets_from(
    *,
    length: float,
    drop: float,
    mean_gradient: float | None,
    mean_gradient_is: str,
    min_gradient: float,
    max_gradient: float,
    known: Iterable[str],
    unknown_scale: bool,
) -> Targets:
    """Make targets of the options; what is no usable figure is a wrong call."""
    definition = next(name for name in DEFINITIONS if name == mean_gradient_is)
    try:
        return check_targets(
            Targets(
                length=length,
                drop=drop,
                mean_gradient=mean_gradient,
                mean_gradient_is=definition,
                min_gradient=min_gradient,
                max_gradient=max_gradient,
                known=tuple(_known(text) for text in known),
                unknown_scale=unknown_scale,
            )
        )
    except InputError as error:
        raise click.UsageError(str(error)) from error


def _known(text: str) -> KnownElevation:
    parts = text.split(":")
    numbers = [float(part) for part in parts if _NUMBER.fullmatch(part.strip())]
    if len(numbers) not in (2, 3) or len(numbers) < len(parts):
        raise click.UsageError(f"--known takes STATION:ELEVATION, two numbers in metres such as 250:98.5, not '{text}'")
    return KnownElevation(*numbers)


def with_progress(job: Generator[Any, None, Result], doing: str) -> Result:
    """Pull a job to its end; a bar on stderr where that is a terminal and it takes over half a second."""
    started = shown = time.monotonic()
    terminal = sys.stderr.isatty()
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

"""The steps that commands have in common: plan, segments, targets, progress."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Generator, Iterable
from pathlib import Path
from typing import Any, TypeVar

import click

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.cli.targets import TargetOptions, targets_of
from bobdesk.files.atomic import check_writable, resolved
from bobdesk.files.importers.formats import import_formats, read_line
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.plan_input import (
    PlanInput,
    fit_settings,
    fitted,
    has_own_segments,
    plan_input,
    segments_in_force,
)
from bobdesk.progress import Progress

Result = TypeVar("Result")
_QUIET_FOR = 0.5
_BAR = 30


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
    centreline = fitted(str(path), found.polyline, fit_settings(found, spacing, wavelength))
    tell_own_segments(path, found, count, threshold)
    return centreline, segments_in_force(found, centreline, count, threshold)


def plan_and_segments(
    path: Path,
    options: TargetOptions,
    *,
    spacing: float | None,
    wavelength: float | None,
    count: int | None,
    threshold: float | None,
    segments_from: Path | None,
) -> PlanInput:
    """Read the plan, fit it and find its segments; a project brings what the command line leaves open."""
    if segments_from is not None and (count is not None or threshold is not None):
        raise click.UsageError("--segments gives the segments, so --count and --threshold cannot be given too")
    found = read_plan(path)
    asked = targets_of(options, found.project, plan=path)
    if segments_from is None:
        tell_own_segments(path, found, count, threshold)
    return plan_input(
        found, asked, name=str(path), spacing=spacing, wavelength=wavelength, count=count, threshold=threshold,
        segments_from=segments_from,
    )  # fmt: skip


def tell_own_segments(path: Path, found: ImportedLine, count: int | None, threshold: float | None) -> None:
    """Say on stderr that a plan's own segments are used, where they are."""
    if found.segments is not None and has_own_segments(found, count, threshold):
        one = len(found.segments) == 1
        own = "its own 1 segment is used" if one else f"its own {len(found.segments)} segments are used"
        click.echo(f"note: {path}: {own}", err=True)


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
    return f"{doing}: iteration {getattr(step, 'number', count):,}, objective {objective:.3g}"


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

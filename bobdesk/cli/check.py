"""`bobdesk check`: can the targets be met, before any run."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from bobdesk.cli.main import UnmetTargetsError
from bobdesk.cli.options import (
    FILE,
    SeveralValues,
    plan_argument,
    plan_options,
    report_option,
    segment_options,
    strict_option,
    target_options,
)
from bobdesk.cli.reports import check_report
from bobdesk.cli.steps import check_outputs, plan_and_segments, to_json
from bobdesk.cli.targets import taken_target_options
from bobdesk.files.atomic import write_atomic
from bobdesk.solve.feasibility import feasibility


@click.command("check", cls=SeveralValues)
@plan_argument
@target_options
@plan_options
@segment_options
@click.option("--segments", type=FILE, metavar="FILE", help="Use these segments instead of finding them.")
@report_option
@strict_option
def command(
    plan: Path,
    spacing: float | None,
    wavelength: float | None,
    count: int | None,
    threshold: float | None,
    segments: Path | None,
    report: Path | None,
    strict: bool,
    **options: Any,
) -> None:
    """Say whether the figures can hold together for PLAN: what conflicts, with numbers, and what to doubt."""
    asked = taken_target_options(plan, **options)
    check_outputs([report], inputs=[plan, segments])
    given = plan_and_segments(
        plan,
        asked,
        spacing=spacing,
        wavelength=wavelength,
        count=count,
        threshold=threshold,
        segments_from=segments,
    )
    found = feasibility(given.centreline, given.segments, given.targets, given.solver.pgd)
    if report is not None:
        write_atomic(report, to_json(check_report(given, found)))
    if strict and not found.feasible:
        raise UnmetTargetsError(found.sentence)
    click.echo(found.sentence)

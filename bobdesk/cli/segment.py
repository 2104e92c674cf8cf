"""`bobdesk segment`: find the straights and curves of a plan."""

from __future__ import annotations

from pathlib import Path

import click

from bobdesk.alignment.segments import in_words
from bobdesk.cli.options import FILE, plan_argument, plan_options, segment_options
from bobdesk.cli.steps import check_outputs, fitted_plan
from bobdesk.files.atomic import write_atomic
from bobdesk.files.exporters.tables import segments_table


@click.command("segment")
@plan_argument
@click.option("-o", "--output", type=FILE, required=True, metavar="SEGMENTS.csv", help="Where to write them.")
@plan_options
@segment_options
def command(
    plan: Path,
    output: Path,
    spacing: float | None,
    wavelength: float | None,
    count: int | None,
    threshold: float | None,
) -> None:
    """Find the straights and curves of PLAN: CSV with the columns x_m and y_m, or any format that is read.

    Writes segment, kind, from_m, to_m, radius_m, turn_rad. Correct the file by hand where it needs
    it, and hand it to `bobdesk reconstruct --segments`.
    """
    check_outputs([output], inputs=[plan])
    centreline, segments = fitted_plan(plan, spacing=spacing, wavelength=wavelength, count=count, threshold=threshold)
    write_atomic(output, segments_table(centreline, segments))
    click.echo(f"{in_words(segments)}, on {centreline.length:.2f} m of plan; written to {output}")

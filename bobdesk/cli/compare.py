"""`bobdesk compare`: a 3D line beside the actual track."""

from __future__ import annotations

from pathlib import Path

import click
import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.cli.options import FILE, report_option
from bobdesk.cli.project_runs import shown_run
from bobdesk.cli.reports import comparison_report
from bobdesk.cli.steps import check_outputs, to_json
from bobdesk.errors import InputError
from bobdesk.files.atomic import write_atomic
from bobdesk.files.importers.formats import read_line
from bobdesk.files.project_file import is_project, load_project
from bobdesk.project.derive_runs import run_line
from bobdesk.track.comparison import compare


@click.command("compare")
@click.argument("line", type=FILE)
@click.argument("actual", type=FILE)
@report_option
def command(line: Path, actual: Path, report: Path | None) -> None:
    """Say how far the elevation and gradient of LINE are from those of ACTUAL.

    Both are CSV files with the columns x_m, y_m and z_m, or any other format with elevations, from
    start to end. A project (.bobdesk) as LINE stands for the result that it shows, as ACTUAL for its
    actual track, or the result where it has none. Elevations count from each line's lowest point, and
    places are compared at equal shares of the plan length.
    """
    check_outputs([report], inputs=[line, actual])
    found = compare(_points(line, actual=False), _points(actual, actual=True))
    if report is not None:
        write_atomic(report, to_json(comparison_report(found)))
    click.echo(
        f"elevation: RMS {found.z_rms:.3f} m ({found.z_rms_percent:.2f} % of the drop), largest {found.z_max:.3f} m"
        f" at {found.z_max_station:.0f} m\n"
        f"gradient: RMS {100 * found.gradient_rms:.2f} %\n"
        f"deviations: length {found.length_percent:+.4f} %, drop {found.drop_percent:+.4f} %,"
        f" mean gradient {found.mean_gradient_percent:+.4f} %, plan length {found.plan_length_percent:+.4f} %"
    )


def _points(path: Path, *, actual: bool) -> FloatArray:
    if is_project(path):
        project = load_project(path)
        if actual and project.actual is not None:
            return project.actual.points
        return run_line(shown_run(project, path)).points
    line = read_line(path)
    if line.elevations is None:
        raise InputError(f"{path}: there are no elevations (column z_m); a comparison needs them in both files")
    return np.column_stack([line.polyline.vertices, line.elevations])

"""`bobdesk reconstruct`: plan, length and drop in, 3D centreline out."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any, cast, get_args

import click
import numpy as np

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
from bobdesk.cli.reports import run_report
from bobdesk.cli.steps import check_outputs, plan_and_segments, targets_from, to_json, with_progress
from bobdesk.errors import TargetError
from bobdesk.files.atomic import write_all
from bobdesk.files.exporters.tables import envelope_table, line_table
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.envelope import Envelope, envelope
from bobdesk.solve.feasibility import Feasibility, feasibility
from bobdesk.solve.iterates import Method
from bobdesk.solve.run import solve
from bobdesk.solve.settings import PgdSettings, SolverSettings, Weights
from bobdesk.solve.targets import Targets, in_scale
from bobdesk.track.centreline3d import make_centreline3d
from bobdesk.track.figures import Figures, deviations, figures

_METHODS = get_args(Method)
_WITHOUT_KNOWN = ("published", "lbfgsb", "de")


@click.command("reconstruct", cls=SeveralValues)
@plan_argument
@click.option("-o", "--output", type=FILE, required=True, metavar="LINE.csv", help="Where to write the 3D centreline.")
@target_options
@plan_options
@segment_options
@click.option("--segments", type=FILE, metavar="FILE", help="Use these segments instead of finding them.")
@click.option(
    "--method",
    type=click.Choice(_METHODS),
    default="pgd",
    show_default=True,
    help="pgd is recommended: it holds drop and known elevations exactly. published is the paper's, the others are"
    " SciPy's on the paper's objective, to compare with.",
)
@click.option("--weight-length", type=float, default=1.0, show_default=True, help="a of the published objective.")
@click.option("--weight-height", type=float, default=1.0, show_default=True, help="b of the published objective.")
@click.option("--weight-curvature", type=float, default=1.0, show_default=True, help="c of the published objective.")
@click.option("--weight-gradient", type=float, default=1.0, show_default=True, help="d of the published objective.")
@click.option(
    "--rate", type=float, help="Learning rate of the published method; 1e-5, and less where the scale is unknown."
)
@click.option(
    "--transition", type=float, default=8.0, show_default=True, help="Length of vertical transitions, m (pgd)."
)
@click.option(
    "--level-out",
    type=float,
    default=30.0,
    show_default=True,
    help="A lowest point is level: let the gradient die out over this length before an end there, m (pgd).",
)
@click.option(
    "--meet-length/--smoothest", default=True, show_default=True, help="Meet the length, or stay smoothest (pgd)."
)
@click.option(
    "--flavour",
    type=click.Choice(["default", "excel-european", "tab", "xyz"]),
    default="default",
    show_default=True,
    help="How LINE.csv is written.",
)
@report_option
@click.option(
    "--envelope", "band", type=FILE, metavar="E.csv", help="Write the band that all possible profiles lie in."
)
@click.option("--picture", type=FILE, metavar="P.png", help="Draw plan, gradient and elevation (.png, .svg or .pdf).")
@strict_option
def command(
    plan: Path,
    output: Path,
    spacing: float,
    wavelength: float,
    count: int | None,
    threshold: float | None,
    segments: Path | None,
    method: str,
    weight_length: float,
    weight_height: float,
    weight_curvature: float,
    weight_gradient: float,
    rate: float | None,
    transition: float,
    level_out: float,
    meet_length: bool,
    flavour: str,
    report: Path | None,
    band: Path | None,
    picture: Path | None,
    strict: bool,
    **options: Any,
) -> None:
    """Make the 3D centreline of PLAN (CSV with x_m and y_m, or any format that is read) from length and drop.

    Drop and known elevations hold exactly; the length is met where it can be. What cannot be met is
    said, and `bobdesk check` says it beforehand.
    """
    targets = targets_from(**options)
    check_outputs([output, report, band, picture], inputs=[plan, segments])
    if picture is not None and picture.suffix.lower() not in (".png", ".svg", ".pdf"):
        raise click.UsageError(f"--picture must end in .png, .svg or .pdf, not '{picture.name}'")
    if not 0 <= transition <= 200:
        raise click.UsageError(f"--transition must lie between 0 and 200 m, not {transition:g}")
    if not 0 <= level_out <= 1000:
        raise click.UsageError(f"--level-out must lie between 0 and 1000 m, not {level_out:g}")
    weights = Weights(weight_length, weight_height, weight_curvature, weight_gradient)
    if not all(
        0 <= weight < float("inf") for weight in (weight_length, weight_height, weight_curvature, weight_gradient)
    ):
        raise click.UsageError("the weights must be numbers of 0 or more")
    if rate is not None and not 0 < rate < float("inf"):
        raise click.UsageError(f"--rate must be more than 0, not {rate:g}")
    settings = SolverSettings(
        method=cast(Method, method),
        pgd=PgdSettings(transition=transition, level_out=level_out, meet_length=meet_length),
        weights=weights,
        rate=rate,
    )
    given = plan_and_segments(
        plan,
        targets,
        spacing=spacing,
        wavelength=wavelength,
        count=count,
        threshold=threshold,
        segments_from=segments,
    )
    possible = feasibility(given.centreline, given.segments, given.targets, settings.pgd)
    if strict and not possible.feasible:
        raise UnmetTargetsError(possible.sentence)

    started = time.perf_counter()
    run = solve(given.centreline, given.segments, given.targets, settings)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        solution = with_progress(run, method)
    if not np.isfinite([solution.objective, solution.scale, *solution.gradients]).all():
        raise TargetError(f"the method {method} ran off to infinity on these figures; use the method pgd")
    seconds = time.perf_counter() - started
    line = make_centreline3d(given.centreline, given.segments, solution)
    found = figures(line)
    if strict and solution.status == 2:
        raise UnmetTargetsError(solution.message)

    files: dict[Path, bytes] = {}
    shown: Envelope | None = None
    if band is not None or picture is not None:
        anchors = anchors_of(given.targets, given.centreline.length)
        shown = envelope(solution.profile.stations, anchors, given.targets, scale=solution.scale)
    if band is not None and shown is not None:
        files[band] = envelope_table(shown)
    if picture is not None:
        from bobdesk.ui.plots.picture import draw_line

        files[picture] = draw_line(
            line, shown, in_scale(given.targets, solution.scale), title=_title(plan, found), kind=picture.suffix.lower()
        )
    if report is not None:
        off = deviations(found, targets)
        files[report] = to_json(run_report(given, targets, possible, solution, line, found, off, seconds))
    files[output] = line_table(line, flavour=flavour)
    write_all(files)
    notes = _notes(possible, method, targets, weights)
    for note in notes:
        click.echo(f"note: {note}", err=True)
    _say(solution.message, found, output)


def _title(plan: Path, found: Figures) -> str:
    return (
        f"{plan.stem}: length {found.length:.2f} m, drop {found.drop:.2f} m, mean gradient"
        f" {100 * found.mean_gradient_drop_per_length:.2f} % (drop / length)"
    )


def _notes(possible: Feasibility, method: str, targets: Targets, weights: Weights) -> list[str]:
    """Say what a user may think was heeded and was not."""
    notes = [possible.sentence] if not possible.feasible else [possible.doubt] if possible.doubt else []
    if method in _WITHOUT_KNOWN and targets.known:
        notes.append(f"the method {method} has no known elevations; they were left out")
    if method == "pgd" and weights != Weights():
        notes.append("the weights are those of the published objective; the method pgd has none")
    return notes


def _say(message: str, found: Figures, output: Path) -> None:
    click.echo(
        f"length {found.length:.3f} m, drop {found.drop:.3f} m, mean gradient"
        f" {100 * found.mean_gradient_drop_per_length:.2f} % (drop / length), gradients from"
        f" {100 * found.min_gradient:.1f} % to {100 * found.max_gradient:.1f} %\n{message}\nwritten to {output}"
    )

"""`bobdesk reconstruct`: plan, length and drop in, 3D centreline out."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import click
import numpy as np

from bobdesk.cli.main import UnmetTargetsError
from bobdesk.cli.open_data import open_data_files, open_data_options, taken_open_data_options
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
from bobdesk.cli.reports import advice_report, own_station, run_report
from bobdesk.cli.solver import solver_options, taken_solver_options
from bobdesk.cli.steps import check_outputs, plan_and_segments, to_json, with_progress
from bobdesk.cli.targets import taken_target_options
from bobdesk.errors import TargetError
from bobdesk.files.atomic import write_all
from bobdesk.files.exporters.tables import envelope_table, line_table
from bobdesk.files.plan_input import PlanInput
from bobdesk.files.solvers import solve_with_plugins, solver_methods
from bobdesk.project.target_edits import STEEPEST_CHANGE
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.envelope import Envelope, between_stations, envelope, smooth_envelope
from bobdesk.solve.feasibility import Feasibility, feasibility
from bobdesk.solve.iterates import Solution
from bobdesk.solve.next_elevation import NextElevation, next_elevation
from bobdesk.solve.run import SolverMethod, method_named
from bobdesk.solve.settings import Weights
from bobdesk.solve.targets import Targets, in_scale
from bobdesk.track.centreline3d import Centreline3D, make_centreline3d
from bobdesk.track.figures import Figures, deviations, figures
from bobdesk.track.missed import missed_targets, missed_text

_CANNOT_BE_MET = 2


def _change(_context: click.Context, _option: click.Parameter, value: float | None) -> float | None:
    if value is not None and not 0 < value <= STEEPEST_CHANGE:
        raise click.BadParameter(f"it must be more than 0 and at most {STEEPEST_CHANGE:g} per metre, not {value:g}.")
    return value


@click.command("reconstruct", cls=SeveralValues)
@plan_argument
@click.option("-o", "--output", type=FILE, required=True, metavar="LINE.csv", help="Where to write the 3D centreline.")
@target_options
@plan_options
@segment_options
@click.option("--segments", type=FILE, metavar="FILE", help="Use these segments instead of finding them.")
@solver_options
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
@click.option(
    "--gradient-change",
    type=float,
    callback=_change,
    metavar="PER_M",
    help="Largest change of the gradient per metre, 1/m, for the envelope: 0.002 is 2 % in 10 m.",
    show_default="a project's, else no limit",
)
@click.option(
    "--advice/--no-advice",
    default=True,
    help="With --envelope, say where one more known elevation would help most; that takes some seconds.",
)
@open_data_options
@click.option("--picture", type=FILE, metavar="P.png", help="Draw plan, gradient and elevation (.png, .svg or .pdf).")
@strict_option
def command(
    plan: Path,
    output: Path,
    spacing: float | None,
    wavelength: float | None,
    count: int | None,
    threshold: float | None,
    segments: Path | None,
    flavour: str,
    report: Path | None,
    band: Path | None,
    gradient_change: float | None,
    advice: bool,
    picture: Path | None,
    strict: bool,
    **options: Any,
) -> None:
    """Make the 3D centreline of PLAN (CSV with x_m and y_m, or any format that is read) from length and drop.

    A project (.bobdesk) brings its targets, limits, known elevations, segments and settings; what the
    command line says goes before them.

    Drop and known elevations hold exactly; the length is met where it can be. What cannot be met is
    said, and `bobdesk check` says it beforehand.
    """
    solver = taken_solver_options(options)
    about_errors = taken_open_data_options(options)
    asked = taken_target_options(plan, **options)
    check_outputs([output, report, band, picture, *about_errors.outputs], inputs=[plan, segments])
    if picture is not None and picture.suffix.lower() not in (".png", ".svg", ".pdf"):
        raise click.UsageError(f"--picture must end in .png, .svg or .pdf, not '{picture.name}'")
    given = plan_and_segments(
        plan,
        asked,
        spacing=spacing,
        wavelength=wavelength,
        count=count,
        threshold=threshold,
        segments_from=segments,
    )
    settings = solver.on(given.solver)
    method = method_named(settings.method, solver_methods().formats)
    possible = feasibility(given.centreline, given.segments, given.targets, settings.pgd)
    if strict and not possible.feasible:
        raise UnmetTargetsError(possible.sentence)

    started = time.perf_counter()
    run = solve_with_plugins(given.centreline, given.segments, given.targets, settings)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        solution = with_progress(run, method.key)
    if not np.isfinite([solution.objective, solution.scale, *solution.gradients]).all():
        raise TargetError(f"the method {method.key} ran off to infinity on these figures; use the method pgd")
    seconds = time.perf_counter() - started
    line = make_centreline3d(given.centreline, given.segments, solution)
    found = figures(line)
    if strict and solution.status == _CANNOT_BE_MET:
        raise UnmetTargetsError(solution.message)

    files, sentences = open_data_files(given, settings, about_errors)
    shown: Envelope | None = None
    change = given.gradient_change if gradient_change is None else gradient_change
    if band is not None or picture is not None:
        shown = _band(given, solution, change)
    where: NextElevation | None = None
    if band is not None and shown is not None:
        files[band] = envelope_table(shown)
        where = _advice(given, solution, line, change) if advice else None
    if picture is not None:
        from bobdesk.ui.plots.picture import draw_line

        files[picture] = draw_line(
            line, shown, in_scale(given.targets, solution.scale), title=_title(plan, found), kind=picture.suffix.lower()
        )
    if report is not None:
        off = deviations(found, given.asked)
        said = run_report(given, possible, solution, line, found, off, seconds)
        if where is not None:
            said["next_known_elevation"] = advice_report(given, solution, where)
        files[report] = to_json(said)
    files[output] = line_table(line, flavour=flavour)
    write_all(files)
    notes = _notes(possible, method, given.asked, settings.weights)
    missed = missed_targets(line, found, solution, given.targets)
    # Where the solver knows that a target cannot be met, its own sentence below says so.
    if missed and solution.status != _CANNOT_BE_MET:
        notes.append(f"the line of the method {method.key} does not meet the targets: {missed_text(missed)}")
    for note in notes:
        click.echo(f"note: {note}", err=True)
    _say(solution.message, found, output)
    if where is not None:
        click.echo(_advised(given, solution, where))
    for sentence in sentences:
        click.echo(sentence)


def _band(given: PlanInput, solution: Solution, change: float | None) -> Envelope:
    anchors = anchors_of(given.targets, given.centreline.length)
    if change is None:
        return envelope(solution.profile.stations, anchors, given.targets, scale=solution.scale)
    job = smooth_envelope(anchors, given.targets, largest_change=change, scale=solution.scale)
    band = with_progress(job, "the band")
    return between_stations(band, solution.scale * solution.profile.stations, largest_change=change)


def _advice(given: PlanInput, solution: Solution, line: Centreline3D, change: float | None) -> NextElevation:
    anchors = anchors_of(given.targets, given.centreline.length)
    estimate = (line.stations, line.elevations)
    job = next_elevation(anchors, given.targets, estimate=estimate, largest_change=change, scale=solution.scale)
    return with_progress(job, "where one more elevation helps")


def _advised(given: PlanInput, solution: Solution, advice: NextElevation) -> str:
    station = own_station(given, solution, advice)
    return (
        f"one more known elevation would help most at {station:.0f} m of the plan: smooth profiles that the data allow"
        f" spread by {advice.spread:.1f} m, with it by {advice.spread_after:.1f} m (root mean square), and the band,"
        f" {advice.band.mean_width:.1f} m wide on the mean, would be {advice.gain:.1f} m narrower"
    )


def _title(plan: Path, found: Figures) -> str:
    return (
        f"{plan.stem}: length {found.length:.2f} m, drop {found.drop:.2f} m, mean gradient"
        f" {100 * found.mean_gradient_drop_per_length:.2f} % (drop / length)"
    )


def _notes(possible: Feasibility, method: SolverMethod, targets: Targets, weights: Weights) -> list[str]:
    """Say what a user may think was heeded and was not."""
    said = (possible.doubt, possible.open_end) if possible.feasible else (possible.sentence,)
    notes = [sentence for sentence in said if sentence]
    if not method.holds_known and targets.known:
        notes.append(f"the method {method.key} has no known elevations; they were left out")
    if method.key == "pgd" and weights != Weights():
        notes.append("the weights are those of the published objective; the method pgd has none")
    return notes


def _say(message: str, found: Figures, output: Path) -> None:
    click.echo(
        f"length {found.length:.3f} m, drop {found.drop:.3f} m, mean gradient"
        f" {100 * found.mean_gradient_drop_per_length:.2f} % (drop / length), gradients from"
        f" {100 * found.min_gradient:.1f} % to {100 * found.max_gradient:.1f} %\n{message}\nwritten to {output}"
    )

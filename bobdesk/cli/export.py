"""`bobdesk export`: the result of a project as a file for other programs."""

from __future__ import annotations

from pathlib import Path

import click

from bobdesk.cli.options import FILE
from bobdesk.cli.reports import run_report
from bobdesk.cli.steps import PlanInput, to_json
from bobdesk.errors import InputError
from bobdesk.files.atomic import check_writable, write_atomic
from bobdesk.files.exporters.csv_flavours import FLAVOURS
from bobdesk.files.exporters.tables import line_table
from bobdesk.files.project_file import load_project
from bobdesk.project.derive_runs import run_centreline, run_deviations, run_line, run_solution, why_out_of_date
from bobdesk.project.project import Project
from bobdesk.project.runs import Run
from bobdesk.solve.feasibility import feasibility
from bobdesk.solve.targets import in_scale

_FORMATS = ("csv", "json")


@click.command("export")
@click.argument("project", type=FILE)
@click.option("-o", "--output", type=FILE, required=True, metavar="FILE", help="Where to write the result.")
@click.option(
    "--format",
    "kind",
    type=click.Choice(_FORMATS),
    help="csv: the 3D centreline, row by row. json: all figures. By the ending of FILE without it.",
)
@click.option(
    "--flavour",
    type=click.Choice(list(FLAVOURS)),
    default="default",
    show_default=True,
    help="How CSV is written.",
)
@click.option("--run", "wanted", metavar="NAME", help="Another run than the one that the project shows.")
def command(project: Path, output: Path, kind: str | None, flavour: str, wanted: str | None) -> None:
    """Write the result that PROJECT, a .bobdesk file, shows."""
    check_writable(output)
    opened = load_project(project)
    run = _run(opened, project, wanted)
    changed = why_out_of_date(opened, run)
    if changed is not None:
        click.echo(f"note: {project}: the result is out of date: {changed}", err=True)
    chosen = kind or ("json" if output.suffix.lower() == ".json" else "csv")
    try:
        content = to_json(_report(run)) if chosen == "json" else line_table(run_line(run), flavour=flavour)
    except InputError as error:
        raise InputError(f"{project}: {error}") from error
    write_atomic(output, content)
    click.echo(f"{run.name or 'the result'} written to {output}")


def _run(project: Project, path: Path, wanted: str | None) -> Run:
    if wanted is not None:
        found = [run for run in project.runs if run.name == wanted]
        if not found:
            names = ", ".join(run.name for run in project.runs) or "none"
            raise InputError(f"{path}: there is no run named {wanted}; there are {names}")
        return found[-1]
    if project.run is None:
        raise InputError(f"{path}: the project has no result yet; solve it first")
    return project.run


def _report(run: Run) -> dict[str, object]:
    inputs = run.inputs
    given = PlanInput(run_centreline(run), inputs.segments, inputs.targets, inputs.factor)
    possible = feasibility(given.centreline, given.segments, given.targets, inputs.settings.pgd)
    targets = in_scale(inputs.targets, 1 / inputs.factor)
    return run_report(
        given, targets, possible, run_solution(run), run_line(run), run.figures, run_deviations(run), run.seconds
    )

"""`bobdesk export`: the result of a project, or any 3D line, as a file for other programs."""

from __future__ import annotations

from pathlib import Path

import click

from bobdesk.cli.options import FILE
from bobdesk.cli.project_runs import shown_run
from bobdesk.cli.steps import check_outputs
from bobdesk.errors import InputError
from bobdesk.files.atomic import write_atomic
from bobdesk.files.exporters.csv_flavours import FLAVOURS
from bobdesk.files.exporters.formats import export_format_of, export_formats, export_line
from bobdesk.files.importers.line3d import read_line3d
from bobdesk.files.project_file import is_project, load_project
from bobdesk.plan.projection import Georeference
from bobdesk.project.derive_runs import run_georeference, run_line
from bobdesk.track.centreline3d import Centreline3D


@click.command("export")
@click.argument("project", type=FILE)
@click.option("-o", "--output", type=FILE, required=True, metavar="FILE", help="Where to write it.")
@click.option(
    "--format",
    "wanted",
    metavar="FORMAT",
    help="csv, json, geojson, kml, dxf, xodr, figures or a plug-in's; by the ending of FILE without it.",
)
@click.option(
    "--flavour",
    type=click.Choice(list(FLAVOURS)),
    default="default",
    show_default=True,
    help="How tables (csv, figures) are written.",
)
@click.option("--run", "run_name", metavar="NAME", help="Another run of the project than the one that it shows.")
def command(project: Path, output: Path, wanted: str | None, flavour: str, run_name: str | None) -> None:
    """Write the result that PROJECT, a .bobdesk file, shows.

    PROJECT may also be LINE.csv of `bobdesk reconstruct`, or any other line with elevations. geojson
    and kml need a line with its place on the Earth.
    """
    known = export_formats()
    for finding in known.findings:
        click.echo(f"note: {finding.sentence}", err=True)
    keys = [format.key for format in known.formats]
    if wanted is not None and wanted not in keys:
        raise click.UsageError(f"--format must be one of {', '.join(keys)}, not '{wanted}'")
    chosen = next((format for format in known.formats if format.key == wanted), None) or export_format_of(output)
    if flavour != "default" and not chosen.is_table:
        raise click.UsageError(f"--flavour is for tables; {chosen.title} has none")
    check_outputs([output], inputs=[project])
    line, georeference = _line_of(project, run_name)
    try:
        content = export_line(line, format=chosen.key, flavour=flavour, georeference=georeference)
    except InputError as error:
        raise InputError(f"{project}: {error}") from error
    write_atomic(output, content)
    click.echo(f"{chosen.title}, {len(line.stations):,} rows; written to {output}")


def _line_of(path: Path, run_name: str | None) -> tuple[Centreline3D, Georeference | None]:
    if is_project(path):
        project = load_project(path)
        run = shown_run(project, path, name=run_name)
        return run_line(run), run_georeference(project, run)
    if run_name is not None:
        raise click.UsageError(f"--run is for projects; {path} is none")
    found = read_line3d(path)
    for note in found.notes:
        click.echo(f"note: {path}: {note}", err=True)
    return found.line, found.georeference

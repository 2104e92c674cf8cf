"""`bobdesk export`: a 3D line in another format."""

from __future__ import annotations

from pathlib import Path

import click

from bobdesk.cli.options import FILE
from bobdesk.files.atomic import check_writable, write_atomic
from bobdesk.files.exporters.csv_flavours import FLAVOURS
from bobdesk.files.exporters.formats import export_format_of, export_formats, export_line
from bobdesk.files.importers.line3d import read_line3d


@click.command("export")
@click.argument("line", type=FILE)
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
def command(line: Path, output: Path, wanted: str | None, flavour: str) -> None:
    """Write LINE in another format: LINE.csv of `bobdesk reconstruct`, or any line with elevations.

    geojson and kml need a line with its place on the Earth.
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
    check_writable(output)
    found = read_line3d(line)
    for note in found.notes:
        click.echo(f"note: {line}: {note}", err=True)
    content = export_line(found.line, format=chosen.key, flavour=flavour, georeference=found.georeference)
    write_atomic(output, content)
    click.echo(f"{chosen.title}, {len(found.line.stations):,} rows; written to {output}")

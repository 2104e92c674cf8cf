"""A file as it would be written, made in the background."""

from __future__ import annotations

from dataclasses import dataclass

from bobdesk.errors import InputError
from bobdesk.files.exporters.formats import export_formats, export_line
from bobdesk.files.exporters.written import Totals, preview, written_totals
from bobdesk.project.project import Project


@dataclass(frozen=True, eq=False)
class Written:
    """A file's bytes, the text of their preview, the totals of their rows, and the bytes' ending."""

    content: bytes
    text: str
    totals: Totals | None
    extension: str


def inputs_of(project: Project) -> tuple[object, ...] | None:
    """Return what the file depends on."""
    return None if project.run is None else (project.run.layout, project.export)


def write(project: Project) -> Written:
    """Return the chosen run in the chosen format.

    Raises
    ------
    InputError
        If there is no run, or it cannot be written so.
    """
    from bobdesk.project.derive_runs import run_georeference, run_line

    if project.run is None:
        raise InputError("a result comes first: solve, then export it")
    choice = project.export
    chosen = next((known for known in export_formats().formats if known.key == choice.format), None)
    if chosen is None:
        raise InputError(f"this program has no format {choice.format[:40]}; choose another one")
    line = run_line(project.run, choice.spacing)
    content = export_line(
        line, format=choice.format, flavour=choice.flavour, georeference=run_georeference(project, project.run)
    )
    return Written(
        content, preview(content), written_totals(content, name="export" + chosen.extension), chosen.extension
    )

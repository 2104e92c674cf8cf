"""A project as the PLAN of a command: its line, without what it says of targets and segments."""

from __future__ import annotations

from pathlib import Path

from bobdesk.errors import InputError
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.project_file import load_project
from bobdesk.project import derive


def line_of_project(path: Path) -> ImportedLine:
    """Return the line of a project as if it had been read from a table.

    Raises
    ------
    InputError
        If the file cannot be used, or the project has no line in metres yet.
    """
    project = load_project(path)
    try:
        line = derive.polyline(project).needed()
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    notes = []
    if not derive.scale_is_known(project):
        notes.append("the scale of this project is unknown; --unknown-scale finds it")
    if project.segments is not None:
        notes.append("the segments that were set by hand in this project are not used here")
    return ImportedLine(line, None, tuple(notes))

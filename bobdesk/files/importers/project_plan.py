"""A project as a plan: its line, and with it all that the user decided."""

from __future__ import annotations

from bobdesk.errors import InputError
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.project_file import project_in
from bobdesk.project import derive


def read_project(data: bytes, *, name: str) -> ImportedLine:
    """Read the plan of a project: from start to finish, on the centreline, m.

    Raises
    ------
    InputError
        If the file cannot be used, or the project has no line in metres yet.
    """
    project = project_in(data, name=name)
    try:
        line = derive.polyline(project).needed()
    except InputError as error:
        raise InputError(f"{name}: {error}") from error
    return ImportedLine(line, None, (), derive.georeference(project), project.segments, project)

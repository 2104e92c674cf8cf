"""Which run of a project a command is about."""

from __future__ import annotations

from pathlib import Path

import click

from bobdesk.errors import InputError
from bobdesk.project.derive_runs import why_out_of_date
from bobdesk.project.project import Project
from bobdesk.project.runs import Run


def shown_run(project: Project, path: Path, *, name: str | None = None) -> Run:
    """Return the run that a project shows, or the last one of a name; say on stderr if it is out of date.

    Raises
    ------
    InputError
        If there is none.
    """
    run = project.run
    if name is not None:
        found = [each for each in project.runs if each.name == name]
        if not found:
            names = ", ".join(each.name for each in project.runs) or "none"
            raise InputError(f"{path}: there is no run named {name}; there are {names}")
        run = found[-1]
    if run is None:
        raise InputError(f"{path}: the project has no result yet; solve it first")
    changed = why_out_of_date(project, run)
    if changed is not None:
        click.echo(f"note: {path}: the result is out of date: {changed}", err=True)
    return run

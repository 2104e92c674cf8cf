"""What a user does to runs."""

from __future__ import annotations

import math
from dataclasses import replace

from bobdesk.errors import InputError
from bobdesk.project.project import ExportChoice, Project
from bobdesk.project.runs import Run


def keep_run(project: Project, run: Run) -> Project:
    """Add a finished run to the list, and show it."""
    return replace(project, runs=(*project.runs, run), chosen_run=len(project.runs))


def take_over_run(project: Project, run: Run) -> Project:
    """Keep a run that another method than the project's has made; that method is the project's from now on."""
    solver = replace(project.solver, method=run.inputs.settings.method)
    return keep_run(project if solver == project.solver else replace(project, solver=solver), run)


def choose_run(project: Project, index: int | None) -> Project:
    """Show another run, or none."""
    if index is not None:
        _check(project, index)
    return replace(project, chosen_run=index)


def name_run(project: Project, index: int, name: str) -> Project:
    """Rename a run."""
    _check(project, index)
    renamed = replace(project.runs[index], name=name.strip())
    return replace(project, runs=(*project.runs[:index], renamed, *project.runs[index + 1 :]))


def remove_run(project: Project, index: int) -> Project:
    """Take a run from the list; where it was shown, the one before it is."""
    _check(project, index)
    left = (*project.runs[:index], *project.runs[index + 1 :])
    chosen = project.chosen_run
    if chosen is not None and chosen >= index:
        chosen = max(chosen - 1, 0) if left else None
    return replace(project, runs=left, chosen_run=chosen)


def choose_export(project: Project, choice: ExportChoice) -> Project:
    """Remember how the result is exported."""
    if choice.spacing is not None and not (math.isfinite(choice.spacing) and 0.01 <= choice.spacing <= 1000):
        raise InputError(f"the rows must lie between 0.01 m and 1,000 m apart, not {choice.spacing:g} m")
    return project if choice == project.export else replace(project, export=choice)


def _check(project: Project, index: int) -> None:
    if not 0 <= index < len(project.runs):
        raise InputError(f"there is no run {index + 1}")

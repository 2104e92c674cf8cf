"""The plans of a study, and the tasks that they make with all that is varied."""

from __future__ import annotations

from collections.abc import Generator, Mapping, Sequence
from dataclasses import dataclass, replace

from bobdesk.errors import InputError
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.plan_input import PlanInput, plan_input
from bobdesk.progress import Progress
from bobdesk.project import derive
from bobdesk.project.project import Project
from bobdesk.sentences import counted
from bobdesk.solve.targets import KnownElevation, Targets, in_scale
from bobdesk.track.study import Cell, Task, Unready, task_of


@dataclass(frozen=True, eq=False)
class StudyPlan:
    """A plan with its targets, in its own scale.

    Attributes
    ----------
    name
        Different from all others; the first column of the rows.
    line
        As it was read.
    targets
        What every result must meet.
    """

    name: str
    line: ImportedLine
    targets: Targets


def plan_of_project(project: Project, name: str) -> StudyPlan:
    """Return an open project as a plan, equal to the one that its file gives.

    Raises
    ------
    InputError
        If it has no line in metres, or no targets.
    """
    line = derive.polyline(project).needed()
    found = ImportedLine(line, None, (), derive.georeference(project), project.segments, project)
    return StudyPlan(name, found, derive.targets(project).needed())


def study_tasks(
    plans: Sequence[StudyPlan],
    wanted: Sequence[Cell],
    sets: Mapping[str, tuple[KnownElevation, ...]],
    *,
    spacing: float | None = None,
    wavelength: float | None = None,
) -> Generator[Progress, None, tuple[Task | Unready, ...]]:
    """Fit the plans and find the segments of every count; returns the cells' tasks in their order.

    A plan that has not so many segments makes tasks that fail and say so.

    Parameters
    ----------
    wanted
        The cells, see `bobdesk.track.study.cells`.
    sets
        Known elevations by their name in the cells.
    spacing, wavelength
        Of the centreline; None for a project's own, or the usual ones.

    Raises
    ------
    InputError
        If no plan can be used.
    """
    by_name = {plan.name: plan for plan in plans}
    if len(by_name) < len(plans):
        raise InputError("two plans have the same name; the rows could not be told apart")
    ready: dict[tuple[str, int | None], PlanInput | InputError] = {}
    tasks: list[Task | Unready] = []
    for cell in wanted:
        key = (cell.plan, cell.count)
        if key not in ready:
            plan = by_name[cell.plan]
            segments = "automatic segments" if cell.count is None else counted(cell.count, "segment")
            yield Progress(0.0, f"{plan.name}, {segments}")
            try:
                ready[key] = plan_input(
                    plan.line, plan.targets, name=plan.name, spacing=spacing, wavelength=wavelength, count=cell.count
                )
            except InputError as error:
                ready[key] = error
        given = ready[key]
        tasks.append(Unready(cell, str(given)) if isinstance(given, InputError) else _task(cell, given, sets))
    problems = [found for found in ready.values() if isinstance(found, InputError)]
    if problems and len(problems) == len(ready):
        raise problems[0]
    return tuple(tasks)


def _task(cell: Cell, given: PlanInput, sets: Mapping[str, tuple[KnownElevation, ...]]) -> Task:
    known = in_scale(replace(given.targets, known=sets.get(cell.known, ())), given.factor).known
    return task_of(
        cell,
        given.centreline,
        given.segments,
        given.targets,
        given.solver,
        known=known,
        factor=given.factor,
        actual=given.actual,
    )

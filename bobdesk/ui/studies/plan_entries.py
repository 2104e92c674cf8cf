"""The plans of a study in the window: the open project, and files."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from bobdesk.errors import InputError
from bobdesk.project import derive
from bobdesk.project.project import Project
from bobdesk.solve.targets import Targets, check_targets
from bobdesk.ui.studies.study_choice import PlanFile

if TYPE_CHECKING:
    from bobdesk.files.importers.imported_line import ImportedLine
    from bobdesk.files.study_plans import StudyPlan


@dataclass(frozen=True, eq=False)
class PlanEntry:
    """A plan from a file.

    Attributes
    ----------
    path
        Of the file.
    line
        As it was read.
    length, drop
        Targets, m, of a plan that is no project; None until they are given.
    used
        Whether it is part of the study.
    """

    path: Path
    line: ImportedLine
    length: float | None
    drop: float | None
    used: bool = True

    @property
    def is_project(self) -> bool:
        """Whether the file brings its own targets."""
        return self.line.project is not None

    @property
    def remembered(self) -> PlanFile:
        """What is remembered of it."""
        own = self.is_project
        return PlanFile(str(self.path), None if own else self.length, None if own else self.drop, self.used)


def read_entry(file: PlanFile, project: Project) -> PlanEntry:
    """Read a file; targets that nobody has given are the line's own, or else the open project's.

    Raises
    ------
    InputError
        If the file cannot be used.
    """
    from bobdesk.files.importers.formats import read_line

    path = Path(file.path)
    line = read_line(path)
    length, drop = file.length, file.drop
    if line.project is not None:
        length, drop = line.project.targets.length, line.project.targets.drop
    elif length is None and drop is None:
        length, drop = _own_targets(line) or (project.targets.length, project.targets.drop)
    return PlanEntry(path, line, length, drop, file.used)


def _own_targets(line: ImportedLine) -> tuple[float, float] | None:
    """Return length and drop of a line that has elevations."""
    import numpy as np

    if line.elevations is None:
        return None
    points = np.column_stack([line.polyline.vertices, line.elevations])
    length = float(np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1)).sum())
    drop = float(points[0, 2] - points[:, 2].min())
    return (round(length, 2), round(drop, 2)) if 0 < drop < length else None


def study_plan(entry: PlanEntry | Project, name: str) -> StudyPlan:
    """Return a plan with its targets.

    Raises
    ------
    InputError
        If a target is missing, or there is no line.
    """
    from bobdesk.files.study_plans import StudyPlan, plan_of_project

    try:
        if isinstance(entry, Project):
            return plan_of_project(entry, name)
        return StudyPlan(name, entry.line, _targets(entry))
    except InputError as error:
        raise InputError(f"{name}: {error}") from error


def _targets(entry: PlanEntry) -> Targets:
    if entry.line.project is not None:
        return derive.targets(entry.line.project).needed()
    if entry.length is None or entry.drop is None:
        raise InputError("the length and the drop must be given")
    return check_targets(Targets(entry.length, entry.drop))


def named(entries: list[PlanEntry | Project], project_name: str) -> list[tuple[str, PlanEntry | Project]]:
    """Return the plans with a name each, all different."""
    found: dict[str, PlanEntry | Project] = {}
    for entry in entries:
        stem = entry.path.stem if isinstance(entry, PlanEntry) else project_name
        name, number = stem, 2
        while name in found:
            name, number = f"{stem} {number}", number + 1
        found[name] = entry
    return list(found.items())


def with_values(entry: PlanEntry, **values: object) -> PlanEntry:
    """Return an entry with other targets, or used or not."""
    return replace(entry, **values)  # type: ignore[arg-type]

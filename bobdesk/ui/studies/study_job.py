"""A study's work, from what was chosen to its rows; finished rows are kept in the user's data folder."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bobdesk import __version__
from bobdesk.errors import InputError
from bobdesk.files.atomic import reason
from bobdesk.files.processes import process_executor
from bobdesk.files.study_journal import StudyJournal, digest_of
from bobdesk.files.study_run import run_study
from bobdesk.progress import Progress
from bobdesk.project.project import Project
from bobdesk.ui.studies.plan_entries import PlanEntry, study_plan
from bobdesk.ui.studies.study_choice import Wanted

if TYPE_CHECKING:
    from bobdesk.files.study_journal import Row

_MOST_KEPT_STUDIES = 20


@dataclass(frozen=True, eq=False)
class StudyOrder:
    """What is to be solved.

    Attributes
    ----------
    plans
        With their names.
    wanted
        What is varied.
    workers
        Processes; 0 for as many as there are cores.
    folder
        Where the finished rows are kept.
    restart
        Whether kept rows are solved again.
    """

    plans: Sequence[tuple[str, PlanEntry | Project]]
    wanted: Wanted
    workers: int
    folder: Path
    restart: bool = False


def study_steps(order: StudyOrder) -> Generator[Progress, None, tuple[Row, ...]]:
    """Solve a study; yields `StudyProgress` once plans and segments are found.

    An interrupted study goes on where it stopped, by the same journal that the command keeps beside its table.

    Raises
    ------
    InputError
        If a plan cannot be used, or the rows cannot be kept.
    """
    import os

    from bobdesk.files.study_plans import study_tasks
    from bobdesk.track.study import cells

    yield Progress(0.0, "plans")
    plans = [study_plan(entry, name) for name, entry in order.plans]
    wanted = order.wanted
    asked = cells(
        [plan.name for plan in plans],
        wanted.counts,
        wanted.weights,
        [method.key for method in wanted.methods],
        list(wanted.sets),
        available=wanted.methods,
    )
    tasks = yield from study_tasks(plans, asked, wanted.sets)
    digest = digest_of(tasks, __version__)
    journal = StudyJournal(_table_in(order.folder, digest), digest)
    if order.restart:
        journal.remove()
    workers = order.workers or os.cpu_count() or 1
    with process_executor(min(workers, len(tasks))) as executor:
        # Few ahead: a study that rests shall rest.
        return (yield from run_study(tasks, executor, journal, ahead=workers + 1))


def _table_in(folder: Path, digest: str) -> Path:
    """Return where a study's table would lie, and forget the oldest of many studies."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        kept = sorted((path for path in folder.iterdir() if path.is_file()), key=_age, reverse=True)
        for path in kept[_MOST_KEPT_STUDIES - 1 :]:
            if not path.name.startswith(digest):
                path.unlink(missing_ok=True)
    except OSError as error:
        raise InputError(f"{folder}: finished rows cannot be kept there: {reason(error)}") from error
    return folder / f"{digest}.csv"


def _age(path: Path) -> Any:
    return path.stat().st_mtime

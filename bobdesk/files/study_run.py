"""Solve the cells of a study on several processes, or on a Dask cluster."""

from __future__ import annotations

import importlib
import time
from collections.abc import Generator, Iterator, Mapping, Sequence
from concurrent.futures import CancelledError, Executor, Future
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass, field

from bobdesk.errors import InputError
from bobdesk.files.processes import completed, workers_lost
from bobdesk.files.solvers import watched_methods
from bobdesk.files.study_journal import Row, StudyJournal
from bobdesk.progress import Progress
from bobdesk.track.study import STUDY_COLUMNS, Task, Unready, failed_row, solve_task

_DASK_WAITS = "10s"


@dataclass(frozen=True)
class StudyProgress(Progress):
    """How far a study is.

    Attributes
    ----------
    solved, total
        Cells.
    left
        Seconds that the others will take, as far as can be told; None before the first one is solved.
    rows
        Those that are new since the last step, by the number of their cell.
    """

    solved: int = 0
    total: int = 0
    left: float | None = None
    rows: Mapping[int, Row] = field(default_factory=dict)


def run_study(
    tasks: Sequence[Task | Unready], executor: Executor, journal: StudyJournal | None = None, *, ahead: int = 500
) -> Generator[StudyProgress, None, tuple[Row, ...]]:
    """Solve all tasks that the journal has not, and return the rows in the order of the tasks.

    Closing the generator starts no other; what becomes of those that are being solved is the executor's affair.

    Parameters
    ----------
    ahead
        How many cells are handed to the executor before the first of them is done: so many are still solved while
        nobody pulls.

    Raises
    ------
    InputError
        If the workers are lost, or the journal cannot be written.
    """
    rows: dict[int, Row] = {} if journal is None else journal.finished()
    rows = {number: row for number, row in rows.items() if 0 <= number < len(tasks) and len(row) == len(STUDY_COLUMNS)}
    kept = len(rows)
    worked = 0.0
    now = StudyProgress(kept / max(len(tasks), 1), f"{kept} of {len(tasks)} solved", kept, len(tasks), None, dict(rows))
    yield now
    since = time.monotonic()
    job = completed(
        solve_with_watched_methods,
        {number: task for number, task in enumerate(tasks) if number not in rows},
        executor,
        ahead=ahead,
    )
    try:
        for done in job:
            worked += time.monotonic() - since
            if done is None:
                now = StudyProgress(now.fraction, now.doing, now.solved, now.total, now.left)
            else:
                number, future = done
                rows[number] = _row(future, tasks[number])
                if journal is not None:
                    journal.add(number, rows[number])
                left = worked / (len(rows) - kept) * (len(tasks) - len(rows))
                said = f"{len(rows)} of {len(tasks)} solved, {_spoken(left)} left"
                now = StudyProgress(len(rows) / len(tasks), said, len(rows), len(tasks), left, {number: rows[number]})
            yield now
            # What passes while nobody pulls is a rest, and says nothing of how long a cell takes.
            since = time.monotonic()
    finally:
        job.close()
    return tuple(rows[number] for number in range(len(tasks)))


def solve_with_watched_methods(task: Task | Unready) -> Row:
    """Solve a task in a worker, which finds plug-ins itself."""
    return solve_task(task, watched_methods())


def _row(future: Future[Row], task: Task | Unready) -> Row:
    try:
        return tuple(future.result())
    except (BrokenProcessPool, CancelledError) as error:
        raise workers_lost() from error
    except Exception as error:  # noqa: BLE001 - whatever a worker raises belongs into its row
        segments = len(task.segments) if isinstance(task, Task) else None
        return failed_row(task.cell, f"{type(error).__name__}: {error}", segments=segments)


@contextmanager
def dask_executor(address: str) -> Iterator[Executor]:
    """Connect to the scheduler of a Dask cluster.

    Raises
    ------
    InputError
        If Dask is not installed or nobody answers at the address.
    """
    try:
        distributed = importlib.import_module("distributed")
        comm = importlib.import_module("distributed.comm")
    except ImportError as error:
        raise InputError("--dask needs the package distributed: install BobDesk with the extra [cluster]") from error
    try:
        # A client that is given an address of no kind waits for itself when it is thrown away, and complains.
        comm.resolve_address(address)
        client = distributed.Client(address, timeout=_DASK_WAITS, set_as_default=False)
    except (OSError, ValueError) as error:
        raise InputError(f"no Dask scheduler answers at {address}") from error
    try:
        executor: Executor = client.get_executor()
        yield executor
    finally:
        client.close()


def _spoken(seconds: float) -> str:
    if seconds < 90:
        return f"{seconds:.0f} s"
    if seconds < 5400:
        return f"{seconds / 60:.0f} min"
    return f"{seconds / 3600:.1f} h"

"""Solve the cells of a study on several processes, or on a Dask cluster."""

from __future__ import annotations

import importlib
import multiprocessing
import sys
import time
from collections.abc import Generator, Iterator, Sequence
from concurrent.futures import CancelledError, Executor, Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager

from bobdesk.errors import InputError
from bobdesk.files.solvers import watched_methods
from bobdesk.files.study_journal import Row, StudyJournal
from bobdesk.progress import Progress
from bobdesk.track.study import Task, failed_row, solve_task

_DASK_WAITS = "10s"
_MOST_ON_WINDOWS = 61  # it can wait for no more processes at once


def run_study(
    tasks: Sequence[Task], executor: Executor, journal: StudyJournal | None = None
) -> Generator[Progress, None, tuple[Row, ...]]:
    """Solve all tasks that the journal has not, and return the rows in the order of the tasks.

    Closing the generator lets those that are being solved end and starts no other.

    Raises
    ------
    InputError
        If the workers are lost, or the journal cannot be written.
    """
    rows: dict[int, Row] = {} if journal is None else journal.finished()
    kept = len(rows)
    started = time.monotonic()
    pending: dict[Future[Row], int] = {
        executor.submit(solve_with_watched_methods, task): number
        for number, task in enumerate(tasks)
        if number not in rows
    }
    try:
        yield Progress(kept / max(len(tasks), 1), f"{kept} of {len(tasks)} solved")
        for future in as_completed(pending):
            number = pending[future]
            rows[number] = _row(future, tasks[number])
            if journal is not None:
                journal.add(number, rows[number])
            each = (time.monotonic() - started) / (len(rows) - kept)
            left = _spoken(each * (len(tasks) - len(rows)))
            yield Progress(len(rows) / len(tasks), f"{len(rows)} of {len(tasks)} solved, {left} left")
    finally:
        for future in pending:
            future.cancel()
    return tuple(rows[number] for number in range(len(tasks)))


def solve_with_watched_methods(task: Task) -> Row:
    """Solve a task in a worker, which finds plug-ins itself."""
    return solve_task(task, watched_methods())


def _row(future: Future[Row], task: Task) -> Row:
    try:
        return tuple(future.result())
    except (BrokenProcessPool, CancelledError) as error:
        raise InputError("the workers of the study ended without being asked to; is there enough memory?") from error
    except Exception as error:  # noqa: BLE001 - whatever a worker raises belongs into its row
        return failed_row(task.cell, f"{type(error).__name__}: {error}", segments=len(task.segments))


@contextmanager
def process_executor(workers: int) -> Iterator[Executor]:
    """Start so many processes; leaving ends them, without waiting for cells that have not begun."""
    # A forked child would share threads' locks with the window.
    context = multiprocessing.get_context("spawn")
    if sys.platform == "win32":
        workers = min(workers, _MOST_ON_WINDOWS)
    executor = ProcessPoolExecutor(workers, mp_context=context)
    try:
        yield executor
    finally:
        executor.shutdown(wait=True, cancel_futures=True)


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
    except ImportError as error:
        raise InputError("--dask needs the package distributed: install BobDesk with the extra [cluster]") from error
    try:
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

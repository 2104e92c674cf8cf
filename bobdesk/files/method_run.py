"""All methods on one problem in a process of their own, so that even a search that never reports can be stopped."""

from __future__ import annotations

import time
from collections.abc import Generator, Sequence
from concurrent.futures import Executor, Future
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bobdesk.errors import InputError
from bobdesk.files.processes import completed, workers_lost
from bobdesk.files.solvers import watched_methods
from bobdesk.progress import Progress, finish
from bobdesk.project.record import IterateRecord
from bobdesk.project.runs import Run, RunInputs, finished_run

if TYPE_CHECKING:
    from bobdesk.project.runs import InputsDigest
    from bobdesk.track.method_comparison import MethodRow


@dataclass(frozen=True, eq=False)
class MethodResult:
    """A method's row, and the iterates that led to it."""

    row: MethodRow
    record: IterateRecord


@dataclass(frozen=True)
class MethodsProgress(Progress):
    """How far a comparison is.

    Attributes
    ----------
    results
        So far.
    at_work
        Title of the method that is at work.
    inputs
        The problem, in the first step.
    """

    results: tuple[MethodResult, ...] = ()
    at_work: str = ""
    inputs: RunInputs | None = None


def run_methods(
    inputs: RunInputs, executor: Executor, *, titles: Sequence[tuple[str, str]]
) -> Generator[MethodsProgress, None, tuple[MethodResult, ...]]:
    """Have one method after the other solve a problem, each with the computer to itself.

    Parameters
    ----------
    inputs
        The problem; which method its settings name does not matter.
    executor
        Of one worker.
    titles
        Key and title of the methods.

    Raises
    ------
    InputError
        If the worker is lost, or the plan cannot be used.
    """
    results: list[MethodResult] = []
    tasks = {number: (inputs, key) for number, (key, _) in enumerate(titles)}
    job = completed(solve_by_method, tasks, executor, ahead=1)
    try:
        yield replace(_progress(results, titles), inputs=inputs)
        for done in job:
            if done is not None:
                results.append(_result(done[1], *titles[done[0]]))
            yield _progress(results, titles)
    finally:
        job.close()
    return tuple(results)


def _result(future: Future[MethodResult], key: str, title: str) -> MethodResult:
    from bobdesk.track.method_comparison import failed_method

    try:
        return future.result()
    except BrokenProcessPool as error:
        raise workers_lost() from error
    except Exception as error:  # noqa: BLE001 - whatever a method raises belongs into its row
        return MethodResult(failed_method(key, title, f"{type(error).__name__}: {error}"), IterateRecord())


def _progress(results: Sequence[MethodResult], titles: Sequence[tuple[str, str]]) -> MethodsProgress:
    title = titles[len(results)][1] if len(results) < len(titles) else ""
    return MethodsProgress(len(results) / len(titles), title, tuple(results), title)


def solve_by_method(task: tuple[RunInputs, str]) -> MethodResult:
    """Solve a problem by the method with a key, in a worker, which finds plug-ins itself."""
    # What is loaded when a method first needs it must not count as the time that it takes.
    import bobdesk.solve.pgd
    import bobdesk.solve.published
    import bobdesk.solve.second_opinions  # noqa: F401
    from bobdesk.alignment.centreline import fit_centreline
    from bobdesk.track.method_comparison import compare_methods

    inputs, key = task
    methods = tuple(method for method in watched_methods() if method.key == key)
    if not methods:
        raise InputError(f"there is no method '{key}'")
    record = IterateRecord(inputs.targets.length)
    (row,) = finish(
        compare_methods(
            fit_centreline(inputs.polyline, inputs.fit),
            inputs.segments,
            inputs.targets,
            inputs.settings,
            clock=time.perf_counter,
            methods=methods,
            seen=record.append,
        )
    )
    return MethodResult(row, record)


def run_of(result: MethodResult, inputs: RunInputs, *, digest: InputsDigest, name: str, target_set: str) -> Run:
    """Return the run that a method's result is, as if the project had been solved by it.

    Raises
    ------
    InputError
        If the method failed.
    """
    row = result.row
    if row.solution is None or row.found is None:
        raise InputError(f"{row.title} has no result")
    return finished_run(
        replace(inputs, settings=replace(inputs.settings, method=row.method)),
        row.solution,
        row.found,
        result.record,
        digest=digest,
        name=name,
        target_set=target_set,
        seconds=row.seconds,
    )

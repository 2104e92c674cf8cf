"""A run of a project, from what the user decided to the finished run, as a generator of iterates."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import replace
from typing import TYPE_CHECKING

from bobdesk.errors import InputError, SolverFaultError, TargetError
from bobdesk.project import derive
from bobdesk.project.derive_runs import warm_start
from bobdesk.project.digest import inputs_digest
from bobdesk.project.project import Project
from bobdesk.project.record import IterateRecord
from bobdesk.project.runs import Run, RunInputs, finished_run
from bobdesk.sentences import counted
from bobdesk.solve.called_back import StoppedWithinError
from bobdesk.solve.run import METHODS, SolverMethod, solve

if TYPE_CHECKING:
    from bobdesk.solve.iterates import Iterate, Solution

_STOPPED = 1
_BY_HAND = "Stopped by hand"


def _never() -> bool:
    return False


def new_run(
    project: Project,
    *,
    name: str,
    clock: Callable[[], float],
    record: IterateRecord | None = None,
    enough: Callable[[], bool] = _never,
    asked: Callable[[], bool] = _never,
    methods: tuple[SolverMethod, ...] = METHODS,
) -> Generator[Iterate, None, Run]:
    """Solve a project with its own settings.

    A solver that fails after its first iterate ends the run with its best iterate, and the run says why.

    Parameters
    ----------
    name
        What the run is called.
    clock
        Returns seconds; the time that the solver itself took is kept with the run.
    record
        Is given every iterate as it comes.
    enough
        Asked after every iterate: whether to end with the best one so far.
    asked
        The same question, asked by methods that compute long between two iterates while they do, on any thread. It may
        take its time.
    methods
        Those that there are.

    Raises
    ------
    InputError
        If something is missing, or the result is no number.
    TargetError
        If limits, drop and known elevations contradict each other.
    """
    from bobdesk.track.centreline3d import make_centreline3d
    from bobdesk.track.figures import figures

    inputs = derive.run_inputs(project).needed()
    line = derive.centreline(project).needed()
    record = IterateRecord(inputs.targets.length) if record is None else record
    seconds = 0.0
    job = solve(
        line,
        inputs.segments,
        inputs.targets,
        inputs.settings,
        methods=methods,
        warm=warm_start(project),
        asked=asked,
    )
    while True:
        began = clock()
        try:
            iterate = next(job)
        except StopIteration as end:
            solution = end.value
            seconds += clock() - began
            break
        except SolverFaultError as error:
            if record.best is None:
                raise
            seconds += clock() - began
            solution = _ended_early(inputs, record, f"{str(error)[0].upper()}{str(error)[1:]},")
            break
        except (InputError, TargetError):
            raise
        except StoppedWithinError:
            seconds += clock() - began
            solution = _ended_early(inputs, record, _BY_HAND)
            break
        except Exception as error:  # noqa: BLE001 - what was found until then is worth more than the fault
            seconds += clock() - began
            why = f"{type(error).__name__}: {' '.join(str(error).split())[:200]}".removesuffix(": ")
            solution = _ended_early(inputs, record, f"The solver failed ({why})")
            break
        record.append(iterate)
        seconds += clock() - began
        yield iterate
        if enough():
            job.close()
            solution = _ended_early(inputs, record, _BY_HAND)
            break
    return finished_run(
        inputs,
        solution,
        figures(make_centreline3d(line, inputs.segments, solution)),
        record,
        digest=inputs_digest(project),
        name=name,
        target_set=project.targets.name,
        seconds=seconds,
    )


def _ended_early(inputs: RunInputs, record: IterateRecord, why: str) -> Solution:
    """Return the end of a run that has come no further than its best iterate."""
    best = record.best
    if best is None:
        raise InputError(f"{why[0].lower()}{why[1:]} before its first iterate")
    # The best may lie behind the last: all that were made count, and the iterate where it began is number 0.
    made = record.count - 1
    why = f"{why} after {counted(made, 'iteration')}; the best so far is kept."
    return replace(solution_at(inputs, best, status=_STOPPED, message=why), nit=made)


def solution_at(inputs: RunInputs, iterate: Iterate, *, status: int = _STOPPED, message: str = "") -> Solution:
    """Return an iterate as if the run had ended there."""
    from bobdesk.solve.iterates import Solution

    if iterate.profile is None or iterate.edge_gradients is None:
        raise InputError("an iterate of this method has no line")
    return Solution(
        method=inputs.settings.method,
        profile=iterate.profile,
        gradients=iterate.gradients,
        edge_gradients=iterate.edge_gradients,
        scale=iterate.scale,
        start_elevation=inputs.targets.drop,
        status=status,
        message=message,
        nit=iterate.number,
        nfev=iterate.number,
        njev=iterate.number,
        objective=iterate.objective,
        optimality=iterate.optimality,
    )

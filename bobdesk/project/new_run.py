"""A run of a project, from what it says now to the `Run` that is kept: a generator of iterates."""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import TYPE_CHECKING

from bobdesk.project import derive
from bobdesk.project.digest import inputs_digest
from bobdesk.project.project import Project
from bobdesk.project.runs import Run, finished_run

if TYPE_CHECKING:
    from bobdesk.solve.iterates import Iterate


def new_run(project: Project, *, name: str, clock: Callable[[], float]) -> Generator[Iterate, None, Run]:
    """Solve a project with its own settings.

    Parameters
    ----------
    name
        What the run is called.
    clock
        Returns seconds; the time that the solver itself took is kept with the run.

    Raises
    ------
    InputError
        If something is missing, or the result is no number.
    TargetError
        If limits, drop and known elevations contradict each other.
    """
    from bobdesk.solve.run import solve
    from bobdesk.track.centreline3d import make_centreline3d
    from bobdesk.track.figures import figures

    inputs = derive.run_inputs(project).needed()
    line = derive.centreline(project).needed()
    iterates: list[Iterate] = []
    seconds = 0.0
    job = solve(line, inputs.segments, inputs.targets, inputs.settings)
    while True:
        began = clock()
        try:
            iterate = next(job)
        except StopIteration as end:
            solution = end.value
            seconds += clock() - began
            break
        seconds += clock() - began
        iterates.append(iterate)
        yield iterate
    return finished_run(
        inputs,
        solution,
        figures(make_centreline3d(line, inputs.segments, solution)),
        iterates,
        digest=inputs_digest(project),
        name=name,
        target_set=project.targets.name,
        seconds=seconds,
    )

"""All methods on the same plan and targets, one row each: how far each came on the published objective."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.errors import InputError, TargetError
from bobdesk.progress import Progress
from bobdesk.solve.iterates import Iterate, Solution
from bobdesk.solve.objective import PublishedObjective
from bobdesk.solve.run import METHODS, SolverMethod, solve
from bobdesk.solve.settings import SolverSettings, Weights
from bobdesk.solve.targets import Targets
from bobdesk.track.centreline3d import Centreline3D, make_centreline3d
from bobdesk.track.figures import Deviations, Figures, deviations, figures
from bobdesk.track.missed import Miss, missed_targets

_ITERATES_A_REPORT = 10
_RISES_SHARE = 0.01
Verdict = Literal["met", "not met", "failed"]


@dataclass(frozen=True, eq=False)
class MethodRow:
    """What one method made of it.

    Attributes
    ----------
    method, title
        Its key, and what a person calls it.
    objective
        J of the published objective with the weights of the settings, whatever the method itself minimises;
        NaN where it failed.
    solution, line, found, off
        Its end, the line, its figures and their deviations from the targets; None where it failed.
    iterations, evaluations, seconds
        What it took.
    message
        Why it ended as its solver sees it, one sentence; of the targets that says nothing.
    missed
        The targets that the line misses.
    counted_drop
        The height difference as J counts it, m: the sum of all rises and falls. NaN where it failed.
    """

    method: str
    title: str
    objective: float
    solution: Solution | None
    line: Centreline3D | None
    found: Figures | None
    off: Deviations | None
    iterations: int
    evaluations: int
    seconds: float
    message: str
    missed: tuple[Miss, ...] = ()
    counted_drop: float = math.nan

    @property
    def verdict(self) -> Verdict:
        """Whether the line meets the targets."""
        return "failed" if self.found is None else "not met" if self.missed else "met"

    @property
    def has_rises_in_objective(self) -> bool:
        """Whether much of the height difference in J are rises: J is then no measure of the drop."""
        return self.found is not None and self.counted_drop > (1 + _RISES_SHARE) * self.found.drop


def compare_methods(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: SolverSettings,
    *,
    clock: Callable[[], float],
    methods: Sequence[SolverMethod] = METHODS,
    seen: Callable[[Iterate], object] | None = None,
) -> Generator[Progress, None, tuple[MethodRow, ...]]:
    """Run one method after the other; a method that fails is a row with its reason.

    Parameters
    ----------
    settings
        For all methods; the method that they name does not matter.
    clock
        Seconds from anywhere; this package reads no clock itself.
    seen
        Is given every iterate as it comes.
    """
    rows: list[MethodRow] = []
    for number, method in enumerate(methods):
        progress = Progress(number / len(methods), method.title)
        yield progress
        started = clock()
        run = solve(centreline, segments, targets, replace(settings, method=method.key), methods=tuple(methods))
        iterates = 0
        try:
            while True:
                # A method that runs off to infinity says so in its row, not on the terminal.
                with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
                    iterate = next(run)
                if seen is not None:
                    seen(iterate)
                iterates += 1
                if iterates % _ITERATES_A_REPORT == 0:
                    yield progress
        except StopIteration as end:
            rows.append(_row(method, end.value, centreline, segments, targets, settings.weights, clock() - started))
        except (InputError, TargetError) as error:
            rows.append(_failed(method, max(iterates - 1, 0), 0, clock() - started, str(error)))
    return tuple(rows)


def published_value(solution: Solution, targets: Targets, weights: Weights) -> float:
    """Return J of the published objective for a method's end, on that method's own rows and pieces."""
    objective = PublishedObjective(solution.profile, targets, weights)
    return objective.value(solution.gradients, solution.scale)


def _row(
    method: SolverMethod,
    solution: Solution,
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    weights: Weights,
    seconds: float,
) -> MethodRow:
    if not np.isfinite([solution.scale, *solution.gradients]).all():
        return _failed(method, solution.nit, solution.nfev, seconds, "ran off to infinity")
    line = make_centreline3d(centreline, segments, solution)
    found = figures(line)
    objective = PublishedObjective(solution.profile, targets, weights)
    value, terms = objective.value_and_terms(solution.gradients, solution.scale)
    return MethodRow(
        method.key,
        method.title,
        value,
        solution,
        line,
        found,
        deviations(found, targets),
        solution.nit,
        solution.nfev,
        seconds,
        solution.message,
        missed_targets(line, found, solution, targets),
        targets.drop - terms.height,
    )


def _failed(method: SolverMethod, iterations: int, evaluations: int, seconds: float, why: str) -> MethodRow:
    row = failed_method(method.key, method.title, why)
    return replace(row, iterations=iterations, evaluations=evaluations, seconds=seconds)


def failed_method(key: str, title: str, why: str) -> MethodRow:
    """Return the row of a method that could not even begin."""
    sentence = f"Failed: {' '.join(why.split()).rstrip('.')}."
    return MethodRow(key, title, math.nan, None, None, None, None, 0, 0, 0.0, sentence)

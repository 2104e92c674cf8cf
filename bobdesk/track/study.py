"""A study: one plan solved in many ways, a cell for each, and what came out as a row of text."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError, TargetError
from bobdesk.progress import finish
from bobdesk.solve.run import METHODS, SolverMethod, method_named, solve
from bobdesk.solve.settings import SolverSettings
from bobdesk.solve.targets import KnownElevation, Targets
from bobdesk.track.centreline3d import make_centreline3d
from bobdesk.track.comparison import compare
from bobdesk.track.figures import deviations, figures
from bobdesk.track.method_comparison import published_value
from bobdesk.track.missed import missed_targets, missed_text

STUDY_COLUMNS = (
    "plan",
    "wanted_segments",
    "segments",
    "height_weight",
    "method",
    "known",
    "length_m",
    "drop_m",
    "mean_gradient_drop_per_length",
    "mean_gradient_segments",
    "max_gradient",
    "mean_curvature_difference_per_m",
    "length_percent",
    "drop_percent",
    "mean_gradient_percent",
    "z_rms_m",
    "objective",
    "scale",
    "iterations",
    "evaluations",
    "status",
    "missed",
    "message",
)
FAILED = "failed"


@dataclass(frozen=True)
class Cell:
    """One way to solve a plan.

    Attributes
    ----------
    plan
        Its name.
    count
        Wanted number of segments, or None for those that are found, or the plan's own.
    height_weight
        b of the published objective; None for methods that have none.
    method
        Key.
    known
        Name of the set of known elevations; "" for methods that hold none.
    """

    plan: str
    count: int | None
    height_weight: float | None
    method: str
    known: str

    @property
    def key(self) -> tuple[str, ...]:
        """The first columns of the row."""
        count = "" if self.count is None else str(self.count)
        weight = "" if self.height_weight is None else f"{self.height_weight:g}"
        return (self.plan, count, weight, self.method, self.known)


@dataclass(frozen=True, eq=False)
class Task:
    """All that a worker needs to solve a cell.

    Attributes
    ----------
    cell
        Its names.
    centreline, segments, targets
        In one scale; the targets with the cell's known elevations.
    settings
        With the cell's method and weight.
    factor
        By which the plan was multiplied beforehand; 1 where its scale is known.
    actual : (n, 3) or None
        The actual track, m, where it is known.
    """

    cell: Cell
    centreline: Centreline
    segments: Segments
    targets: Targets
    settings: SolverSettings
    factor: float = 1.0
    actual: FloatArray | None = None


@dataclass(frozen=True)
class Unready:
    """A cell that cannot even be begun, and why: its plan has no such number of segments."""

    cell: Cell
    problem: str


def cells(
    plans: Sequence[str],
    counts: Sequence[int | None],
    height_weights: Sequence[float],
    methods: Sequence[str],
    known_sets: Sequence[str],
    *,
    available: Sequence[SolverMethod] = METHODS,
) -> tuple[Cell, ...]:
    """Return every combination once: what a method does not know is no reason to solve twice."""
    found: dict[Cell, None] = {}
    for plan in plans:
        for count in counts:
            for name in methods:
                method = method_named(name, tuple(available))
                for weight in height_weights if method.key != "pgd" else (None,):
                    for known in known_sets if method.holds_known else ("",):
                        found[Cell(plan, count, weight, method.key, known)] = None
    return tuple(found)


def task_of(
    cell: Cell,
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: SolverSettings,
    *,
    known: tuple[KnownElevation, ...] = (),
    factor: float = 1.0,
    actual: FloatArray | None = None,
) -> Task:
    """Return a cell with its targets and settings; `known` is added to the known elevations of the targets."""
    weights = settings.weights
    if cell.height_weight is not None:
        weights = replace(weights, height=cell.height_weight)
    chosen = replace(settings, method=cell.method, weights=weights)
    return Task(cell, centreline, segments, replace(targets, known=(*targets.known, *known)), chosen, factor, actual)


def solve_task(task: Task | Unready, methods: tuple[SolverMethod, ...] = METHODS) -> tuple[str, ...]:
    """Solve a cell and return its row, as text; a cell that fails is a row with its reason."""
    if isinstance(task, Unready):
        return failed_row(task.cell, task.problem)
    try:
        # What runs off to infinity fails below, and needs no warning on a terminal.
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            return _solved(task, methods)
    except (InputError, TargetError) as error:
        why = str(error)
    except (ArithmeticError, ValueError, MemoryError) as error:
        why = f"{type(error).__name__}: {error}"
    return failed_row(task.cell, why, segments=len(task.segments))


def failed_row(cell: Cell, why: str, *, segments: int | None = None) -> tuple[str, ...]:
    """Return the row of a cell that could not be solved."""
    count = "" if segments is None else str(segments)
    empty = [""] * (len(STUDY_COLUMNS) - len(cell.key) - 4)
    return (cell.key[0], cell.key[1], count, *cell.key[2:], *empty, FAILED, "", " ".join(why.split()))


def percent_text(value: float) -> str:
    """Return a deviation, %, as tables have it: what rounds to nothing has no sign."""
    return f"{round(value, 6) + 0.0:.6f}"


def _solved(task: Task, methods: tuple[SolverMethod, ...]) -> tuple[str, ...]:
    solution = finish(solve(task.centreline, task.segments, task.targets, task.settings, methods=methods))
    if not np.isfinite([solution.objective, solution.scale, *solution.gradients]).all():
        raise InputError("ran off to infinity")
    line = make_centreline3d(task.centreline, task.segments, solution)
    found = figures(line)
    off = deviations(found, task.targets)
    missed = missed_targets(line, found, solution, task.targets)
    z_rms = "" if task.actual is None else f"{compare(line.points, task.actual).z_rms:.4f}"
    return (
        *task.cell.key[:2],
        str(len(task.segments)),
        *task.cell.key[2:],
        f"{found.length:.4f}",
        f"{found.drop:.4f}",
        f"{found.mean_gradient_drop_per_length:.6f}",
        f"{found.mean_gradient_segments:.6f}",
        f"{found.max_gradient:.6f}",
        f"{found.mean_curvature_difference:.8f}",
        percent_text(off.length),
        percent_text(off.drop),
        "" if off.mean_gradient is None else percent_text(off.mean_gradient),
        z_rms,
        f"{published_value(solution, task.targets, task.settings.weights):.6g}",
        f"{solution.scale * task.factor:.6f}",
        str(solution.nit),
        str(solution.nfev),
        "not met" if missed else "met",
        missed_text(missed),
        solution.message,
    )

"""A finished run: what it was given, what it found, and how it got there."""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np

from bobdesk.alignment.fit_settings import FitSettings
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray, frozen
from bobdesk.errors import InputError
from bobdesk.plan.polyline import Polyline
from bobdesk.project.kept_iterates import KeptIterates, kept_iterates
from bobdesk.project.layout import Layout, layout_of
from bobdesk.project.record import COLUMNS, IterateRecord
from bobdesk.solve.iterates import Solution
from bobdesk.solve.settings import SolverSettings
from bobdesk.solve.targets import Targets
from bobdesk.track.figures import Figures

MOST_HISTORY_ROWS = 2000
HISTORY_COLUMNS = COLUMNS


@dataclass(frozen=True)
class InputsDigest:
    """A digest for each kind of thing that a run depends on, so that what changed can be named."""

    plan: str
    fit: str
    segments: str
    targets: str
    solver: str


@dataclass(frozen=True, eq=False)
class RunInputs:
    """What a run is given: enough to draw its line again when the project has gone on.

    Attributes
    ----------
    polyline
        The plan, m; one of unknown scale is brought near true size first.
    factor
        By which it was multiplied for that; 1 where its scale is known.
    fit, segments, targets, settings
        The targets' known elevations count in the same scale as the polyline.
    """

    polyline: Polyline
    factor: float
    fit: FitSettings
    segments: Segments
    targets: Targets
    settings: SolverSettings


@dataclass(frozen=True, eq=False)
class Run:
    """A finished run.

    Attributes
    ----------
    name
        What the user calls it.
    digest
        Of the project's inputs when it was started; another one now means that it is out of date.
    target_set
        Name of the targets it was made for.
    inputs, layout
        What it was given, and the pieces it solved for.
    gradients, edge_gradients, scale, start_elevation, status, message, nit, nfev, njev, objective, optimality
        As in `bobdesk.solve.iterates.Solution`; `objective` and `optimality` are None
        where they are no numbers.
    figures
        Of the line.
    seconds
        How long it took.
    stages
        Names of the stages, which the history's second column counts.
    history : (k, 8)
        `HISTORY_COLUMNS` of the iterates, at most 2,000 of them.
    iterates
        Some of them whole; None for a run of an older file.
    """

    name: str
    digest: InputsDigest
    target_set: str
    inputs: RunInputs
    layout: Layout
    gradients: FloatArray
    edge_gradients: FloatArray
    scale: float
    start_elevation: float
    status: int
    message: str
    nit: int
    nfev: int
    njev: int
    objective: float | None
    optimality: float | None
    figures: Figures
    seconds: float
    stages: tuple[str, ...]
    history: FloatArray
    iterates: KeptIterates | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "gradients", frozen(self.gradients))
        object.__setattr__(self, "edge_gradients", frozen(self.edge_gradients))
        object.__setattr__(self, "history", frozen(self.history, columns=len(HISTORY_COLUMNS)))


def finished_run(
    inputs: RunInputs,
    solution: Solution,
    figures: Figures,
    record: IterateRecord,
    *,
    digest: InputsDigest,
    name: str,
    target_set: str,
    seconds: float,
) -> Run:
    """Return the run that a solver's end and the record of its iterates make.

    Raises
    ------
    InputError
        If it ended in figures that are no numbers.
    """
    profile = solution.profile
    if not all(
        np.isfinite(part).all() for part in (solution.gradients, solution.scale, list(asdict(figures).values()))
    ):
        raise InputError("the run ended in figures that are no numbers; it cannot be kept")
    return Run(
        name=name,
        digest=digest,
        target_set=target_set,
        inputs=inputs,
        layout=layout_of(profile),
        gradients=solution.gradients,
        edge_gradients=solution.edge_gradients,
        scale=float(solution.scale),
        start_elevation=float(solution.start_elevation),
        status=int(solution.status),
        message=solution.message,
        nit=int(solution.nit),
        nfev=int(solution.nfev),
        njev=int(solution.njev),
        objective=_number(solution.objective),
        optimality=_number(solution.optimality),
        figures=figures,
        seconds=seconds,
        stages=record.stages,
        history=thinned_history(record.rows()),
        iterates=kept_iterates(record),
    )


def _number(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def thinned_history(rows: FloatArray) -> FloatArray:
    """Return the iterates' figures (n, 8) as they are kept: of more than 2,000, an even choice with both ends."""
    if len(rows) <= MOST_HISTORY_ROWS:
        return rows
    chosen: FloatArray = rows[np.linspace(0, len(rows) - 1, MOST_HISTORY_ROWS).round().astype(int)]
    return chosen

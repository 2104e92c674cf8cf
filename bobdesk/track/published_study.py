"""The published tables made again: the paper's figures, and what our two methods make of the same targets."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.errors import InputError, TargetError
from bobdesk.progress import Progress, finish
from bobdesk.solve.problem import mean_shares
from bobdesk.solve.run import solve
from bobdesk.solve.settings import PgdSettings, SolverSettings, Weights
from bobdesk.solve.targets import Targets
from bobdesk.track.centreline3d import make_centreline3d
from bobdesk.track.figures import Figures, figures
from bobdesk.track.stand_in import resized, stand_in

METHODS = ("published", "pgd")
_TABLE_2_SCALE = 0.9


@dataclass(frozen=True)
class PublishedFigures:
    """A row of the paper: what it calls total length, height difference, curvature difference and slopes."""

    length: float
    drop: float
    curvature_difference: float | None
    max_gradient: float
    mean_gradient: float


@dataclass(frozen=True)
class PublishedRow:
    """A generated track of the paper.

    Attributes
    ----------
    table, track
        Where it stands.
    segments, height_weight
        What was varied; those of table 1 are the ones that the other tables show the same figures for.
    actual, generated
        The paper's figures of the real and of the generated track.
    scaled
        Whether the plan had no scale.
    """

    table: str
    track: str
    segments: int
    height_weight: float
    actual: PublishedFigures
    generated: PublishedFigures
    scaled: bool


@dataclass(frozen=True)
class Remade:
    """What one of our methods makes of a row: its figures, mean over the segments' gradients and factor f.

    Or why it failed; then `found` is None.
    """

    method: str
    found: Figures | None
    mean_gradient: float
    scale: float
    message: str


@dataclass(frozen=True)
class ComparedRow:
    """A row of the paper beside ours.

    Attributes
    ----------
    row
        The paper's.
    plan
        Plan length that was used, m: of the drawing, where the scale is unknown.
    ours
        One a method.
    """

    row: PublishedRow
    plan: float
    ours: tuple[Remade, ...]


@dataclass(frozen=True)
class RemakeProgress(Progress):
    """How far it is, with the rows so far."""

    rows: tuple[ComparedRow, ...] = ()


PlanSource = Callable[[int], tuple[Centreline, Segments]]


def plan_length_of(figures_: PublishedFigures) -> float:
    """Return the plan length that a generated track's own figures belong to, m.

    An even gradient makes D sqrt(1 + g²) of D; a gradient that swings by r about it adds D r² / 2. The
    published figures say the largest and the mean gradient alone: r is taken as half of their difference.
    """
    swing = 0.5 * (figures_.max_gradient - figures_.mean_gradient)
    return math.sqrt(figures_.length**2 - figures_.drop**2) / (1 + 0.5 * swing**2)


def remake(
    rows: Sequence[PublishedRow], plans: dict[str, PlanSource]
) -> Generator[RemakeProgress, None, tuple[ComparedRow, ...]]:
    """Solve every row by the published method and by ours.

    Parameters
    ----------
    plans
        Real plans by track, as a function of the number of segments; the others get a stand-in whose plan
        length is the one of the row.
    """
    found: list[ComparedRow] = []
    for number, row in enumerate(rows):
        yield RemakeProgress(number / len(rows), f"{row.track}, {row.table}", tuple(found))
        if row.track in plans:
            centreline, segments = plans[row.track](row.segments)
        else:
            centreline, segments = stand_in(plan_length_of(row.generated), row.segments)
        if row.scaled:
            centreline = resized(centreline, _TABLE_2_SCALE * centreline.length)
            segments = tuple(
                replace(each, start=_TABLE_2_SCALE * each.start, end=_TABLE_2_SCALE * each.end) for each in segments
            )
        ours = tuple(_remade(method, row, centreline, segments) for method in METHODS)
        found.append(ComparedRow(row, centreline.length, ours))
    return tuple(found)


def _remade(method: str, row: PublishedRow, centreline: Centreline, segments: Segments) -> Remade:
    """Solve with the actual track's figures as targets; the mean gradient is that of the segments, as published.

    Without transitions and divided segments, so that a gradient is one of a segment in both methods.
    """
    targets = Targets(
        row.actual.length,
        row.actual.drop,
        row.actual.mean_gradient,
        "segments",
        unknown_scale=row.scaled,
    )
    settings = SolverSettings(
        method=method,
        weights=Weights(height=row.height_weight),
        pgd=PgdSettings(transition=0.0, level_out=0.0, longest_piece=centreline.length),
    )
    try:
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            solution = finish(solve(centreline, segments, targets, settings))
            if not np.isfinite([solution.scale, *solution.gradients]).all():
                return Remade(method, None, math.nan, math.nan, "ran off to infinity")
            line = make_centreline3d(centreline, segments, solution)
    except (InputError, TargetError) as error:
        return Remade(method, None, math.nan, math.nan, str(error))
    found = figures(line)
    mean = found.mean_gradient_segments
    if method == "published":
        # Of the gradients themselves, as the paper has them: boundaries between two rows blur those of a line.
        mean = float(mean_shares(solution.profile) @ solution.gradients)
    return Remade(method, found, mean, solution.scale, solution.message)

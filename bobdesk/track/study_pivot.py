"""The rows of a study in two ways: as a table of two axes, and as curves over one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from bobdesk.track.study import FAILED, STUDY_COLUMNS
from bobdesk.track.study_choices import AUTOMATIC, NO_SET

AXES = ("plan", "segments", "height_weight", "method", "known")
FIGURES = (
    "length_percent",
    "drop_percent",
    "mean_gradient_percent",
    "z_rms_m",
    "max_gradient",
    "mean_curvature_difference_per_m",
    "objective",
    "scale",
    "iterations",
    "evaluations",
)
_AT = {name: index for index, name in enumerate(STUDY_COLUMNS)}
_NUMERIC = ("segments", "height_weight")
Row = Sequence[str]


@dataclass(frozen=True)
class PivotCell:
    """What all rows in one place of a table have.

    Attributes
    ----------
    numbers
        The figures of those that have one.
    failed
        How many could not be solved.
    """

    numbers: tuple[float, ...]
    failed: int

    @property
    def worst(self) -> float | None:
        """The number furthest from zero; None where there is none."""
        return max(self.numbers, key=abs, default=None)


@dataclass(frozen=True)
class Pivot:
    """A table of two axes.

    Attributes
    ----------
    down, across
        What stands at the rows and above the columns: a label for each axis that is asked for.
    cells
        By index of row and column; a place without rows has none.
    """

    down: tuple[tuple[str, ...], ...]
    across: tuple[tuple[str, ...], ...]
    cells: dict[tuple[int, int], PivotCell]


@dataclass(frozen=True)
class Curve:
    """A figure over an axis.

    Attributes
    ----------
    name
        A label for each of the other axes that vary.
    values
        One a label of the axis; None where there is no row, or none that was solved.
    is_constant
        The rows do not depend on the axis: a method without weights over the weights.
    """

    name: tuple[str, ...]
    values: tuple[float | None, ...]
    is_constant: bool


def value_of(row: Row, column: str) -> str:
    """Return what a row has in a column."""
    return row[_AT[column]]


def is_failed(row: Row) -> bool:
    """Return whether a cell could not be solved."""
    return value_of(row, "status") == FAILED


def label_of(row: Row, axis: str) -> str:
    """Return where a row stands on an axis; "" where the axis means nothing to its method."""
    if axis == "segments":
        return value_of(row, "wanted_segments") or AUTOMATIC
    return value_of(row, axis)


def number_of(row: Row, figure: str) -> float | None:
    """Return a figure of a row."""
    text = value_of(row, figure)
    number = float(text) if text else math.nan
    return number if math.isfinite(number) else None


def labels_on(rows: Sequence[Row], axis: str) -> tuple[str, ...]:
    """Return the places on an axis: numbers by size, others as they come; "" comes first."""
    found = tuple(dict.fromkeys(label_of(row, axis) for row in rows))
    if axis in _NUMERIC:
        return tuple(sorted(found, key=_by_size))
    return tuple(sorted(found, key=bool))


def varied(rows: Sequence[Row]) -> tuple[str, ...]:
    """Return the axes on which rows differ; a set of known elevations that a method leaves out is none."""
    return tuple(axis for axis in AXES if len(_told_apart(rows, axis)) > 1)


def _told_apart(rows: Sequence[Row], axis: str) -> set[str]:
    found = {label_of(row, axis) for row in rows}
    if axis in ("known", "height_weight"):
        found.discard("")
    return found or {NO_SET}


def figures_in(rows: Sequence[Row]) -> tuple[str, ...]:
    """Return the figures that any row has."""
    return tuple(figure for figure in FIGURES if any(number_of(row, figure) is not None for row in rows))


def pivot(rows: Sequence[Row], down: Sequence[str], across: Sequence[str], figure: str) -> Pivot:
    """Return a table of a figure.

    Parameters
    ----------
    down, across
        One or more axes each.
    figure
        One of `FIGURES`.
    """
    order = {axis: {label: at for at, label in enumerate(labels_on(rows, axis))} for axis in (*down, *across)}

    def places(axes: Sequence[str]) -> tuple[tuple[str, ...], ...]:
        found = dict.fromkeys(tuple(label_of(row, axis) for axis in axes) for row in rows)
        return tuple(
            sorted(found, key=lambda labels: [order[axis][each] for axis, each in zip(axes, labels, strict=True)])
        )

    rows_at, columns_at = places(down), places(across)
    row_of = {labels: index for index, labels in enumerate(rows_at)}
    column_of = {labels: index for index, labels in enumerate(columns_at)}
    found: dict[tuple[int, int], list[Row]] = {}
    for row in rows:
        at = (
            row_of[tuple(label_of(row, axis) for axis in down)],
            column_of[tuple(label_of(row, axis) for axis in across)],
        )
        found.setdefault(at, []).append(row)
    cells = {at: _cell(each, figure) for at, each in found.items()}
    return Pivot(rows_at, columns_at, cells)


def curves(rows: Sequence[Row], axis: str, figure: str) -> tuple[tuple[str, ...], tuple[Curve, ...]]:
    """Return the labels of an axis, and a curve for each combination of the other axes that vary.

    Labels and curves without any figure are left out.
    """
    solved = [row for row in rows if number_of(row, figure) is not None]
    labels = tuple(label for label in labels_on(solved, axis) if label) or ("",)
    others = tuple(each for each in varied(solved) if each != axis)
    groups: dict[tuple[str, ...], list[Row]] = {}
    for row in solved:
        groups.setdefault(tuple(label_of(row, other) for other in others), []).append(row)
    found = []
    for name, each in groups.items():
        is_constant = all(not label_of(row, axis) for row in each)
        values = tuple(
            _cell([row for row in each if is_constant or label_of(row, axis) == label], figure).worst
            for label in labels
        )
        found.append(Curve(name, values, is_constant and len(labels) > 1))
    return labels, tuple(found)


def _cell(rows: Sequence[Row], figure: str) -> PivotCell:
    numbers = [number_of(row, figure) for row in rows]
    return PivotCell(tuple(number for number in numbers if number is not None), sum(is_failed(row) for row in rows))


def _by_size(label: str) -> tuple[int, float]:
    if not label:
        return (0, 0.0)
    return (1, float(label)) if label != AUTOMATIC else (2, 0.0)

"""The figures of a run's iterates as logarithms, ready to be drawn however many there are."""

from __future__ import annotations

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.project.record import COLUMNS
from bobdesk.project.runs import RunInputs

SERIES = ("objective", "length term", "height term", "other terms", "length", "drop", "optimality", "step", "scale")
_NUMBER, _STAGE, _OBJECTIVE, _LENGTH, _DROP, _OPTIMALITY, _STEP, _SCALE = range(len(COLUMNS))
# A logarithm of what is 0 or less: below everything, and drawn on the lower edge.
NOTHING = -400.0
_FIRST_ROOM = 1024


class ConvergenceData:
    """Grows with a run; only what is new is worked out.

    Parameters
    ----------
    inputs
        For targets, and the weights of the objective's terms.
    """

    def __init__(self, inputs: RunInputs) -> None:
        self._targets = inputs.targets
        self._weights = inputs.settings.weights
        self.has_terms = inputs.settings.method != "pgd"
        self._count = 0
        self._values = np.empty((_FIRST_ROOM, len(SERIES)))
        self._numbers = np.empty(_FIRST_ROOM)
        self._stages = np.empty(_FIRST_ROOM, dtype=np.int64)

    @property
    def count(self) -> int:
        """How many iterates there are."""
        return self._count

    @property
    def numbers(self) -> FloatArray:
        """The iterates' own numbers, (n,), ascending."""
        return self._numbers[: self._count]

    @property
    def stage_starts(self) -> list[tuple[int, int]]:
        """Row and index of the stage where each stage begins."""
        stages = self._stages[: self._count]
        rows = [0, *(np.flatnonzero(np.diff(stages)) + 1).tolist()] if self._count else []
        return [(row, int(stages[row])) for row in rows]

    def add(self, rows: FloatArray) -> None:
        """Take the next iterates, (k, 8)."""
        if not len(rows):
            return
        end = self._count + len(rows)
        while end > len(self._values):
            self._values = np.concatenate([self._values, np.empty_like(self._values)])
            self._numbers = np.concatenate([self._numbers, np.empty_like(self._numbers)])
            self._stages = np.concatenate([self._stages, np.empty_like(self._stages)])
        self._values[self._count : end] = self._series(rows)
        self._numbers[self._count : end] = rows[:, _NUMBER]
        self._stages[self._count : end] = rows[:, _STAGE]
        self._count = end

    def values(self, name: str) -> FloatArray:
        """Return a series as it is, (n,); NaN where a method has none."""
        return self._values[: self._count, SERIES.index(name)]

    def logs(self, name: str, first: int, last: int) -> FloatArray:
        """Return the decimal logarithms of rows `first` to `last`; `NOTHING` for 0 or less, NaN stays NaN."""
        values = self._values[first:last, SERIES.index(name)]
        return logarithms(values)

    def nearest(self, number: float) -> int:
        """Return the row whose iterate's number is nearest."""
        row = int(np.searchsorted(self.numbers, number))
        if row > 0 and (row >= self._count or number - self.numbers[row - 1] < self.numbers[row] - number):
            row -= 1
        return row

    def _series(self, rows: FloatArray) -> FloatArray:
        targets, weights = self._targets, self._weights
        off_length, off_drop = targets.length - rows[:, _LENGTH], targets.drop - rows[:, _DROP]
        by_length, by_drop = weights.length * off_length**2, weights.height * off_drop**2
        others = rows[:, _OBJECTIVE] - by_length - by_drop
        if not self.has_terms:
            by_length = by_drop = others = np.full(len(rows), np.nan)
        series: FloatArray = np.column_stack(
            [
                rows[:, _OBJECTIVE],
                by_length,
                by_drop,
                others,
                100 * np.abs(off_length) / targets.length,
                100 * np.abs(off_drop) / targets.drop,
                rows[:, _OPTIMALITY],
                rows[:, _STEP],
                rows[:, _SCALE],
            ]
        )
        return series


def logarithms(values: FloatArray) -> FloatArray:
    """Return decimal logarithms; `NOTHING` for 0 or less, infinity for infinity, NaN for NaN."""
    with np.errstate(divide="ignore", invalid="ignore"):
        logs: FloatArray = np.where(values > 0, np.log10(values), np.where(np.isnan(values), np.nan, NOTHING))
    return logs


def extremes(x: FloatArray, y: FloatArray, columns: int) -> tuple[FloatArray, FloatArray]:
    """Return a curve of at most 2 points a column that covers the same pixels as all points do.

    Parameters
    ----------
    x, y : (n,)
        Ascending x.
    columns
        How many columns of pixels there are.
    """
    if len(x) <= 2 * columns:
        return x, y
    edges = np.linspace(0, len(x), columns + 1).astype(int)[:-1]
    low, high = np.fmin.reduceat(y, edges), np.fmax.reduceat(y, edges)
    rising = y[edges] <= y[np.minimum(np.append(edges[1:], len(y)) - 1, len(y) - 1)]
    thin_x, thin_y = np.repeat(x[edges], 2), np.empty(2 * columns)
    thin_y[0::2], thin_y[1::2] = np.where(rising, low, high), np.where(rising, high, low)
    return thin_x, thin_y

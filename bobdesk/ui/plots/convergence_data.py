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
# Room that nobody has written to costs no memory; to move what is written costs a picture of a long run most of its
# time.
_FIRST_ROOM = 1 << 18
_BLOCK = 64


class ConvergenceData:
    """Grows with a run; only what is new is worked out, so that a picture costs the same however long the run is.

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
        self._logs = np.empty((_FIRST_ROOM, len(SERIES)))
        self._numbers = np.empty(_FIRST_ROOM)
        self._stage = -1
        self._stage_starts: list[tuple[int, int]] = []
        # Lowest and highest logarithm in each block of rows, with all that there is, and among those that can be drawn.
        blocks = _FIRST_ROOM // _BLOCK
        self._low, self._high = np.empty((blocks, len(SERIES))), np.empty((blocks, len(SERIES)))
        self._low_drawn, self._high_drawn = np.empty((blocks, len(SERIES))), np.empty((blocks, len(SERIES)))

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
        return self._stage_starts

    def add(self, rows: FloatArray) -> None:
        """Take the next iterates, (k, 8)."""
        if not len(rows):
            return
        start, end = self._count, self._count + len(rows)
        while end > len(self._values):
            for name in ("_values", "_logs", "_numbers", "_low", "_high", "_low_drawn", "_high_drawn"):
                room = getattr(self, name)
                setattr(self, name, np.concatenate([room, np.empty_like(room)]))
        self._values[start:end] = self._series(rows)
        self._logs[start:end] = logarithms(self._values[start:end])
        self._numbers[start:end] = rows[:, _NUMBER]
        stages = rows[:, _STAGE].astype(int)
        for row in np.flatnonzero(np.diff(stages, prepend=self._stage)).tolist():
            self._stage_starts.append((start + row, int(stages[row])))
        self._stage = int(stages[-1])
        self._count = end
        self._look_at_blocks(start // _BLOCK, end)

    def _look_at_blocks(self, block: int, end: int) -> None:
        logs = self._logs[block * _BLOCK : end]
        starts = np.arange(0, len(logs), _BLOCK)
        to = slice(block, block + len(starts))
        drawn = np.isfinite(logs) & (logs > NOTHING)
        self._low[to] = np.fmin.reduceat(logs, starts)
        self._high[to] = np.fmax.reduceat(logs, starts)
        self._low_drawn[to] = np.minimum.reduceat(np.where(drawn, logs, np.inf), starts)
        self._high_drawn[to] = np.maximum.reduceat(np.where(drawn, logs, -np.inf), starts)

    def values(self, name: str) -> FloatArray:
        """Return a series as it is, (n,); NaN where a method has none."""
        return self._values[: self._count, SERIES.index(name)]

    def logs(self, name: str, first: int, last: int) -> FloatArray:
        """Return the decimal logarithms of rows `first` to `last`; `NOTHING` for 0 or less, NaN stays NaN."""
        return self._logs[first:last, SERIES.index(name)]

    def range_of(self, name: str, first: int, last: int) -> tuple[float, float] | None:
        """Return the lowest and highest logarithm that can be drawn in rows `first` to `last`, None without any."""
        column = SERIES.index(name)
        block, end = -(-first // _BLOCK), last // _BLOCK
        pieces = [slice(first, last)] if end <= block else [slice(first, block * _BLOCK), slice(end * _BLOCK, last)]
        logs = np.concatenate([self._logs[piece, column] for piece in pieces])
        logs = logs[np.isfinite(logs) & (logs > NOTHING)]
        lows = np.concatenate([logs, self._low_drawn[block:end, column]])
        highs = np.concatenate([logs, self._high_drawn[block:end, column]])
        low, high = float(lows.min(initial=np.inf)), float(highs.max(initial=-np.inf))
        return (low, high) if low <= high else None

    def curve(self, name: str, first: int, last: int, columns: int) -> tuple[FloatArray, FloatArray]:
        """Return numbers and logarithms to be drawn for rows `first` to `last`, at most 2 points a column of pixels."""
        if last - first <= 2 * columns * _BLOCK:
            return extremes(self._numbers[first:last], self.logs(name, first, last), columns)
        column = SERIES.index(name)
        blocks = slice(first // _BLOCK, -(-last // _BLOCK))
        starts = self._numbers[blocks.start * _BLOCK : last : _BLOCK]
        return thinned(starts, self._low[blocks, column], self._high[blocks, column], columns)

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
    return (x, y) if len(x) <= 2 * columns else thinned(x, y, y, columns)


def thinned(x: FloatArray, low: FloatArray, high: FloatArray, columns: int) -> tuple[FloatArray, FloatArray]:
    """Return 2 points a column of pixels for what lies between `low` and `high`, (n,) each, at ascending x."""
    edges = np.linspace(0, len(x), columns + 1).astype(int)[:-1]
    lowest, highest = np.fmin.reduceat(low, edges), np.fmax.reduceat(high, edges)
    rising = low[edges] <= low[np.minimum(np.append(edges[1:], len(x)) - 1, len(x) - 1)]
    thin_x, thin_y = np.repeat(x[edges], 2), np.empty(2 * columns)
    thin_y[0::2], thin_y[1::2] = np.where(rising, lowest, highest), np.where(rising, highest, lowest)
    return thin_x, thin_y

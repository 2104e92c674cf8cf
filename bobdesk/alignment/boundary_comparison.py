"""How far two divisions of the same line into segments agree."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray

WITHIN = 3.0


@dataclass(frozen=True)
class BoundaryComparison:
    """One division beside another.

    Attributes
    ----------
    pairs
        Stations of boundaries that belong together, (of the first, of the second), m, in order.
    only_first, only_second
        Stations of boundaries without a partner, m.
    within
        How far partners may lie apart to count as the same, m.
    """

    pairs: tuple[tuple[float, float], ...]
    only_first: tuple[float, ...]
    only_second: tuple[float, ...]
    within: float

    @property
    def f1(self) -> float:
        """Harmonic mean of the shares of boundaries that agree; 1 where all do."""
        count = 2 * len(self.pairs) + len(self.only_first) + len(self.only_second)
        return 1.0 if count == 0 else 2 * len(self.pairs) / count

    @property
    def moved(self) -> int:
        """How many partners lie more than a centimetre apart."""
        return sum(abs(one - other) > 0.01 for one, other in self.pairs)


def boundaries_of(segments: Segments) -> FloatArray:
    """Return the stations between segments, (n-1,), m."""
    return np.array([segment.end for segment in segments[:-1]], dtype=np.float64)


def compare_boundaries(first: FloatArray, second: FloatArray, *, within: float = WITHIN) -> BoundaryComparison:
    """Match boundaries in order, each once: as many pairs as possible, and among those the closest.

    Parameters
    ----------
    first, second
        Ascending stations, (n,) and (m,), m.
    within
        Partners lie at most so far apart, m.
    """
    # Longest common subsequence with a tolerance; a pair counts 1 less a little for its distance.
    rows, columns = len(first), len(second)
    gain = np.zeros((rows + 1, columns + 1))
    for row in range(1, rows + 1):
        apart = np.abs(first[row - 1] - second)
        worth = np.where(apart <= within, 1.0 - 1e-3 * apart / within, -1.0)
        for column in range(1, columns + 1):
            best = max(gain[row - 1, column], gain[row, column - 1])
            gain[row, column] = max(best, gain[row - 1, column - 1] + worth[column - 1])
    pairs: list[tuple[float, float]] = []
    row, column = rows, columns
    while row and column:
        if gain[row, column] == gain[row - 1, column]:
            row -= 1
        elif gain[row, column] == gain[row, column - 1]:
            column -= 1
        else:
            row, column = row - 1, column - 1
            pairs.append((float(first[row]), float(second[column])))
    taken_first = {pair[0] for pair in pairs}
    taken_second = {pair[1] for pair in pairs}
    return BoundaryComparison(
        tuple(reversed(pairs)),
        tuple(float(one) for one in first if float(one) not in taken_first),
        tuple(float(one) for one in second if float(one) not in taken_second),
        within,
    )

"""What a run leaves behind while it works: every iterate's figures, a few iterates whole, and the best so far."""

from __future__ import annotations

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.solve.iterates import Iterate

COLUMNS = ("number", "stage", "objective", "length", "drop", "optimality", "step", "scale")
MOST_KEPT = 200
_FIRST_ROOM = 1024
# In this stage an objective is minimised for one size of swing after the other: the length tells which is best.
_LENGTH_STAGE = "length"
# Stages of the recommended method, each iterate of which is worth more than the one before.
_NEWEST_IS_BEST = ("smoothest profile", "shortest line")


class IterateRecord:
    """Filled on a job's thread, and looked at from another one at any time.

    A row is complete before it is counted, and rows once counted never change, so that no lock is needed.

    Parameters
    ----------
    length
        The wanted 3D length, m; None where it does not tell which iterate is best.
    """

    def __init__(self, length: float | None = None) -> None:
        self._length = length
        self._rows = np.empty((_FIRST_ROOM, len(COLUMNS)))
        self._count = 0
        self._stages: tuple[str, ...] = ()
        self._kept: tuple[Iterate, ...] = ()
        self._stride = 1
        self._newest: Iterate | None = None
        self._best: Iterate | None = None
        self._best_rank = (np.inf, np.inf)

    @property
    def count(self) -> int:
        """How many iterates there were."""
        return self._count

    @property
    def stages(self) -> tuple[str, ...]:
        """Names of the stages, which the second column of the rows counts."""
        return self._stages

    @property
    def newest(self) -> Iterate | None:
        """The last iterate."""
        return self._newest

    @property
    def best(self) -> Iterate | None:
        """The iterate that a run stopped now would end with."""
        return self._best

    @property
    def kept(self) -> tuple[Iterate, ...]:
        """An even choice of the iterates, at most `MOST_KEPT`, with the first and the last one."""
        newest = self._newest
        kept = self._kept
        if newest is None or (kept and kept[-1].number == newest.number):
            return kept
        return (*kept[: MOST_KEPT - 1], newest)

    def rows(self, first: int = 0) -> FloatArray:
        """Return the figures of the iterates from `first` on, (k, 8), `COLUMNS`."""
        count = self._count
        found: FloatArray = self._rows[first:count].copy()
        return found

    def append(self, iterate: Iterate) -> None:
        """Take the next iterate."""
        if iterate.stage not in self._stages:
            self._stages = (*self._stages, iterate.stage)
        if self._count == len(self._rows):
            self._rows = np.concatenate([self._rows, np.empty_like(self._rows)])
        self._rows[self._count] = (
            iterate.number,
            self._stages.index(iterate.stage),
            iterate.objective,
            iterate.length,
            iterate.drop,
            iterate.optimality,
            iterate.step,
            iterate.scale,
        )
        self._keep(iterate)
        self._rate(iterate)
        self._newest = iterate
        self._count += 1

    def _keep(self, iterate: Iterate) -> None:
        if self._count % self._stride:
            return
        self._kept = (*self._kept, iterate)
        if len(self._kept) >= MOST_KEPT:
            self._kept = self._kept[::2]
            self._stride *= 2

    def _rate(self, iterate: Iterate) -> None:
        if not (np.isfinite(iterate.objective) and np.isfinite(iterate.gradients).all()):
            return
        best = self._best
        if best is None or best.stage != iterate.stage or iterate.stage in _NEWEST_IS_BEST:
            self._best_rank = (np.inf, np.inf)
        rank = (self._missed(iterate), iterate.objective)
        if rank <= self._best_rank:
            self._best, self._best_rank = iterate, rank

    def _missed(self, iterate: Iterate) -> float:
        if self._length is None or iterate.stage != _LENGTH_STAGE:
            return 0.0
        return round(abs(iterate.length / self._length - 1), 6)


def record_of(iterates: list[Iterate], length: float | None = None) -> IterateRecord:
    """Return the record of iterates that were all kept."""
    record = IterateRecord(length)
    for iterate in iterates:
        record.append(iterate)
    return record

"""Iterates of a finished run that are kept whole, so that its lines on the way to the result can be seen again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bobdesk.arrays import FloatArray, frozen
from bobdesk.project.layout import Layout, layout_of, same_layout
from bobdesk.project.record import IterateRecord

if TYPE_CHECKING:
    from bobdesk.solve.iterates import Iterate

# Of all kept iterates of a run together: 200 kB, so that fifty runs stay below 20 MB whatever they solve.
MOST_NUMBERS = 25_000
# Before the gradients there stand number, index of the layout, and scale.
FIRST_GRADIENT = 3


@dataclass(frozen=True, eq=False)
class KeptIterates:
    """An even choice of a run's iterates, with the first and the last one.

    Attributes
    ----------
    layouts
        A solver may lay its pieces out anew on the way.
    edge_gradients
        For each layout, as in `bobdesk.solve.iterates.Iterate`.
    table : (k, 3 + p)
        Number, index of the layout, scale, and the gradients of at most p pieces, 0 beyond.
    """

    layouts: tuple[Layout, ...]
    edge_gradients: tuple[FloatArray, ...]
    table: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "edge_gradients", tuple(frozen(one) for one in self.edge_gradients))
        object.__setattr__(self, "table", frozen(self.table, columns=np.shape(self.table)[1]))

    @property
    def numbers(self) -> FloatArray:
        """The iterates' own numbers, (k,), ascending."""
        return self.table[:, 0]

    def nearest(self, number: float) -> int:
        """Return the row of the iterate whose number is nearest."""
        return int(np.abs(self.numbers - number).argmin())

    def layout_of(self, row: int) -> int:
        """Return the index of an iterate's layout."""
        return int(self.table[row, 1])

    def scale_of(self, row: int) -> float:
        """Return an iterate's factor on the plan."""
        return float(self.table[row, 2])

    def gradients_of(self, row: int) -> FloatArray:
        """Return the gradients of an iterate's pieces, (p,)."""
        pieces = len(self.layouts[self.layout_of(row)].edges) - 1
        return self.table[row, FIRST_GRADIENT : FIRST_GRADIENT + pieces]


def kept_iterates(record: IterateRecord) -> KeptIterates | None:
    """Return what is kept of the iterates of a record; None where a method has no lines of its own."""
    kept = [iterate for iterate in record.kept if _has_line(iterate)]
    if not kept:
        return None
    pieces = max(len(iterate.gradients) for iterate in kept)
    most = max(MOST_NUMBERS // (FIRST_GRADIENT + pieces), 2)
    if len(kept) > most:
        kept = [kept[row] for row in np.linspace(0, len(kept) - 1, most).round().astype(int).tolist()]
    layouts: list[Layout] = []
    edge_gradients: list[FloatArray] = []
    table = np.zeros((len(kept), FIRST_GRADIENT + pieces))
    known: dict[tuple[int, int], int] = {}
    for row, iterate in zip(table, kept, strict=True):
        key = (id(iterate.profile), id(iterate.edge_gradients))
        if key not in known:
            known[key] = _index_of(iterate, layouts, edge_gradients)
        row[:FIRST_GRADIENT] = iterate.number, known[key], iterate.scale
        row[FIRST_GRADIENT : FIRST_GRADIENT + len(iterate.gradients)] = iterate.gradients
    return KeptIterates(tuple(layouts), tuple(edge_gradients), table)


def _has_line(iterate: Iterate) -> bool:
    if iterate.profile is None or iterate.edge_gradients is None:
        return False
    return bool(
        np.isfinite(iterate.gradients).all() and np.isfinite(iterate.edge_gradients).all() and iterate.scale > 0
    )


def _index_of(iterate: Iterate, layouts: list[Layout], edge_gradients: list[FloatArray]) -> int:
    """Return the index of an iterate's layout, which is added if there is none like it."""
    if iterate.profile is None or iterate.edge_gradients is None:
        raise ValueError("an iterate without a line")
    layout = layout_of(iterate.profile)
    for index, known in enumerate(layouts):
        if same_layout(known, layout) and np.array_equal(edge_gradients[index], iterate.edge_gradients):
            return index
    layouts.append(layout)
    edge_gradients.append(iterate.edge_gradients)
    return len(layouts) - 1

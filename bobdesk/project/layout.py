"""Pieces and transitions of a run: what of a profile has to be kept so that it can be laid out again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bobdesk.arrays import BoolArray, FloatArray, IntArray, frozen

if TYPE_CHECKING:
    from bobdesk.solve.profile import Profile


@dataclass(frozen=True, eq=False)
class Layout:
    """Pieces and transitions of a solution's profile, see `bobdesk.solve.profile.Profile`; rows follow."""

    edges: FloatArray
    segment_of: IntArray
    half_transitions: FloatArray
    held: BoolArray

    def __post_init__(self) -> None:
        for name in ("edges", "half_transitions"):
            object.__setattr__(self, name, frozen(getattr(self, name)))
        for name, kind in (("segment_of", np.int64), ("held", np.bool_)):
            array = np.array(getattr(self, name), dtype=kind)
            array.flags.writeable = False
            object.__setattr__(self, name, array)


def layout_of(profile: Profile) -> Layout:
    """Return the pieces and transitions of a profile."""
    return Layout(profile.edges, profile.segment_of, profile.half_transitions, profile.held)


def same_layout(one: Layout, other: Layout) -> bool:
    """Return whether two layouts hold the same numbers."""
    return all(
        np.array_equal(getattr(one, name), getattr(other, name))
        for name in ("edges", "segment_of", "half_transitions", "held")
    )

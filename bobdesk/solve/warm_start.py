"""Begin a run where another one ended."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bobdesk.arrays import FloatArray, frozen

if TYPE_CHECKING:
    from bobdesk.solve.profile import Profile


@dataclass(frozen=True, eq=False)
class WarmStart:
    """The gradients of an earlier run.

    Attributes
    ----------
    edges : (p+1,)
        Shares of the line at which its pieces begin and end, from 0 to 1.
    gradients : (p,)
        Of those pieces.
    """

    edges: FloatArray
    gradients: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "edges", frozen(self.edges))
        object.__setattr__(self, "gradients", frozen(self.gradients))

    def on(self, profile: Profile) -> FloatArray:
        """Return the mean of these gradients over each piece of another profile, (q,)."""
        fallen = np.concatenate([[0.0], np.cumsum(self.gradients * np.diff(self.edges))])
        edges = profile.edges / profile.edges[-1]
        gradients: FloatArray = np.diff(np.interp(edges, self.edges, fallen)) / np.diff(edges)
        return gradients

"""The trace: a digitised line in pixels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from bobdesk.arrays import FloatArray, IntArray
from bobdesk.plan.polyline_geometry import arc_lengths

Kind = Literal["single", "double", "dashed"]


@dataclass(frozen=True, eq=False)
class Trace:
    """A line in a picture.

    Attributes
    ----------
    points
        (n, 2) x, y in picture pixels from the top left pixel's centre, y down, read-only.
    confidence
        (n,) from 0 (guessed) to 1 (the picture says so).
    line_width_px
        Width of the drawn line over all, pixels.
    kind
        One stroke, two edges, or dashes.
    warnings
        One sentence each, for a person.
    suspect
        (k, 2) first and last index of the points to look at.
    """

    points: FloatArray
    confidence: FloatArray
    line_width_px: float
    kind: Kind
    warnings: tuple[str, ...]
    suspect: IntArray

    @property
    def length_px(self) -> float:
        """Length of the trace in pixels."""
        return float(arc_lengths(self.points)[-1])

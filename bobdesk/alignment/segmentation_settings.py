"""How straights and curves are told apart: what the user can set of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Rule = Literal["recommended", "published"]
CurvatureMethod = Literal["fitted", "l1", "published"]


@dataclass(frozen=True)
class SegmentationSettings:
    """How straights and curves are told apart.

    Attributes
    ----------
    threshold
        Curvature above which a place counts as curved, 1/m; None finds it from the curvature
        (Otsu's rule on its logarithm, between 0.0025 and 0.008).
    count
        Wanted number of segments; None lets the cost of a change decide. A left and a right curve
        without a straight between them count as two.
    change_cost
        What a change between left, straight and right must gain, m; larger means fewer segments.
    shortest
        Shortest segment, m; ignored where a number of segments is wanted.
    rule
        "recommended", or "published": curvature by finite differences, below the threshold
        together with its neighbours.
    curvature
        Which curvature the recommended rule looks at.
    """

    threshold: float | None = None
    count: int | None = None
    change_cost: float = 4.0
    shortest: float = 3.0
    rule: Rule = "recommended"
    curvature: CurvatureMethod = "fitted"

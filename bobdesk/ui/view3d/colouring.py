"""Colours along a line by a figure of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from PySide6.QtGui import QColor

from bobdesk.arrays import FloatArray, IntArray
from bobdesk.ui.theme import colours

Figure = Literal["gradient", "curvature", "elevation", "deviation"]
STEPS = 48


@dataclass(frozen=True, eq=False)
class Colouring:
    """A figure of each row, and the range that the colours span.

    Attributes
    ----------
    figure
        Which one.
    values : (n,)
        SI.
    low, high
        Values of the first and the last colour.
    is_two_sided
        Whether the middle colour stands for 0.
    """

    figure: Figure
    values: FloatArray
    low: float
    high: float
    is_two_sided: bool = False

    @property
    def levels(self) -> IntArray:
        """Index of the colour of each row, (n,), 0 to `STEPS` - 1."""
        span = max(self.high - self.low, 1e-12)
        shares = np.nan_to_num((self.values - self.low) / span, nan=0.5)
        levels: IntArray = np.clip((shares * STEPS).astype(np.int64), 0, STEPS - 1)
        return levels


def colouring(figure: Figure, values: FloatArray) -> Colouring:
    """Return the colouring of values, (n,); curvature and deviations are two-sided about 0."""
    finite = values[np.isfinite(values)]
    if not len(finite):
        finite = np.zeros(1)
    if figure in ("curvature", "deviation"):
        # One spike at a kink must not leave all else in one colour.
        most = float(np.quantile(np.abs(finite), 0.995)) or float(np.abs(finite).max()) or 1e-9
        return Colouring(figure, values, -most, most, is_two_sided=True)
    return Colouring(figure, values, float(finite.min()), float(finite.max()))


def shades(*, two_sided: bool) -> list[QColor]:
    """Return the colours of all levels: from blue to orange, over grey where the middle stands for 0."""
    of = colours()
    first, last = QColor(of.straight), QColor(of.curve)
    if not two_sided:
        return [_between(first, last, level / (STEPS - 1)) for level in range(STEPS)]
    middle = QColor(of.muted)
    half = (STEPS - 1) / 2
    return [
        _between(first, middle, level / half) if level < half else _between(middle, last, (level - half) / half)
        for level in range(STEPS)
    ]


def _between(one: QColor, other: QColor, share: float) -> QColor:
    parts = [round(a + share * (b - a)) for a, b in zip(one.getRgb()[:3], other.getRgb()[:3], strict=True)]  # type: ignore[index]
    return QColor(*parts)

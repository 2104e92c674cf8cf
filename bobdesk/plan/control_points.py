"""What the user knows of a picture's scale and position: points and distances."""

from __future__ import annotations

import math
from dataclasses import dataclass

from bobdesk.errors import InputError

# Beyond this no survey counts, and 64-bit numbers still resolve a hundredth of a millimetre.
_LARGEST = 1e9


@dataclass(frozen=True)
class ControlPoint:
    """A pixel with a known position.

    Attributes
    ----------
    x_px, y_px
        Clicked position, pixels from the centre of the top left pixel, y down.
    x_m, y_m
        Known position, metres, y up (east and north).
    name
        What the user calls it.
    used
        Whether the calibration is fitted to it; a point that is switched off still shows its residual.
    """

    x_px: float
    y_px: float
    x_m: float
    y_m: float
    name: str = ""
    used: bool = True

    def __post_init__(self) -> None:
        if not all(
            math.isfinite(value) and abs(value) < _LARGEST for value in (self.x_px, self.y_px, self.x_m, self.y_m)
        ):
            raise InputError(f"Control point {self.name or 'without a name'} has a position that is no number.")


@dataclass(frozen=True)
class KnownDistance:
    """A distance between two pixels that is known in metres, measured in plan (horizontally).

    Attributes
    ----------
    start_px, end_px
        The two clicks (x, y), pixels, y down.
    length_m
        Known horizontal distance, metres.
    name
        What the user calls it.
    used
        Whether the calibration is fitted to it.
    """

    start_px: tuple[float, float]
    end_px: tuple[float, float]
    length_m: float
    name: str = ""
    used: bool = True

    def __post_init__(self) -> None:
        called = f"The known distance {self.name}".rstrip()
        if not all(math.isfinite(v) and abs(v) < _LARGEST for v in (*self.start_px, *self.end_px)):
            raise InputError(f"{called} has an end that is no number.")
        if not (math.isfinite(self.length_m) and 0 < self.length_m < _LARGEST):
            raise InputError(f"{called} must be a positive number of metres, not {self.length_m:g}.")
        if self.length_px == 0:
            raise InputError(f"{called} begins and ends at the same pixel.")

    @property
    def length_px(self) -> float:
        """Distance between the clicks, pixels."""
        return math.dist(self.start_px, self.end_px)

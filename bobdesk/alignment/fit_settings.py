"""How a centreline is fitted: what the user can set of it."""

from __future__ import annotations

from dataclasses import dataclass

SMALLEST_SPACING = 0.1
LARGEST_SPACING = 10.0
WAVELENGTH_OF_TRACES = 15.0
WAVELENGTH_OF_CLICKS = 20.0


@dataclass(frozen=True)
class FitSettings:
    """How the curve is fitted.

    Attributes
    ----------
    spacing
        Distance between stations, m, 0.1 to 10. What is coarser than 1 m cuts tight curves short:
        10 m by up to 2 % in a curve of 15 m radius, 1 m by 0.02 %.
    wavelength
        Half-power wavelength of the smoothing, m: waves that are shorter are taken for noise.
        15 m suits traces and surveyed points, 20 m clicks by hand, 0 goes through every vertex.
    """

    spacing: float = 1.0
    wavelength: float = WAVELENGTH_OF_TRACES

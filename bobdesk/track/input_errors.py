"""How sure the figures are that a reconstruction begins with."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.length_error import length_sigma_of_vertices
from bobdesk.solve.targets import Targets


@dataclass(frozen=True)
class InputErrors:
    """1 sigma of what goes in, and how far the figures are rounded.

    Attributes
    ----------
    scale
        Of the plan's scale, as a share: the calibration's sigma / scale. It means nothing where the
        scale is unknown.
    digitising
        Of the plan length, from clicks or trace, m.
    length_rounding, drop_rounding
        Half a unit of the last decimal place of the figures, m.
    """

    scale: float = 0.0
    digitising: float = 0.0
    length_rounding: float = 0.0
    drop_rounding: float = 0.0


def input_errors(
    line: Centreline, targets: Targets, *, vertices: int, wavelength: float, scale: float = 0.0
) -> InputErrors:
    """Return what can be said of a fitted line and its targets.

    Parameters
    ----------
    line
        Fitted to so many vertices with this wavelength of smoothing, m.
    targets
        As they were written: their decimal places say how far they are rounded.
    scale
        1 sigma of the plan's scale, as a share.
    """
    distance = line.length / max(vertices - 1, 1)
    digitising = length_sigma_of_vertices(line, vertex_distance=distance, wavelength=wavelength)
    return InputErrors(scale, digitising or 0.0, half_unit(targets.length), half_unit(targets.drop))


def half_unit(figure: float) -> float:
    """Return half a unit of the last decimal place that a figure has: 0.05 for 149.3, 0.5 for 1278."""
    exponent = Decimal(repr(float(figure))).normalize().as_tuple().exponent
    return 0.5 * 10.0 ** min(int(exponent), 0)

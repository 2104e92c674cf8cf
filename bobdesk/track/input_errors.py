"""How sure the figures are that a reconstruction begins with."""

from __future__ import annotations

from dataclasses import dataclass

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.length_error import length_sigma_of_vertices
from bobdesk.solve.targets import Targets
from bobdesk.track.rounding import half_unit


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
    unknown
        Sources of which nothing is known, so that they count as 0.
    """

    scale: float = 0.0
    digitising: float = 0.0
    length_rounding: float = 0.0
    drop_rounding: float = 0.0
    unknown: tuple[str, ...] = ()


def input_errors(
    line: Centreline, targets: Targets, *, vertices: int, wavelength: float, scale: float | None = None
) -> InputErrors:
    """Return what can be said of a fitted line and its targets.

    Parameters
    ----------
    line
        Fitted to so many vertices with this wavelength of smoothing, m.
    targets
        As they were written: their decimal places say how far they are rounded.
    scale
        1 sigma of the plan's scale, as a share; None if nothing is known of it.
    """
    distance = line.length / max(vertices - 1, 1)
    digitising = length_sigma_of_vertices(line, vertex_distance=distance, wavelength=wavelength)
    sources = {"digitising": digitising, "calibration": 0.0 if targets.unknown_scale else scale}
    return InputErrors(
        scale=scale or 0.0,
        digitising=digitising or 0.0,
        length_rounding=half_unit(targets.length),
        drop_rounding=half_unit(targets.drop),
        unknown=tuple(name for name, sigma in sources.items() if sigma is None),
    )

"""Where one more known elevation would help most: how much narrower it would make the band."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray, frozen
from bobdesk.solve.anchors import Anchors
from bobdesk.solve.envelope import GRID, Envelope, cone_of, envelope, grid_of
from bobdesk.solve.targets import Targets

_MOST_STATIONS = 400


@dataclass(frozen=True, eq=False)
class NextElevation:
    """What a known elevation at each station would be worth.

    Attributes
    ----------
    stations : (n,)
        m, in true size.
    widths : (n,)
        Root mean square width of the band, limits of the gradient alone, if the elevation there were known, m.
    band, band_after
        The envelope as it is, and with an elevation known at the best station.
    best
        Index of the station that helps most.
    """

    stations: FloatArray
    widths: FloatArray
    band: Envelope
    band_after: Envelope
    best: int

    def __post_init__(self) -> None:
        object.__setattr__(self, "stations", frozen(self.stations))
        object.__setattr__(self, "widths", frozen(self.widths))

    @property
    def station(self) -> float:
        """The station that helps most, m, in true size."""
        return float(self.stations[self.best])

    @property
    def gain(self) -> float:
        """By how much the mean width of the envelope falls, m."""
        return self.band.mean_width - self.band_after.mean_width


def next_elevation(
    anchors: Anchors,
    targets: Targets,
    *,
    estimate: tuple[FloatArray, FloatArray] | None = None,
    scale: float = 1.0,
) -> NextElevation:
    """Find the station whose elevation, once known, narrows the band most.

    What would be measured is taken to be the estimate. Widths are weighed by their squares, as in the
    RMS of an elevation; and the cones of the limits count without the ground that cuts them off, which makes the band
    narrower towards the finish and not the profile surer there: with the ground, three advised elevations were
    worth 5 to 8 % less than three evenly spaced ones, without it 2 % more, on the mean of 23 lines.

    Parameters
    ----------
    anchors, targets, scale
        As for `envelope`.
    estimate : (m,), (m,)
        Stations in true size and elevations of a result, m; without it the middle of the band.

    Raises
    ------
    TargetError
        If no profile meets all.
    """
    length = scale * anchors[-1].station
    at = grid_of(anchors, scale=scale, step=max(GRID, length / _MOST_STATIONS))
    band = envelope(at / scale, anchors, targets, scale=scale)
    lowest, highest = cone_of(at, anchors, targets, scale=scale)
    supposed = 0.5 * (band.lowest + band.highest) if estimate is None else np.interp(at, *estimate)
    supposed = np.clip(supposed, band.lowest, band.highest)
    ahead = at[None, :] - at[:, None]
    steep, flat = targets.max_gradient * ahead, targets.min_gradient * ahead
    low = np.maximum(lowest, supposed[:, None] - np.maximum(steep, flat))
    high = np.minimum(highest, supposed[:, None] - np.minimum(steep, flat))
    squares = np.trapezoid(np.maximum(high - low, 0.0) ** 2, at, axis=1)
    widths = np.sqrt(squares / length)
    best = int(widths.argmin())
    after = Envelope(at, np.maximum(low[best], band.lowest), np.minimum(high[best], band.highest))
    return NextElevation(at, widths, band, after, best)

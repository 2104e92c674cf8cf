"""Where one more known elevation would help most: how much surer it would make all others."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray, frozen
from bobdesk.errors import TargetError
from bobdesk.progress import Progress
from bobdesk.solve.anchors import Anchors
from bobdesk.solve.envelope import GRID, Envelope, envelope
from bobdesk.solve.profile_sampling import Bundle, sample_profiles
from bobdesk.solve.targets import Targets

# 2 % in 10 m; steeper only if the known elevations need it.
USUAL_CHANGE = 0.002
_STEEPEST_CHANGE = 10.0
_PROFILES, _MOST_CELLS = 1000, 150
_SURE = 1e-4


@dataclass(frozen=True, eq=False)
class NextElevation:
    """What a known elevation at each station would be worth.

    Attributes
    ----------
    stations : (n,)
        m, in true size.
    spreads : (n,)
        Root mean square standard deviation of all elevations of the profiles that the data allow, if the elevation
        there were known, m.
    spread
        The same as it is, m.
    band, band_after
        The envelope, limits of the gradient alone, as it is, and with an elevation known at the best station.
    best
        Index of the station that helps most.
    """

    stations: FloatArray
    spreads: FloatArray
    spread: float
    band: Envelope
    band_after: Envelope
    best: int

    def __post_init__(self) -> None:
        object.__setattr__(self, "stations", frozen(self.stations))
        object.__setattr__(self, "spreads", frozen(self.spreads))

    @property
    def station(self) -> float:
        """The station that helps most, m, in true size."""
        return float(self.stations[self.best])

    @property
    def spread_after(self) -> float:
        """The root mean square standard deviation with an elevation known there, m."""
        return float(self.spreads[self.best])

    @property
    def gain(self) -> float:
        """By how much the mean width of the envelope falls, m."""
        return self.band.mean_width - self.band_after.mean_width


def next_elevation(
    anchors: Anchors,
    targets: Targets,
    *,
    estimate: tuple[FloatArray, FloatArray] | None = None,
    largest_change: float | None = None,
    scale: float = 1.0,
) -> Generator[Progress, None, NextElevation]:
    """Find the station whose elevation, once known, leaves the least expected square error of all elevations.

    Among all smooth profiles that the data allow, drawn uniformly and seeded, elevations at two stations
    vary together; an elevation that is known at one takes its share of the variance away from all (as if they were
    normal). The narrowing of the band was tried before: it is decided by profiles that run along the limits, which no
    track does, and its advice was no better than even spacing on half of the lines.

    Parameters
    ----------
    anchors, targets, scale
        As for `envelope`.
    estimate : (m,), (m,)
        Stations in true size and elevations of a result, m, for what would be measured; without it the
        mean of the profiles. Only `band_after` depends on it.
    largest_change
        Of the gradient per metre of the profiles, 1/m; without it 0.002, or the double, and so on, if no such
        profile meets the known elevations.

    Raises
    ------
    TargetError
        If no profile meets all, or nothing is left open.
    """
    length = scale * anchors[-1].station
    bundle = yield from _smooth_profiles(anchors, targets, largest_change, scale, max(GRID, length / _MOST_CELLS))
    at = bundle.stations
    cells = np.gradient(at)
    mean = bundle.elevations.mean(axis=0)
    apart = bundle.elevations - mean
    together = apart.T @ apart / len(apart)
    open_there = together.diagonal()
    if open_there.max() <= 0.0:
        raise TargetError("the limits and known elevations leave nothing open, so that no other elevation could help")
    # Where an elevation is all but known already, both sides of the fraction are rounding.
    unsure = open_there > _SURE * open_there.max()
    taken = np.zeros(len(at))
    taken[unsure] = (together[:, unsure] ** 2 * cells[:, None]).sum(axis=0) / open_there[unsure]
    all_of_it = float((open_there * cells).sum())
    spreads = np.sqrt(np.maximum(all_of_it - taken, 0.0) / length)
    best = int(spreads.argmin())
    band = envelope(at / scale, anchors, targets, scale=scale)
    supposed = mean if estimate is None else np.interp(at, *estimate)
    measured = float(np.clip(supposed[best], band.lowest[best], band.highest[best]))
    ahead = at - at[best]
    steep, flat = targets.max_gradient * ahead, targets.min_gradient * ahead
    after = Envelope(
        at,
        np.maximum(band.lowest, measured - np.maximum(steep, flat)),
        np.minimum(band.highest, measured - np.minimum(steep, flat)),
    )
    return NextElevation(at, spreads, float(np.sqrt(all_of_it / length)), band, after, best)


def _smooth_profiles(
    anchors: Anchors, targets: Targets, largest_change: float | None, scale: float, step: float
) -> Generator[Progress, None, Bundle]:
    change = USUAL_CHANGE if largest_change is None else largest_change
    while True:
        try:
            return (
                yield from sample_profiles(
                    anchors, targets, count=_PROFILES, largest_change=change, scale=scale, step=step
                )
            )
        except TargetError:
            if largest_change is not None or change > _STEEPEST_CHANGE:
                raise
            change *= 2

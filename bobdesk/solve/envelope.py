"""The envelope: the lowest and highest elevation at each station over all profiles that the data allow."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from bobdesk.arrays import FloatArray, frozen
from bobdesk.errors import TargetError
from bobdesk.progress import Progress
from bobdesk.solve.anchors import Anchors, elevations_of, stations_of
from bobdesk.solve.reachable_states import States, elevations_in_both
from bobdesk.solve.targets import Targets

GRID = 10.0
_STEPS_A_REPORT = 20


@dataclass(frozen=True, eq=False)
class Envelope:
    """A band that every profile within the limits and through the known elevations lies in.

    Attributes
    ----------
    stations, lowest, highest : (n,)
        m; the stations in true size.
    """

    stations: FloatArray
    lowest: FloatArray
    highest: FloatArray

    def __post_init__(self) -> None:
        for name in ("stations", "lowest", "highest"):
            object.__setattr__(self, name, frozen(getattr(self, name)))

    @property
    def mean_width(self) -> float:
        """Mean of highest less lowest along the line, m."""
        return float(np.trapezoid(self.highest - self.lowest, self.stations) / np.ptp(self.stations))


def envelope(stations: FloatArray, anchors: Anchors, targets: Targets, *, scale: float = 1.0) -> Envelope:
    """Return the band over all profiles, whatever their pieces, in closed form.

    From each known elevation the limits of the gradient open a cone; the band is where all cones
    meet, cut off at the lowest point. Each face of it is reached by a profile within the limits.

    Parameters
    ----------
    stations : (n,)
        In the plan's own scale, m.
    anchors
        Drop, known elevations with their tolerances, and end.
    targets
        For the limits.
    scale
        Factor on the plan.

    Raises
    ------
    TargetError
        If no profile meets all.
    """
    at = scale * stations
    lowest, highest = cone_of(at, anchors, targets, scale=scale)
    lowest = np.maximum(lowest, 0.0)
    if (lowest > highest + 1e-9 * max(1.0, targets.drop)).any():
        worst = float(at[(lowest - highest).argmax()])
        raise TargetError(f"no profile within the limits meets the known elevations around {worst:.1f} m")
    return Envelope(at, lowest, np.maximum(highest, lowest))


def cone_of(at: FloatArray, anchors: Anchors, targets: Targets, *, scale: float = 1.0) -> tuple[FloatArray, FloatArray]:
    """Return where the cones from all known elevations meet, lowest and highest at stations of true size, (n,), m."""
    known, elevations = scale * stations_of(anchors), elevations_of(anchors)
    tolerances = np.array([anchor.tolerance for anchor in anchors])
    ahead = at[:, None] - known[None, :]
    fastest = np.where(ahead >= 0, targets.max_gradient, targets.min_gradient) * ahead
    slowest = np.where(ahead >= 0, targets.min_gradient, targets.max_gradient) * ahead
    # Nothing lies below the lowest point, whatever the tolerance.
    lowest: FloatArray = (np.maximum(elevations - tolerances, 0.0) - fastest).max(axis=1)
    highest: FloatArray = (elevations + tolerances - slowest).min(axis=1)
    return lowest, highest


def smooth_envelope(
    anchors: Anchors, targets: Targets, *, largest_change: float, scale: float = 1.0, step: float = GRID
) -> Generator[Progress, None, Envelope]:
    """Return the band over all profiles whose gradient changes by no more than so much per metre.

    Exact for profiles on the grid of the result, of one gradient a cell, with changes between
    neighbouring cells of at most `largest_change` times the distance of their middles: the set of all
    pairs of elevation and gradient that can be reached from the start, and the set of those from
    which the end can be reached, are convex polygons, and what lies in both is the band. It holds
    what two linear programs a station would find, and takes a hundredth of their time. Any
    profile with so bounded a change, on a grid or not, has mean gradients in the cells that are within
    these bounds, so that none leaves the band.

    Parameters
    ----------
    anchors, targets, scale
        As for `envelope`.
    largest_change
        Of the gradient per metre of plan, 1/m; more than 0.
    step
        Largest distance between stations, m. Anchors are stations besides.

    Raises
    ------
    TargetError
        If no profile meets all.
    """
    at = grid_of(anchors, scale=scale, step=step)
    low, high = allowed_elevations(at, anchors, scale=scale)
    # A free end is bounded by the limits alone.
    high[-1] = min(high[-1], cone_of(at[-1:], anchors, targets, scale=scale)[1].item())
    cells = np.diff(at)
    most = largest_change * 0.5 * (cells[1:] + cells[:-1])
    total = 2 * len(cells)
    before: list[States] = []
    states = _free(targets, low[0], high[0])
    for index, length in enumerate(cells):
        if index % _STEPS_A_REPORT == 0:
            yield Progress(index / total, "the band")
        if index:
            states = _limited(states.changed_by(most[index - 1]), targets, at[index])
        states = _kept(states.fallen(length), low[index + 1], high[index + 1], at[index + 1])
        before.append(states)
    lowest, highest = np.empty(len(at)), np.empty(len(at))
    states = _free(targets, low[-1], high[-1])
    for index in range(len(cells) - 1, -1, -1):
        if index % _STEPS_A_REPORT == 0:
            yield Progress(1 - index / total, "the band")
        found = elevations_in_both(before[index], states)
        if found is None:
            raise _nothing_fits(at[index + 1])
        lowest[index + 1], highest[index + 1] = found
        states = states.fallen(-cells[index])
        if index:
            states = _limited(states.changed_by(most[index - 1]), targets, at[index])
        states = _kept(states, low[index], high[index], at[index])
    lowest[0], highest[0] = states.lower[1].min(), states.upper[1].max()
    return Envelope(at, lowest, highest)


def between_stations(band: Envelope, stations: FloatArray, *, largest_change: float) -> Envelope:
    """Return a band of `smooth_envelope` at other stations of true size, (n,), m.

    Between two stations of the grid a profile bulges from its chord by at most half the change of gradient per
    metre times the distances to both: 2.5 cm in the middle of 10 m at 0.002 1/m.
    """
    right = np.clip(np.searchsorted(band.stations, stations, side="left"), 1, len(band.stations) - 1)
    apart = (stations - band.stations[right - 1]) * (band.stations[right] - stations)
    bulge = 0.5 * largest_change * np.maximum(apart, 0.0)
    lowest = np.interp(stations, band.stations, band.lowest) - bulge
    highest = np.interp(stations, band.stations, band.highest) + bulge
    return Envelope(stations, np.maximum(lowest, 0.0), highest)


def grid_of(anchors: Anchors, *, scale: float = 1.0, step: float = GRID) -> FloatArray:
    """Return stations of true size at most `step` apart, equally spaced between each two anchors, (n,), m."""
    known = scale * stations_of(anchors)
    parts = [known[:1]]
    for start, end in pairwise(known.tolist()):
        parts.append(np.linspace(start, end, max(1, int(np.ceil((end - start) / step - 1e-9))) + 1)[1:])
    return np.concatenate(parts)


def allowed_elevations(at: FloatArray, anchors: Anchors, *, scale: float = 1.0) -> tuple[FloatArray, FloatArray]:
    """Return the lowest and highest elevation that each station of a grid may have by itself, (n,), (n,), m."""
    low, high = np.zeros(len(at)), np.full(len(at), np.inf)
    tolerances = np.array([anchor.tolerance for anchor in anchors])
    rows = np.searchsorted(at, scale * stations_of(anchors) - 1e-9)
    low[rows] = np.maximum(elevations_of(anchors) - tolerances, 0.0)
    high[rows] = elevations_of(anchors) + tolerances
    return low, high


def _free(targets: Targets, low: float, high: float) -> States:
    gradients = np.array([targets.min_gradient, targets.max_gradient])
    return States(np.stack([gradients, np.full(2, high)]), np.stack([gradients, np.full(2, low)]))


def _limited(states: States, targets: Targets, station: float) -> States:
    found = states.with_gradients(targets.min_gradient, targets.max_gradient)
    if found is None:
        raise _nothing_fits(station)
    return found


def _kept(states: States, low: float, high: float, station: float) -> States:
    found = states.with_elevations(low, high)
    if found is None:
        raise _nothing_fits(station)
    return found


def _nothing_fits(station: float) -> TargetError:
    return TargetError(
        "no profile within the limits of the gradient and of its change per metre meets the known elevations"
        f" around {station:.1f} m"
    )

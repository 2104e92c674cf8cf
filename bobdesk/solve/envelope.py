"""The envelope: the lowest and highest elevation at each station over all profiles that the data allow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray, frozen
from bobdesk.errors import TargetError
from bobdesk.solve.anchors import Anchors, elevations_of, stations_of
from bobdesk.solve.targets import Targets


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
    known, elevations = scale * stations_of(anchors), elevations_of(anchors)
    tolerances = np.array([anchor.tolerance for anchor in anchors])
    ahead = at[:, None] - known[None, :]
    fastest = np.where(ahead >= 0, targets.max_gradient, targets.min_gradient) * ahead
    slowest = np.where(ahead >= 0, targets.min_gradient, targets.max_gradient) * ahead
    lowest = np.maximum((elevations - tolerances - fastest).max(axis=1), 0.0)
    highest = (elevations + tolerances - slowest).min(axis=1)
    if (lowest > highest + 1e-9 * max(1.0, targets.drop)).any():
        worst = float(at[(lowest - highest).argmax()])
        raise TargetError(f"no profile within the limits meets the known elevations around {worst:.1f} m")
    return Envelope(at, lowest, np.maximum(highest, lowest))

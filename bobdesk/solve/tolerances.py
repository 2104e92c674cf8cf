"""Where, within their tolerances, the known elevations are held: where the profile is smoothest; and a free end."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from scipy.optimize import LinearConstraint, minimize

from bobdesk.arrays import FloatArray
from bobdesk.solve.anchors import Anchors, anchors_of, elevations_of, last_before_a_free_end, stations_of
from bobdesk.solve.targets import Targets

_NOTHING = 1e-9


def settled(anchors: Anchors, targets: Targets, *, scale: float = 1.0) -> Anchors:
    """Return the anchors with each elevation moved within its tolerance, none of them free any more.

    Least changes of the mean gradient between neighbouring stretches, with the mean gradient of
    each stretch within the limits. Anchors without a tolerance stay where they are, and one lies at 0, without
    which the drop would be too small; where nothing within the tolerances suits the limits, the others
    stay too, and the sentence about the stretch says so.
    """
    if not any(anchor.tolerance for anchor in anchors):
        return anchors
    found = None
    for low, high in _rooms(anchors):
        found = _smoothest(anchors, targets, low, high, scale)
        if found is not None:
            break
    else:
        low, high = _rooms(anchors)[0]
        found = np.clip(elevations_of(anchors), low, high)
    # What the optimiser leaves of 0 is 0: a lowest point is looked for by that.
    moved = np.where(np.abs(found) < _NOTHING, 0.0, found)
    return tuple(
        replace(anchor, elevation=float(at), tolerance=anchor.tolerance if math.isfinite(anchor.tolerance) else 0.0)
        for anchor, at in zip(anchors, moved, strict=True)
    )


def _smoothest(
    anchors: Anchors, targets: Targets, low: FloatArray, high: FloatArray, scale: float
) -> FloatArray | None:
    """Return the elevations within bounds whose mean gradients change least, (a,); None if the limits forbid all."""
    lengths = scale * np.diff(stations_of(anchors))
    given = np.clip(elevations_of(anchors), low, high)
    # Mean gradients and their changes, as matrices on the elevations.
    means = -np.diff(np.eye(len(anchors)), axis=0) / lengths[:, None]
    changes = np.diff(means, axis=0) / np.sqrt(0.5 * (lengths[1:] + lengths[:-1]))[:, None]
    scaled = changes / max(float(np.abs(changes @ given).max(initial=0.0)), 1e-12)

    def roughness(elevations: FloatArray) -> tuple[float, FloatArray]:
        bends = scaled @ elevations
        return float(bends @ bends), 2 * scaled.T @ bends

    found = minimize(
        roughness,
        given,
        jac=True,
        method="SLSQP",
        bounds=list(zip(low.tolist(), high.tolist(), strict=True)),
        constraints=[LinearConstraint(means, targets.min_gradient, targets.max_gradient)],
        options={"maxiter": 500, "ftol": 1e-12},
    )
    return np.clip(found.x, low, high) if found.success else None


def room_of_free_end(targets: Targets, length: float, *, scale: float = 1.0) -> tuple[float, float] | None:
    """Return where a free end lies with the shortest and with the steepest climb to it, m; None if the end is held.

    Parameters
    ----------
    length
        Plan length, m, in the plan's own scale.
    """
    free = anchors_of(targets, length)
    if last_before_a_free_end(free) is None:
        return None
    before, end = settled(free, targets, scale=scale)[-2:]
    rest = scale * (end.station - before.station)
    lowest = max(before.elevation - targets.max_gradient * rest, 0.0)
    highest = max(before.elevation - targets.min_gradient * rest, lowest)
    return min(max(before.elevation, lowest), highest), highest


def _rooms(anchors: Anchors) -> list[tuple[FloatArray, FloatArray]]:
    """Return the lowest and highest elevation that each anchor may be held at, (a,), (a,), m, the likeliest first.

    There is a pair for each anchor that may be the lowest point, which is then held at 0.
    """
    tolerances = np.array([anchor.tolerance for anchor in anchors])
    low = np.maximum(elevations_of(anchors) - tolerances, 0.0)
    high = elevations_of(anchors) + tolerances
    reach_down = [index for index in range(len(anchors)) if low[index] == 0]
    rooms = []
    for lowest in sorted(reach_down, key=lambda index: (anchors[index].elevation, anchors[index].tolerance)):
        rooms.append((low, high.copy()))
        rooms[-1][1][lowest] = 0.0
        if anchors[lowest].tolerance == 0:
            break
    return rooms or [(low, high)]

"""Where, within their tolerances, the known elevations are held: where the profile is smoothest."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.optimize import LinearConstraint, minimize

from bobdesk.arrays import FloatArray
from bobdesk.solve.anchors import Anchors, elevations_of, stations_of
from bobdesk.solve.targets import Targets


def settled(anchors: Anchors, targets: Targets, *, scale: float = 1.0) -> Anchors:
    """Return the anchors with each elevation moved within its tolerance.

    Least changes of the mean gradient between neighbouring stretches, with the mean gradient of
    each stretch within the limits. Anchors without a tolerance stay where they are; where nothing
    within the tolerances suits the limits, all stay, and the sentence about the stretch says so.
    """
    tolerances = np.array([anchor.tolerance for anchor in anchors])
    if not tolerances.any():
        return anchors
    lengths = scale * np.diff(stations_of(anchors))
    given = elevations_of(anchors)
    # Mean gradients and their changes, as matrices on the elevations.
    means = -np.diff(np.eye(len(anchors)), axis=0) / lengths[:, None]
    changes = np.diff(means, axis=0) / np.sqrt(0.5 * (lengths[1:] + lengths[:-1]))[:, None]
    scaled = changes / max(float(np.abs(changes @ given).max(initial=0.0)), 1e-12)

    def roughness(elevations: FloatArray) -> tuple[float, FloatArray]:
        bends = scaled @ elevations
        return float(bends @ bends), 2 * scaled.T @ bends

    low = np.maximum(given - tolerances, 0.0)
    found = minimize(
        roughness,
        given,
        jac=True,
        method="SLSQP",
        bounds=list(zip(low.tolist(), (given + tolerances).tolist(), strict=True)),
        constraints=[LinearConstraint(means, targets.min_gradient, targets.max_gradient)],
        options={"maxiter": 500, "ftol": 1e-12},
    )
    if not found.success:
        return anchors
    moved = np.clip(found.x, low, given + tolerances)
    return tuple(replace(anchor, elevation=float(at)) for anchor, at in zip(anchors, moved, strict=True))

"""The published method, to the letter of the paper's Section 2: the baseline to compare with."""

from __future__ import annotations

import numpy as np

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.solve.iterates import Iterate, Run, Solution
from bobdesk.solve.objective import PublishedObjective
from bobdesk.solve.profile import Profile, make_profile
from bobdesk.solve.settings import PublishedSettings
from bobdesk.solve.targets import Targets
from bobdesk.solve.warm_start import WarmStart

_WILDEST_SCALE = 2.0
_RATE = 1e-5
_RATE_OF_SCALE = 0.2


def published(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    settings: PublishedSettings | None = None,
    *,
    warm: WarmStart | None = None,
) -> Run:
    """Reconstruct the gradients as published; a generator of iterates that returns the solution.

    The unknowns are the height differences h of the segments. Each iteration projects them so that
    every gradient h / D lies within the limits, evaluates J, and moves each h against the change of
    J between the last two iterates divided by its own change (Eq. 6); the end is where J changes by
    less than δ. With an unknown scale the factor f is updated in the same way at the end of each
    iteration, and x and y are scaled at the start of the next (Eq. 7 and 9); where that overshoots to
    less than half or more than double, the run ends and says so. The paper does not say
    where it starts: here with equal height differences of all segments, within the limits, or with the
    gradients of an earlier run.

    Known elevations have no place in this method and are left out.

    References
    ----------
    Z. Chen et al., Projected gradient descent-based optimization of 3D bobsleigh track centerlines
    from 2D data for simulation, arXiv 2507.08393, Section 2.
    """
    settings = settings or PublishedSettings()
    profile = make_profile(centreline, segments)
    objective = PublishedObjective(profile, targets, settings.weights)
    lengths = profile.piece_lengths
    rate = _rate(settings, profile, targets)

    scale, scale_before = 1.0, 1.0
    heights = np.full(len(lengths), targets.drop / len(lengths)) if warm is None else warm.on(profile) * lengths
    heights = _within_limits(heights, lengths, targets)
    no_edge_gradients = np.zeros(max(len(lengths) - 1, 1))

    def look(number: int, heights: FloatArray, scale: float) -> Iterate:
        gradients = heights / (scale * lengths)
        value, terms = objective.value_and_terms(gradients, scale)
        return Iterate(
            number=number,
            stage="published",
            gradients=gradients,
            objective=value,
            length=targets.length - terms.length,
            drop=targets.drop - terms.height,
            optimality=float("nan"),
            step=float("nan"),
            scale=scale,
            profile=profile,
            edge_gradients=no_edge_gradients,
        )

    iterate = look(0, heights, scale)
    yield iterate
    before, heights = heights, heights - rate * settings.first_derivative
    if targets.unknown_scale:
        scale = scale_before - rate * settings.first_derivative

    status, message = 1, f"Stopped after {settings.max_iterations:,} iterations."
    number = 0
    for number in range(1, settings.max_iterations + 1):
        heights = _within_limits(heights, scale * lengths, targets)
        value_before = iterate.objective
        iterate = look(number, heights, scale)
        yield iterate
        change = iterate.objective - value_before
        if not np.isfinite(change):
            status, message = 2, "J ran off to infinity."
            break
        if abs(change) < settings.threshold:
            status, message = 0, f"J changed by less than {settings.threshold:g}."
            break
        following = heights - rate * _quotient(change, heights - before)
        before, heights = heights, following
        if targets.unknown_scale:
            next_scale = scale - rate * float(_quotient(change, np.array(scale - scale_before)))
            if not 1 / _WILDEST_SCALE <= next_scale <= _WILDEST_SCALE:
                status = 2
                message = (
                    f"Stopped: the next scale factor would be {next_scale:.3g}. With this learning rate the published"
                    " update of the scale overshoots; a smaller rate or the recommended method finds it."
                )
                heights = before
                break
            scale_before, scale = scale, next_scale
    return Solution(
        method="published",
        profile=profile,
        gradients=heights / (scale * lengths),
        edge_gradients=no_edge_gradients,
        scale=scale,
        start_elevation=targets.drop,
        status=status,
        message=message,
        nit=number,
        nfev=objective.nfev,
        njev=0,
        objective=iterate.objective,
        optimality=float("nan"),
    )


def _rate(settings: PublishedSettings, profile: Profile, targets: Targets) -> float:
    if settings.rate is not None:
        return settings.rate
    return min(_RATE, _RATE_OF_SCALE / profile.length**2) if targets.unknown_scale else _RATE


def _within_limits(heights: FloatArray, lengths: FloatArray, targets: Targets) -> FloatArray:
    """Project: a height difference whose gradient is out of the limits is put on the limit."""
    return np.minimum(np.maximum(heights, targets.min_gradient * lengths), targets.max_gradient * lengths)


def _quotient(change: float, moved: FloatArray) -> FloatArray:
    """Return the derivative by differences of two iterates; 0 for what did not move."""
    return np.divide(change, moved, out=np.zeros_like(moved), where=moved != 0)

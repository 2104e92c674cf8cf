"""The figures of a 3D centreline: the columns of the published tables, and more."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bobdesk.solve.targets import Targets

if TYPE_CHECKING:
    from bobdesk.track.centreline3d import Centreline3D


@dataclass(frozen=True)
class Figures:
    """Figures of a line.

    Attributes
    ----------
    length
        3D length: the sum of the distances between rows, m.
    drop
        Height difference between start and lowest point, m.
    plan_length
        m.
    mean_gradient_drop_per_length, mean_gradient_drop_per_plan, mean_gradient_segments
        The three definitions in use.
    max_gradient, min_gradient
        Downhill positive.
    mean_curvature_difference
        Mean of |K2 - K3| over the rows, 1/m.
    """

    length: float
    drop: float
    plan_length: float
    mean_gradient_drop_per_length: float
    mean_gradient_drop_per_plan: float
    mean_gradient_segments: float
    max_gradient: float
    min_gradient: float
    mean_curvature_difference: float


@dataclass(frozen=True)
class Deviations:
    """Figures less targets in percent of the targets; None where there is no target."""

    length: float
    drop: float
    mean_gradient: float | None


def figures(line: Centreline3D) -> Figures:
    """Return the figures of a line."""
    length = float(line.slope_lengths[-1])
    drop = float(line.elevations[0] - line.elevations.min())
    plan = float(np.hypot(*np.diff(line.points[:, :2], axis=0).T).sum())
    return Figures(
        length=length,
        drop=drop,
        plan_length=plan,
        mean_gradient_drop_per_length=drop / length,
        mean_gradient_drop_per_plan=drop / plan,
        mean_gradient_segments=float(line.segment_gradients.mean()),
        max_gradient=float(line.gradients.max()),
        min_gradient=float(line.gradients.min()),
        mean_curvature_difference=float(np.abs(np.abs(line.plan_curvature) - np.abs(line.curvature)).mean()),
    )


def deviations(found: Figures, targets: Targets) -> Deviations:
    """Compare figures with targets; the mean gradient by the definition that the target names."""
    mean = None
    if targets.mean_gradient:
        by_definition = {
            "drop-per-length": found.mean_gradient_drop_per_length,
            "drop-per-plan": found.mean_gradient_drop_per_plan,
            "segments": found.mean_gradient_segments,
        }
        mean = _percent(by_definition[targets.mean_gradient_is], targets.mean_gradient)
    return Deviations(_percent(found.length, targets.length), _percent(found.drop, targets.drop), mean)


def _percent(value: float, target: float) -> float:
    return 100 * (value - target) / target

"""Figures of runs and of the actual track, for tables."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from bobdesk.project.project import ActualTrack
from bobdesk.solve.targets import MeanGradientDefinition
from bobdesk.track.figures import Figures
from bobdesk.ui.quantities import Quantities

# Deviations of this size have one digit behind the point, others three.
_LARGE_PERCENT = 100.0


@lru_cache(maxsize=4)
def actual_figures(actual: ActualTrack) -> Figures:
    """Return the figures of the actual track; it has no segments, so that their mean is drop by plan length."""
    points = actual.points
    plan = np.hypot(*np.diff(points[:, :2], axis=0).T)
    rises = np.diff(points[:, 2])
    length = float(np.hypot(plan, rises).sum())
    drop = float(points[0, 2] - points[:, 2].min())
    far = plan > 1e-9
    gradients = -rises[far] / plan[far]
    return Figures(
        length=length,
        drop=drop,
        plan_length=float(plan.sum()),
        mean_gradient_drop_per_length=drop / length,
        mean_gradient_drop_per_plan=drop / float(plan.sum()),
        mean_gradient_segments=drop / float(plan.sum()),
        max_gradient=float(gradients.max()),
        min_gradient=float(gradients.min()),
        mean_curvature_difference=float("nan"),
    )


def mean_of(figures: Figures, definition: MeanGradientDefinition) -> float:
    """Return the mean gradient by a definition."""
    return {
        "drop-per-length": figures.mean_gradient_drop_per_length,
        "drop-per-plan": figures.mean_gradient_drop_per_plan,
        "segments": figures.mean_gradient_segments,
    }[definition]


def percent_text(unit: Quantities, value: float) -> str:
    """Return a deviation, in percent, as text."""
    return f"{unit.number(value, 3 if abs(value) < _LARGE_PERCENT else 1)} %"


def signed(text: str) -> str:
    """Return a number as text with its sign, also where that is plus."""
    return text if text[:1] in ("−", "-", "–") else f"+{text}"

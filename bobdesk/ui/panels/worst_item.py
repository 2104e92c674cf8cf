"""Which control point or known distance disagrees with the others, if one does."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from bobdesk.plan.calibration_fit import CalibrationFit

# It is said to disagree if the RMS falls below this share without it.
_DISAGREES = 0.6


@dataclass(frozen=True)
class WorstItem:
    """Its kind and row, and the RMS with and without it, m."""

    kind: Literal["point", "distance"]
    row: int
    rms_m: float
    rms_without_m: float


def worst_item(fit: CalibrationFit | None) -> WorstItem | None:
    """Return what spoils a fit, or None if nothing does by much."""
    if fit is None or fit.worst is None or fit.rms_m is None or fit.worst.rms_without_m is None:
        return None
    if fit.worst.rms_without_m > _DISAGREES * fit.rms_m:
        return None
    name = fit.worst.name
    sizes: list[tuple[float, Literal["point", "distance"], int]] = []
    for row, point in enumerate(fit.points):
        if point.used and point.name == name:
            sizes.append((point.norm_m, "point", row))
    for row, known in enumerate(fit.distances):
        if known.used and known.name == name:
            sizes.append((abs(known.difference_m), "distance", row))
    if not sizes:
        return None
    _, kind, row = max(sizes)
    return WorstItem(kind, row, fit.rms_m, fit.worst.rms_without_m)

"""Which targets a line misses, whatever the solver says of itself: it may converge where it cannot leave."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from bobdesk.sentences import counted
from bobdesk.solve.iterates import Solution
from bobdesk.solve.targets import Targets, in_scale
from bobdesk.track.centreline3d import Centreline3D
from bobdesk.track.figures import Figures

MET_WITHIN = 1e-4
"""Of length and drop as a share; of gradients as a number; of known elevations a share of the drop."""

_LARGE_PERCENT = 100.0


@dataclass(frozen=True)
class Miss:
    """A target that a line misses.

    Attributes
    ----------
    target
        Which one; the limits of the gradient are one, and all known elevations are.
    off
        Line less target: m, or a gradient; of the known elevation that is missed by the most.
    share
        The same as a share of the target; NaN where that says nothing.
    station
        Of that known elevation, m in the plan's scale as the targets have it; NaN of all others.
    count
        How many known elevations are missed, else 1.
    """

    target: Literal["length", "drop", "mean gradient", "limits", "known elevations"]
    off: float
    share: float = float("nan")
    station: float = float("nan")
    count: int = 1


def missed_targets(line: Centreline3D, found: Figures, solution: Solution, targets: Targets) -> tuple[Miss, ...]:
    """Return the targets that a line misses by more than `MET_WITHIN`, the figures first.

    A mean gradient by drop and length follows from these two and is no target of its own.

    Parameters
    ----------
    found
        Figures of the line.
    solution
        Whose line it is.
    targets
        What was asked for, in the scale that the solver was given.
    """
    missed: list[Miss] = []
    off = found.drop - targets.drop
    if abs(off) > MET_WITHIN * targets.drop:
        missed.append(Miss("drop", off, off / targets.drop))
    off = found.length - targets.length
    if abs(off) > MET_WITHIN * targets.length:
        missed.append(Miss("length", off, off / targets.length))
    if targets.segments_mean is not None:
        off = found.mean_gradient_segments - targets.segments_mean
        if abs(off) > MET_WITHIN:
            missed.append(Miss("mean gradient", off))
    above = float(solution.gradients.max()) - targets.max_gradient
    below = float(solution.gradients.min()) - targets.min_gradient
    if max(above, -below) > MET_WITHIN:
        missed.append(Miss("limits", above if above > -below else below))
    return (*missed, *_missed_elevations(line, solution, targets))


def _missed_elevations(line: Centreline3D, solution: Solution, targets: Targets) -> tuple[Miss, ...]:
    missed = []
    for own, known in zip(targets.known, in_scale(targets, solution.scale).known, strict=True):
        off = float(np.interp(known.station, line.stations, line.elevations)) - known.elevation
        if abs(off) > known.tolerance + MET_WITHIN * targets.drop:
            missed.append((off, own.station))
    if not missed:
        return ()
    off, station = max(missed, key=lambda each: abs(each[0]))
    return (Miss("known elevations", off, station=station, count=len(missed)),)


def missed_text(missed: Sequence[Miss]) -> str:
    """Return what is missed and by how much, in words with metres and dots; "" for nothing."""
    return "; ".join(_text(miss) for miss in missed)


def _text(miss: Miss) -> str:
    size = abs(miss.off)
    if miss.target in ("drop", "length"):
        large, small = ("large", "small") if miss.target == "drop" else ("long", "short")
        percent = 100 * abs(miss.share)
        shown = f"{percent:,.0f}" if percent >= _LARGE_PERCENT else f"{percent:.3g}"
        return f"{miss.target} {shown} % too {large if miss.off > 0 else small}"
    if miss.target == "mean gradient":
        return f"mean gradient {100 * size:.2f} percentage points too {'large' if miss.off > 0 else 'small'}"
    if miss.target == "limits":
        return f"gradients up to {100 * size:.2f} percentage points beyond a limit"
    if miss.count == 1:
        return f"known elevation at {miss.station:g} m missed by {size:.2f} m"
    return f"{counted(miss.count, 'known elevation')} missed by up to {size:.2f} m"

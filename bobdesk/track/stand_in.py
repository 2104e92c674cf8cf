"""Stand-in plans: made lines with a wanted plan length and number of segments, for tracks that are not public."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from bobdesk.alignment.centreline import Centreline, fit_centreline
from bobdesk.alignment.fit_settings import FitSettings
from bobdesk.alignment.segments import Segment, Segments, stretched
from bobdesk.plan.polyline import Polyline

_TURNS = (0.5, 1.6)
_LENGTHS = (0.6, 1.4)
_RAMP = 0.25


def stand_in(length: float, segments: int, *, seed: int = 1) -> tuple[Centreline, Segments]:
    """Return a plan of straights and curves in turn, curves to either side with ramps at both ends.

    Parameters
    ----------
    length
        Plan length, m.
    segments
        How many, the first one a straight.
    seed
        The same seed gives the same plan.
    """
    random = np.random.default_rng(seed)
    lengths = random.uniform(*_LENGTHS, segments)
    lengths *= length / lengths.sum()
    edges = np.concatenate([[0.0], np.cumsum(lengths)])
    at = np.arange(0.0, length, 0.5) + 0.25
    index = np.minimum(np.searchsorted(edges, at, side="right") - 1, segments - 1)
    share = (at - edges[index]) / lengths[index]
    turns = random.uniform(*_TURNS, segments) * random.choice([-1.0, 1.0], segments)
    peaks = np.where(np.arange(segments) % 2, turns / lengths / (1 - _RAMP), 0.0)
    heading = np.cumsum(0.5 * peaks[index] * np.clip(np.minimum(share, 1 - share) / _RAMP, 0, 1))
    steps = 0.5 * np.column_stack([np.cos(heading), np.sin(heading)])
    points = np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])
    plan = resized(fit_centreline(Polyline(points), FitSettings(1.0, 0.0)), length)
    made = tuple(
        Segment("curve" if number % 2 else "straight", float(start), float(end))
        for number, (start, end) in enumerate(pairwise(edges))
    )
    return plan, stretched(made, plan.length)


def resized(plan: Centreline, length: float) -> Centreline:
    """Return a plan enlarged or reduced to a plan length, m."""
    factor = length / plan.length
    return Centreline(factor * plan.stations, factor * plan.points, factor * plan.raw_points)

"""Lines in space with exact plan and gradient, to slide down."""

import numpy as np

from bobdesk.alignment.segments import Segment
from bobdesk.track.centreline3d import Centreline3D, segment_gradients


def slope(length, gradient, *, radius=None, step=1.0, segments=None) -> Centreline3D:
    """A straight, or a circle to the left, that falls by `gradient` (a number, or one a row) per metre of plan."""
    stations = np.linspace(0.0, length, round(length / step) + 1)
    steep = np.broadcast_to(np.asarray(gradient, dtype=float), stations.shape).copy()
    falls = 0.5 * (steep[1:] + steep[:-1]) * np.diff(stations)
    heights = np.concatenate([[0.0], -np.cumsum(falls)])
    heights -= heights.min()
    turn = np.zeros_like(stations) if radius is None else stations / radius
    if radius is None:
        plan = np.column_stack([stations, np.zeros_like(stations)])
    else:
        plan = radius * np.column_stack([np.sin(turn), 1 - np.cos(turn)])
    points = np.column_stack([plan, heights])
    bend = np.full_like(stations, 0.0 if radius is None else 1 / radius)
    segments = segments or (Segment("straight" if radius is None else "curve", 0.0, length),)
    ends = np.array([segment.end for segment in segments])
    return Centreline3D(
        stations=stations,
        slope_lengths=np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]),
        points=points,
        headings=turn,
        gradients=steep,
        plan_curvature=bend,
        curvature=bend / (1 + steep**2),
        segment_of=np.minimum(np.searchsorted(ends, stations, side="right"), len(ends) - 1),
        segments=segments,
        segment_gradients=segment_gradients(stations, heights, segments),
    )

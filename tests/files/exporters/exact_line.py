"""A line in space known exactly: curvature and gradient are sums of sines of the station."""

from __future__ import annotations

import numpy as np

from bobdesk.alignment.segments import Segment
from bobdesk.track.centreline3d import Centreline3D, segment_gradients

LENGTH = 1200.0


def curvature_at(s):
    return 0.02 * np.sin(2 * np.pi * s / 300) + 0.03 * np.sin(2 * np.pi * s / 170)


def heading_at(s):
    slow = 0.02 * 300 / (2 * np.pi) * (1 - np.cos(2 * np.pi * s / 300))
    return 0.4 + slow + 0.03 * 170 / (2 * np.pi) * (1 - np.cos(2 * np.pi * s / 170))


def elevation_at(s):
    return 0.09 * (LENGTH - s) + 1.5 * (np.cos(2 * np.pi * s / 200) - 1)


def gradient_at(s):
    return 0.09 + 1.5 * 2 * np.pi / 200 * np.sin(2 * np.pi * s / 200)


def plan_at(s):
    """Integrate cos and sin of the heading with Gauss's rule over short steps: exact to 1e-12 m."""
    nodes, weights = np.polynomial.legendre.leggauss(12)
    result = np.empty((len(s), 2))
    here, last = np.zeros(2), 0.0
    for index, station in enumerate(s):
        half = 0.5 * (station - last)
        headings = heading_at(last + half * (nodes + 1))
        here = here + half * np.array([weights @ np.cos(headings), weights @ np.sin(headings)])
        result[index], last = here, station
    return result


def exact_line(*, spacing: float = 1.0, name: str = "") -> Centreline3D:
    s = np.linspace(0.0, LENGTH, round(LENGTH / spacing) + 1)
    points = np.column_stack([plan_at(s), elevation_at(s)]).round(6) + 0.0
    k, g = curvature_at(s), gradient_at(s)
    segments = (Segment("straight", 0.0, 400.0, name=name), Segment("curve", 400.0, LENGTH))
    return Centreline3D(
        stations=s,
        slope_lengths=np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]),
        points=points,
        headings=heading_at(s),
        gradients=g,
        plan_curvature=k,
        curvature=k,
        segment_of=(s >= 400.0).astype(np.int64),
        segments=segments,
        segment_gradients=segment_gradients(s, points[:, 2], segments),
    )

"""Signed curvature of a line in plan: of the fitted curve, at best quality, and as published."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.interpolate import CubicSpline

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.l1_trend import l1_curvature
from bobdesk.alignment.segmentation_settings import CurvatureMethod
from bobdesk.arrays import FloatArray


@lru_cache(maxsize=16)
def curvature(centreline: Centreline, method: CurvatureMethod = "fitted") -> FloatArray:
    """Return the curvature at every station, (n,), 1/m, left positive.

    Parameters
    ----------
    centreline
        The fitted line.
    method
        "fitted": derivatives of the smooth curve. "l1": piecewise linear curvature (straights,
        arcs and clothoids) fitted to the unsmoothed stations, the best quality. "published": the
        paper's finite differences (Eq. 1) of the unsmoothed stations, with a sign.
    """
    if method == "fitted":
        result = curvature_of_curve(centreline.stations, centreline.points)
    elif method == "l1":
        result = l1_curvature(centreline.raw_points, centreline.points, spacing=centreline.spacing)
    else:
        result = curvature_by_differences(centreline.raw_points)
    result.flags.writeable = False
    return result


@lru_cache(maxsize=16)
def heading(centreline: Centreline) -> FloatArray:
    """Return the heading at every station, (n,), rad, anticlockwise from +x, without jumps of 2π."""
    derivative = CubicSpline(centreline.stations, centreline.points)(centreline.stations, 1)
    result: FloatArray = np.unwrap(np.arctan2(derivative[:, 1], derivative[:, 0]))
    result.flags.writeable = False
    return result


def curvature_of_curve(stations: FloatArray, points: FloatArray) -> FloatArray:
    """Return the curvature of the cubic spline through points, (n,), 1/m, left positive."""
    spline = CubicSpline(stations, points)
    return plane_curvature(spline(stations, 1), spline(stations, 2))


def curvature_by_differences(points: FloatArray) -> FloatArray:
    """Return the curvature by repeated central differences, (n,), 1/m, left positive.

    The paper's Eq. 1 (there without the sign): first- and second-order finite differences of the
    coordinates at equally spaced points.
    """
    first = np.gradient(points, axis=0)
    return plane_curvature(first, np.gradient(first, axis=0))


def plane_curvature(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return (x' y'' - y' x'') / (x'^2 + y'^2)^(3/2), (n,), for derivatives of shape (n, 2)."""
    speed = np.hypot(first[:, 0], first[:, 1])
    result: FloatArray = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / np.maximum(speed, 1e-12) ** 3
    return result

"""Where a curve begins: the toe of its transition, fitted to the line itself."""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import cumulative_simpson

from bobdesk.alignment.centreline import Centreline
from bobdesk.arrays import BoolArray, FloatArray

_INTO_STRAIGHT = 40.0
_INTO_CURVE = 50.0
_BEYOND = 3.0
_STEP = 0.5
_RAMPS = np.array([0.5, 3.0, 6.0, 9.0, 12.0, 16.0, 20.0, 25.0, 30.0, 36.0, 42.0, 50.0])
_ALIKE_OVER = 5.0
_SMALLEST_NOISE = 0.03
_FEWEST_STATIONS = 8
# Stations nearer than this tell nothing new, as the noise is alike over metres, but cost as much.
_FINEST = 0.25


def fit_boundaries(
    centreline: Centreline, curvature: FloatArray, boundaries: FloatArray, curved: BoolArray
) -> FloatArray:
    """Move each boundary between a straight and a curve to where the curvature leaves zero.

    A curvature threshold is crossed inside a transition curve, up to 8 m late where it is long. So
    beside each boundary a straight, a ramp of the curvature and a constant curvature are fitted to
    the unsmoothed stations (least squares of the offsets, over all toes and ramp lengths of a grid),
    and the toe is the mean over the grid, weighted by likelihood. The noise is taken to be alike
    over 5 m, as digitising is, and at least 0.03 m, so that a fit is not trusted beyond its worth.

    Parameters
    ----------
    centreline
        The fitted line.
    curvature : (n,)
        Its curvature, 1/m.
    boundaries : (b,)
        Stations, m, ascending.
    curved : (b+1,)
        Whether each segment is a curve.

    Returns
    -------
    The boundaries, (b,), m; those between two segments of a kind are left where they are.
    """
    stations = centreline.stations
    offsets = _unrolled(centreline, curvature)
    edges = np.concatenate([[0.0], boundaries, [stations[-1]]])
    lengths = np.diff(edges)
    fitted = boundaries.copy()
    last = len(boundaries) - 1
    every = max(1, math.ceil(_FINEST / centreline.spacing - 1e-9))
    for index, boundary in enumerate(boundaries):
        if curved[index] == curved[index + 1]:
            continue
        backwards = bool(curved[index])
        straight, curve = (index + 1, index) if backwards else (index, index + 1)
        at_end = index == (last if backwards else 0)
        into_straight = min(lengths[straight] * (1.0 if at_end else 0.5), _INTO_STRAIGHT)
        into_curve = min(lengths[curve] * 0.5, _INTO_CURVE)
        low, high = (
            (boundary - into_curve, boundary + into_straight)
            if backwards
            else (boundary - into_straight, boundary + into_curve)
        )
        first, beyond = np.searchsorted(stations, low), np.searchsorted(stations, high, side="right")
        window = slice(int(first), int(beyond), every)
        along = (boundary - stations[window])[::-1] if backwards else stations[window] - boundary
        across = offsets[window][::-1] if backwards else offsets[window]
        toe = _toe(along, across, every * centreline.spacing)
        if toe is not None:
            fitted[index] = boundary - toe if backwards else boundary + toe
    return np.maximum.accumulate(fitted)


def _unrolled(centreline: Centreline, curvature: FloatArray) -> FloatArray:
    """Return the line's offsets as if it were unrolled about its heading, (n,), m.

    That is the curvature integrated twice, plus the distance of the unsmoothed from the smoothed stations.
    """
    spacing = centreline.spacing
    tangent = np.gradient(centreline.points, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    apart = centreline.raw_points - centreline.points
    beside = apart[:, 1] * tangent[:, 0] - apart[:, 0] * tangent[:, 1]
    turned = cumulative_simpson(curvature, dx=spacing, initial=0.0)
    offsets: FloatArray = cumulative_simpson(turned, dx=spacing, initial=0.0) + beside
    return offsets


def _toe(along: FloatArray, across: FloatArray, spacing: float) -> float | None:
    """Return where the curvature leaves zero in a window whose straight comes first, m, or None."""
    if len(along) < _FEWEST_STATIONS:
        return None
    ramps = _RAMPS[max(along[-1], _RAMPS[0]) >= _RAMPS]
    toes, ramps = (grid.ravel() for grid in np.meshgrid(np.arange(along[0], _BEYOND, _STEP), ramps, indexing="ij"))
    past_toe = np.maximum(along - toes[:, None], 0.0) ** 3
    past_ramp = np.maximum(along - (toes + ramps)[:, None], 0.0) ** 3
    shapes = (past_toe - past_ramp) / (6 * ramps[:, None])

    line, _ = np.linalg.qr(np.column_stack([np.ones_like(along), along]))
    bent = across - line @ (line.T @ across)
    shapes -= (shapes @ line) @ line.T
    power = (shapes**2).sum(axis=1)
    explained = np.divide((shapes @ bent) ** 2, power, out=np.zeros_like(power), where=power > 1e-12)
    misfit = bent @ bent - explained
    variance = max(misfit.min() / len(along), _SMALLEST_NOISE**2)
    alike = max(1.0, _ALIKE_OVER / spacing)
    weight = np.exp(-(misfit - misfit.min()) / (2 * variance * alike))
    return float((weight * toes).sum() / weight.sum())

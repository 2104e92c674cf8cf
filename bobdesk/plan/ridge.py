"""Where a line runs: ridges of the ink, from the Hessian at the scale of the line's width."""

from __future__ import annotations

from collections.abc import Generator

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from bobdesk.arrays import FloatArray
from bobdesk.plan.raster import Float32Array
from bobdesk.plan.stages import at_fraction, at_once

SCALES = (0.8, 1.2, 1.8, 2.7, 4.0, 6.0)
# Off the line a step costs 1 / _FLOOR = 50 times a step on it.
_FLOOR = 0.02
_WIDEST_STROKE = 40.0
_SCALE_OF_WIDTH = 0.3


def ridge(ink: Float32Array, *, sigma: float) -> Generator[float, None, Float32Array]:
    """Strength (h, w) >= 0 of bright ridges at `sigma` pixels; yields the fraction done.

    Minus the smaller eigenvalue of the Hessian, times sigma^1.5, so that the scale nearest to a line's
    width answers most.

    References
    ----------
    T. Lindeberg, Edge detection and ridge detection with automatic scale selection, IJCV 30 (1998).
    """
    xx = ndimage.gaussian_filter(ink, sigma, order=(0, 2))
    yield 0.25
    yy = ndimage.gaussian_filter(ink, sigma, order=(2, 0))
    yield 0.5
    xy = ndimage.gaussian_filter(ink, sigma, order=(1, 1))
    yield 0.75
    strength = np.hypot(0.5 * (xx - yy), xy) - 0.5 * (xx + yy)
    np.clip(strength, 0, None, out=strength)
    strength *= np.float32(sigma**1.5)
    yield 1.0
    return np.asarray(strength, dtype=np.float32)


def _around(ink: Float32Array, x: float, y: float, outer: int) -> tuple[Float32Array, FloatArray]:
    """Return the ink within `outer` pixels of a point, and each pixel's distance from it."""
    column = int(np.clip(x, 0, ink.shape[1] - 1))
    row = int(np.clip(y, 0, ink.shape[0] - 1))
    top, left = max(0, row - outer), max(0, column - outer)
    window = ink[top : row + outer + 1, left : column + outer + 1]
    rows, columns = np.mgrid[0 : window.shape[0], 0 : window.shape[1]]
    return window, np.hypot(rows + top - y, columns + left - x)


def strength_near(ink: Float32Array, clicks: FloatArray, *, sigma: float, reach: float = 7.0) -> tuple[float, float]:
    """Return the ridge strength at `sigma` on the line at the clicks (n, 2), and that of the noise around.

    The medians over the clicks of the largest strength near by and of the usual strength in the window.
    """
    lines, noises = [], []
    outer = int(4 * sigma + 3 * reach)
    for x, y in clicks:
        window, away = _around(ink, x, y, outer)
        near = np.exp(-(np.clip(away - 0.7 * reach, 0, None) ** 2) / (2 * (0.25 * reach) ** 2))
        strength = at_once(ridge(window, sigma=sigma))
        lines.append(float((strength * near).max()))
        noises.append(float(np.median(strength)))
    return float(np.median(lines)), float(np.median(noises))


def stroke_width(ink: Float32Array, clicks: FloatArray, *, reach: float = 7.0) -> float:
    """Return the width of the stroke at the clicks (n, 2), pixels; the least of them, since labels are wider."""
    widths = []
    outer = int(_WIDEST_STROKE / 2 + reach)
    for x, y in clicks:
        window, away = _around(ink, x, y, outer)
        near = away <= reach
        inside = ndimage.distance_transform_edt(window > 0.5 * window[near].max())
        widths.append(2 * float(inside[near].max()) - 1)
    return min(widths)


def scale_at(ink: Float32Array, clicks: FloatArray) -> tuple[float, float]:
    """Return the ridge scale at which the line at the clicks (n, 2) stands out most, and its strength there.

    Without noise that is the scale of the line's width; grain answers at the smallest scales, and so
    does the sharp edge of a broad stroke, for which reason scales far below its width are left out.
    """
    narrowest = min(_SCALE_OF_WIDTH * stroke_width(ink, clicks), SCALES[-1])
    scales = [sigma for sigma in SCALES if sigma >= narrowest]
    answers = np.array([strength_near(ink, clicks, sigma=sigma) for sigma in scales])
    strengths, noises = answers[:, 0], answers[:, 1]
    best = int((strengths / (0.15 * strengths.max() + 6.0 * noises + 1e-9)).argmax())
    return scales[best], float(strengths[best])


def ridge_score(
    ink: Float32Array, *, sigmas: tuple[float, ...], reference: float
) -> Generator[float, None, Float32Array]:
    """Return the largest ridge strength over `sigmas`, 1 at `reference` and beyond; (h, w)."""
    score = np.zeros_like(ink)
    for index, sigma in enumerate(sigmas):
        strength = yield from at_fraction(ridge(ink, sigma=sigma), index / len(sigmas))
        np.maximum(score, strength, out=score)
    score /= np.float32(max(reference, 1e-6))
    return np.minimum(score, np.float32(1.0))


def step_cost(score: Float32Array) -> Float32Array:
    """Cost of a step of one pixel: nearly 1 on the line, 50 far from any."""
    return np.asarray(1.0 / (np.float32(_FLOOR) + score * score), dtype=np.float32)


def ridge_normals(
    ink: Float32Array, rows: npt.NDArray[np.intp], columns: npt.NDArray[np.intp], *, sigma: float = 1.5
) -> FloatArray:
    """Angle (n,) from +x towards +y of the normal of the ridge at some pixels, 0 to pi."""
    xx = ndimage.gaussian_filter(ink, sigma, order=(0, 2))[rows, columns]
    yy = ndimage.gaussian_filter(ink, sigma, order=(2, 0))[rows, columns]
    xy = ndimage.gaussian_filter(ink, sigma, order=(1, 1))[rows, columns]
    # The ink bends down most along the normal.
    return np.asarray((0.5 * np.arctan2(-2.0 * xy, yy - xx)) % np.pi, dtype=np.float64)


def ridge_along(score: Float32Array, path: FloatArray) -> Float32Array:
    """Return the largest ridge score (n,) on and beside the points of a path (n, 2)."""
    near = ndimage.maximum_filter(score, size=3)
    columns = np.clip(np.round(path[:, 0]).astype(np.intp), 0, score.shape[1] - 1)
    rows = np.clip(np.round(path[:, 1]).astype(np.intp), 0, score.shape[0] - 1)
    return np.asarray(near[rows, columns])

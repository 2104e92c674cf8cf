"""Grid lines and frames: straight lines from one side of the picture to the other, which no track is.

A grid in the colour of the line is a short cut for a cheapest path; known as a grid, it loses its ridge.
"""

from __future__ import annotations

from collections.abc import Generator

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from bobdesk.arrays import FloatArray
from bobdesk.plan.raster import Float32Array
from bobdesk.plan.ridge import ridge_normals

# A line is straight enough across the picture if it covers this share of it …
_COVERED = 0.6
# … looked at in pieces of this many pixels.
_PIECE = 6
_NEAR_ANGLE = np.deg2rad(7.0)
_MOST_PIXELS = 150_000
# What is left of a grid line's ridge.
_LEFT = 0.15


def _between(first: FloatArray, second: float) -> FloatArray:
    """Absolute angle between undirected directions."""
    return np.abs((first - second + np.pi / 2) % np.pi - np.pi / 2)


def without_straight_lines(score: Float32Array, ink: Float32Array) -> Generator[float, None, Float32Array]:
    """Return the ridge score (h, w) with straight lines across the whole picture weakened.

    Where a line's ridge is clearly stronger than the straight line's own, as where a track crosses a light
    grid, it is left as it is.
    """
    height, width = score.shape
    rows, columns = np.nonzero(score > 0.12)
    if len(rows) < 50:
        return score
    angles = ridge_normals(ink, rows, columns)
    yield 0.3
    keep = slice(None, None, max(1, len(rows) // _MOST_PIXELS))
    x = columns[keep].astype(np.float64) - width / 2
    y = rows[keep].astype(np.float64) - height / 2
    result = score.copy()
    histogram, _ = np.histogram(angles, bins=90, range=(0, np.pi))
    smooth = ndimage.gaussian_filter1d(histogram.astype(np.float64), 1.0, mode="wrap")
    for turn in range(2):
        coarse = (int(smooth.argmax()) + 0.5) * np.pi / 90
        near = _between(angles[keep], coarse) < _NEAR_ANGLE
        found = _parallel_lines(x[near], y[near], coarse=coarse, height=height, width=width)
        yield 0.5 + 0.2 * turn
        if found is not None:
            angle, distances = found
            _weaken(result, score, rows, columns, angles, angle=angle, distances=distances)
        around = _between((np.arange(90) + 0.5) * np.pi / 90, coarse) < 2 * _NEAR_ANGLE
        smooth[around] = 0.0
        yield 0.6 + 0.2 * turn
    return result


def _parallel_lines(
    x: FloatArray, y: FloatArray, *, coarse: float, height: int, width: int
) -> tuple[float, FloatArray] | None:
    """Return the common normal angle of straight lines near `coarse` and their distances from the middle."""
    if len(x) < 50:
        return None
    half = int(np.hypot(height, width) / 2) + 2
    best_angle, best_peak = coarse, -1.0
    for angle in coarse + np.deg2rad(np.arange(-2.5, 2.51, 0.1)):
        counts = np.bincount((x * np.cos(angle) + y * np.sin(angle) + half).astype(np.intp), minlength=2 * half)
        peak = float((counts.astype(np.float64) ** 2).sum())
        if peak > best_peak:
            best_angle, best_peak = float(angle), peak
    across = x * np.cos(best_angle) + y * np.sin(best_angle) + half
    along = -x * np.sin(best_angle) + y * np.cos(best_angle) + half
    pieces = 2 * half // _PIECE + 1
    covered = np.zeros((2 * half + 1, pieces), dtype=bool)
    covered[across.astype(np.intp), (along / _PIECE).astype(np.intp)] = True
    covered[:-1] |= covered[1:]
    lengths = _PIECE * covered.sum(axis=1)
    distances = np.arange(2 * half + 1, dtype=np.float64) - half + 1.0
    chords = _chords(distances, angle=best_angle, height=height, width=width)
    straight = (lengths > _COVERED * chords) & (chords > 0.25 * min(height, width))
    if not straight.any():
        return None
    return best_angle, distances[straight]


def _chords(distances: FloatArray, *, angle: float, height: int, width: int) -> FloatArray:
    """Length inside the picture of the straight lines with this normal angle and these distances."""
    half = np.hypot(height, width) / 2
    steps = np.arange(-half, half, 4.0)
    x = distances[:, None] * np.cos(angle) - steps * np.sin(angle)
    y = distances[:, None] * np.sin(angle) + steps * np.cos(angle)
    return np.asarray(4.0 * ((np.abs(x) < width / 2) & (np.abs(y) < height / 2)).sum(axis=1), dtype=np.float64)


def _weaken(
    result: Float32Array,
    score: Float32Array,
    rows: npt.NDArray[np.intp],
    columns: npt.NDArray[np.intp],
    angles: FloatArray,
    *,
    angle: float,
    distances: FloatArray,
) -> None:
    """Weaken in `result` the pixels that lie on one of the lines and along it."""
    height, width = score.shape
    across = (columns - width / 2) * np.cos(angle) + (rows - height / 2) * np.sin(angle)
    order = np.clip(np.searchsorted(distances, across), 1, max(1, len(distances) - 1))
    after = distances[np.minimum(order, len(distances) - 1)]
    gap = np.minimum(np.abs(across - distances[order - 1]), np.abs(across - after))
    on_line = (gap < 2.0) & (_between(angles, angle) < 2 * _NEAR_ANGLE)
    if not on_line.any():
        return
    strengths = score[rows[on_line], columns[on_line]]
    usual = strengths <= 1.5 * float(np.median(strengths)) + 0.05
    result[rows[on_line][usual], columns[on_line][usual]] *= np.float32(_LEFT)

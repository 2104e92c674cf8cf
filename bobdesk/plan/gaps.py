"""Lines with gaps: dashes are joined where the ends of two of them point at each other."""

from __future__ import annotations

from collections.abc import Generator
from itertools import groupby

import numpy as np
from scipy import ndimage

from bobdesk.arrays import FloatArray, IntArray
from bobdesk.plan.raster import Float32Array
from bobdesk.plan.ridge import ridge_along, ridge_normals

_INK = 0.3
_MOST_VOTES = 3_000_000
_SHORTEST, _LONGEST = 2, 60


def gap_lengths(score: Float32Array, path: FloatArray) -> IntArray:
    """Return the lengths (k,), in points, of the stretches of `path` (n, 2) without ridge, its ends apart."""
    empty = ridge_along(score, path) < _INK
    runs = [(blank, len(list(points))) for blank, points in groupby(empty.tolist())]
    return np.array([length for blank, length in runs[1:-1] if blank], dtype=np.int64)


def typical_gap(score: Float32Array, path: FloatArray) -> float:
    """Return the length of the gaps of a dashed line along `path`, in pixels, or 0 for a whole line."""
    lengths = gap_lengths(score, path)
    gaps = lengths[(lengths >= _SHORTEST) & (lengths <= _LONGEST)]
    if len(gaps) < 4 or lengths.sum() < 0.06 * len(path):
        return 0.0
    return float(np.quantile(gaps, 0.75)) + 2.0


def bridged(
    score: Float32Array, ink: Float32Array, *, gap: float, worth: float
) -> Generator[float, None, Float32Array]:
    """Return the ridge score (h, w) with gaps of up to some `gap` pixels closed.

    Every ridge pixel votes along its line, forwards and backwards; a pixel with votes from both sides lies
    between two dashes.  A bridge has the share `worth` of the ridge at its ends.
    """
    rows, columns = np.nonzero(score > _INK)
    reach = np.arange(1.0, gap + 4.0)
    thin = slice(None, None, max(1, len(rows) * len(reach) // _MOST_VOTES))
    normal = ridge_normals(ink, rows, columns)[thin]
    rows, columns = rows[thin], columns[thin]
    values = score[rows, columns]
    height, width = score.shape
    yield 0.2
    result = score.copy()
    # "Forwards" must change sign somewhere; lines along that cut are seen with the other one.
    for index, cut in enumerate((0.0, np.pi / 2)):
        along = (normal + np.pi / 2 - cut) % np.pi + cut
        sides = []
        for sign in (1.0, -1.0):
            votes = np.zeros((height, width), dtype=np.float32)
            for distance in reach:
                x = np.clip(np.rint(columns + sign * distance * np.cos(along)).astype(np.intp), 0, width - 1)
                y = np.clip(np.rint(rows + sign * distance * np.sin(along)).astype(np.intp), 0, height - 1)
                np.maximum.at(votes, (y, x), values)
            yield 0.3 + 0.4 * index
            sides.append(ndimage.maximum_filter(votes, size=3))
            yield 0.4 + 0.4 * index
        np.maximum(result, np.float32(worth) * np.minimum(*sides), out=result)
    yield 1.0
    return result

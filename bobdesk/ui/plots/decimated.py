"""Curves of any number of points brought to what a screen can show, with every peak kept."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from bobdesk.arrays import FloatArray

MOST_POINTS = 2000


def decimated(x: FloatArray, y: FloatArray, *, most: int = MOST_POINTS) -> tuple[FloatArray, FloatArray]:
    """Return at most `most` points of the curve (n,), (n,): the lowest and highest of each bin, in order."""
    count = len(x)
    if count <= most:
        return x, y
    bins = most // 2
    edges = np.linspace(0, count, bins + 1).astype(np.intp).tolist()
    bounds = tuple(pairwise(edges))
    lowest = np.array([first + int(y[first:last].argmin()) for first, last in bounds])
    highest = np.array([first + int(y[first:last].argmax()) for first, last in bounds])
    chosen = np.sort(np.concatenate([lowest, highest]))
    return x[chosen], y[chosen]

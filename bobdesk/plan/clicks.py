"""Clicks on a line: whether they can be used, the ridge beside them, and where they cut the line."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.plan.cheapest_path import Pixel
from bobdesk.plan.polyline_geometry import arc_lengths, nearest_station
from bobdesk.plan.raster import Float32Array, Pixels
from bobdesk.plan.refine import Refined

# A line that ends less than this before the click ends at the click, pixels.
_SAME_END = 1.5
# The outermost pixels reach this far beyond their centres.
_EDGE = 0.5


def checked_clicks(pixels: Pixels, clicks: npt.ArrayLike) -> FloatArray:
    """Return the clicks as (k, 2) or raise InputError: too few, outside the picture, twice the same."""
    points = np.asarray(clicks, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2:
        raise InputError("A line is traced from at least two points: its start and its finish.")
    height, width = pixels.shape[:2]
    for x, y in points:
        if not (np.isfinite(x) and np.isfinite(y)):
            raise InputError("A point of the line is not a number.")
        if not (-_EDGE <= x <= width - 1 + _EDGE and -_EDGE <= y <= height - 1 + _EDGE):
            raise InputError(f"The point {x:g},{y:g} lies outside the picture of {width} x {height} pixels.")
    steps = np.diff(points, axis=0)
    for index in np.flatnonzero(np.hypot(steps[:, 0], steps[:, 1]) < 1.0):
        x, y = points[index]
        raise InputError(f"Two points in a row are the same place, {x:.0f},{y:.0f}; leave one of them out.")
    return points


def snapped(score: Float32Array, click: FloatArray, *, reach: float) -> Pixel:
    """Return the pixel (row, column) with the most ridge (h, w) near `click`, near ones first."""
    height, width = score.shape
    column = int(np.clip(round(float(click[0])), 0, width - 1))
    row = int(np.clip(round(float(click[1])), 0, height - 1))
    outer = int(np.ceil(reach))
    top, left = max(0, row - outer), max(0, column - outer)
    window = score[top : row + outer + 1, left : column + outer + 1]
    rows, columns = np.mgrid[0 : window.shape[0], 0 : window.shape[1]]
    away = np.hypot(rows + top - click[1], columns + left - click[0])
    weighted = window * np.exp(-(np.clip(away - 0.4 * reach, 0, None) ** 2) / (2 * (0.4 * reach) ** 2))
    best = np.unravel_index(int(weighted.argmax()), weighted.shape)
    return top + int(best[0]), left + int(best[1])


def ends_at_clicks(line: Refined, clicks: FloatArray, *, slack: float, dashed: bool) -> tuple[float, float]:
    """Return the stations of `line`, prolonged at both ends, at which the line starts and finishes.

    That is beside the first and the last click; or before, by up to `slack` pixels, where the ink ends and
    plain background begins.  A dashed line ends at its clicks: its end may lie in a gap.
    """
    along = arc_lengths(line.points)
    reach = 3 * slack + 10
    first = along <= reach
    last = along >= along[-1] - reach
    start = nearest_station(line.points[first], position=clicks[0])
    finish = float(along[last][0]) + nearest_station(line.points[last], position=clicks[-1])
    if dashed:
        return start, finish
    start = _ink_from(along, line, start, slack=slack)
    mirrored = Refined(line.points, line.fit[::-1], line.strength[::-1], line.blank[::-1], line.width)
    total = float(along[-1])
    finish = total - _ink_from(total - along[::-1], mirrored, total - finish, slack=slack)
    return start, finish


def _ink_from(along: FloatArray, line: Refined, start: float, *, slack: float) -> float:
    """Return the station from which on there is ink, or `start` where there is or something hides it."""
    after = np.flatnonzero(along >= start)
    inked = after[line.strength[after] >= 0.5]
    if len(inked) == 0:
        return start
    index = int(inked[0])
    if index == 0 or line.strength[index - 1] >= 0.5:
        return start
    rise = float(line.strength[index] - line.strength[index - 1])
    part = (0.5 - float(line.strength[index - 1])) / max(rise, 1e-9)
    station = float(along[index - 1] + part * (along[index] - along[index - 1]))
    before = (along >= start) & (along < station - _SAME_END)
    hidden = before.any() and float(np.mean(line.blank[before])) < 0.7
    if station - start < _SAME_END or station - start > slack or hidden:
        return start
    return station

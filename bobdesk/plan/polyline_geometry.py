"""Questions about polylines (n, 2): lengths, normals, nearest points, crossings, offsets, smoothing.

scipy and shapely are imported where they are called: a project is shown before they are loaded.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray, IntArray


@dataclass(frozen=True)
class Crossing:
    """A polyline crosses itself at (x, y), `first` and `second` along it (same unit as the points)."""

    x: float
    y: float
    first: float
    second: float


def arc_lengths(points: FloatArray) -> FloatArray:
    """Return the distance along the polyline at each point, (n,), from 0."""
    steps = np.hypot(np.diff(points[:, 0]), np.diff(points[:, 1]))
    return np.concatenate([[0.0], np.cumsum(steps)])


def resampled(points: FloatArray, *, step: float) -> FloatArray:
    """Return points at equal distances of about `step` along the polyline, both ends kept."""
    keep = np.concatenate([[True], np.any(np.diff(points, axis=0) != 0, axis=1)])
    points = points[keep]
    if len(points) < 2:
        return np.repeat(points, 2, axis=0)
    along = arc_lengths(points)
    count = max(1, round(along[-1] / step))
    wanted = np.linspace(0.0, along[-1], count + 1)
    return np.column_stack([np.interp(wanted, along, points[:, axis]) for axis in (0, 1)])


def normals(points: FloatArray) -> FloatArray:
    """Return the unit normals (n, 2), a quarter turn from the way (dx, dy) to (-dy, dx)."""
    way = np.gradient(points, axis=0)
    way /= np.maximum(np.hypot(way[:, 0], way[:, 1]), 1e-12)[:, None]
    return np.column_stack([-way[:, 1], way[:, 0]])


def gaussian_smoothed(points: FloatArray, *, sigma: float) -> FloatArray:
    """Smooth equally spaced points with a Gaussian of `sigma` points; the ends stay where they are."""
    from scipy import ndimage

    reach = min(int(4 * sigma) + 1, len(points) - 1)
    if reach < 1:
        return points
    before = 2 * points[0] - points[reach:0:-1]
    after = 2 * points[-1] - points[-2 : -reach - 2 : -1]
    padded = np.concatenate([before, points, after])
    smooth = ndimage.gaussian_filter1d(padded, sigma, axis=0)
    return np.asarray(smooth[reach : reach + len(points)], dtype=np.float64)


def whittaker_smoothed(values: FloatArray, *, weights: FloatArray, wavelength: float) -> FloatArray:
    """Smooth equally spaced values (n, k) with `weights` (n,) by a penalty on third differences.

    Where weights are nearly nothing the values go on with the curvature of both sides.  `wavelength` is
    the half-power wavelength in points at weight 1.

    References
    ----------
    P. H. C. Eilers, A perfect smoother, Analytical Chemistry 75 (2003).
    """
    from scipy.linalg import solveh_banded

    count = len(values)
    if count < 5:
        return values
    penalty = (wavelength / (2 * np.pi)) ** 6
    bands = np.zeros((4, count))
    coefficients = (-1.0, 3.0, -3.0, 1.0)
    for i in range(4):
        for j in range(i, 4):
            bands[3 - (j - i), j : count - 3 + j] += penalty * coefficients[i] * coefficients[j]
    bands[3] += weights
    return np.asarray(solveh_banded(bands, values * weights[:, None]), dtype=np.float64)


def turns(points: FloatArray, middle: IntArray, *, gap: int, arm: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the ways (n, 2) into and out of the points with indices `middle`, and the angles between them, degrees.

    A way is the direction over `arm` points; the nearest `gap` points to the middle are left out.
    """
    incoming = points[middle - gap] - points[middle - gap - arm]
    outgoing = points[middle + gap + arm] - points[middle + gap]
    incoming /= np.maximum(np.hypot(incoming[:, 0], incoming[:, 1]), 1e-9)[:, None]
    outgoing /= np.maximum(np.hypot(outgoing[:, 0], outgoing[:, 1]), 1e-9)[:, None]
    cosine = np.clip((incoming * outgoing).sum(axis=1), -1.0, 1.0)
    return incoming, outgoing, np.degrees(np.arccos(cosine))


def extended(points: FloatArray, *, length: float, step: float) -> FloatArray:
    """Return the polyline prolonged straight by `length` at both ends, in steps of about `step`."""
    reach = min(len(points) - 1, 5)
    count = max(1, int(np.ceil(length / step)))
    distances = np.arange(1, count + 1)[:, None] * (length / count)
    start_way = points[0] - points[reach]
    end_way = points[-1] - points[-1 - reach]
    start_way /= max(float(np.hypot(*start_way)), 1e-12)
    end_way /= max(float(np.hypot(*end_way)), 1e-12)
    return np.concatenate([(points[0] + distances * start_way)[::-1], points, points[-1] + distances * end_way])


def nearest_station(points: FloatArray, *, position: FloatArray) -> float:
    """Return the distance along the polyline of its point nearest to `position` (2,)."""
    import shapely

    return float(shapely.LineString(points).project(shapely.Point(position[0], position[1])))


def nearest_vertex(points: FloatArray, *, position: FloatArray) -> int:
    """Return the index of the vertex nearest to `position` (2,)."""
    return int(((points - position) ** 2).sum(axis=1).argmin())


def part_between(points: FloatArray, *, start: float, end: float) -> FloatArray:
    """Return the polyline from `start` to `end` along it, both cut exactly."""
    along = arc_lengths(points)
    start, end = max(0.0, start), min(float(along[-1]), end)
    inside = (along > start + 1e-9) & (along < end - 1e-9)
    cuts = np.column_stack([np.interp([start, end], along, points[:, axis]) for axis in (0, 1)])
    return np.concatenate([cuts[:1], points[inside], cuts[1:]])


def self_crossings(points: FloatArray) -> tuple[Crossing, ...]:
    """Return where the polyline crosses or touches itself, in order of the first passing.

    Every pair of edges that are not neighbours is looked at through a tree: n log n for tracks.
    """
    import shapely

    edges = shapely.linestrings(np.stack([points[:-1], points[1:]], axis=1))
    first, second = shapely.STRtree(edges).query(edges, predicate="intersects")
    apart = second > first + 1
    first, second = first[apart], second[apart]
    along = arc_lengths(points)
    found: list[Crossing] = []
    for i, j in sorted(zip(first.tolist(), second.tolist(), strict=True)):
        if np.all(points[i] == points[j + 1]):
            continue  # a closed line meets itself where it began
        spot = shapely.centroid(shapely.intersection(edges[i], edges[j]))
        x, y = float(spot.x), float(spot.y)
        one = float(along[i] + np.hypot(x - points[i, 0], y - points[i, 1]))
        two = float(along[j] + np.hypot(x - points[j, 0], y - points[j, 1]))
        same = found and abs(found[-1].first - one) < 1e-6 and abs(found[-1].second - two) < 1e-6
        if not same:
            found.append(Crossing(x, y, one, two))
    return tuple(found)


def offset_line(points: FloatArray, *, distance: float) -> FloatArray:
    """Return the polyline shifted by `distance` along its normals (see `normals`), loops cut out."""
    import shapely

    # shapely's positive side is to the left with y up; our normal (-dy, dx) is that same side.
    line = shapely.LineString(points).offset_curve(distance, quad_segs=16, join_style="round")
    if line.geom_type == "MultiLineString":
        line = max(line.geoms, key=lambda part: part.length)
    return np.asarray(line.coords, dtype=np.float64)


def simplified(points: FloatArray, *, tolerance: float) -> FloatArray:
    """Return fewer vertices, none of the old ones further than `tolerance` from the new line."""
    import shapely

    return np.asarray(shapely.LineString(points).simplify(tolerance).coords, dtype=np.float64)


def simplified_indices(points: FloatArray, *, tolerance: float) -> IntArray:
    """Return the indices of the vertices that `simplified` keeps."""
    kept = {(float(x), float(y)) for x, y in simplified(points, tolerance=tolerance)}
    flags = [(float(x), float(y)) in kept for x, y in points]
    return np.flatnonzero(flags).astype(np.int64)

"""One line or two edges: what the ink across a rough path says, and the way along the middle.

A path along a double line rides one edge, then the other.  The distance of the edges shows in the
autocorrelation of the ink across the path, wherever the path lies; the middle is then the way along which
there is ink at half that distance on both sides.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from bobdesk.arrays import FloatArray
from bobdesk.plan.polyline_geometry import gaussian_smoothed, normals, resampled
from bobdesk.plan.raster import Float32Array

# Sampling of the ink across and along the path, in copy pixels.
_ACROSS = 0.5
_ALONG = 1.5
# Cost of a sideways step of _ACROSS between two stations, in units of ink.
_SIDEWAYS = 0.06
_MOST_SIDEWAYS = 3
# A path is off its line by no more than this (copy pixels), apart from the distance of the edges.
_PATH_ERROR = 3.0


@dataclass(frozen=True)
class CrossSection:
    """What a line looks like across, in copy pixels: `width` over all, `edges` apart or None for one line."""

    width: float
    edges: float | None


def ink_across(ink: Float32Array, points: FloatArray, *, reach: float) -> Float32Array:
    """Return the ink (n, 2 m + 1) at distances -reach … reach along the normals of `points` (n, 2)."""
    half = int(np.ceil(reach / _ACROSS))
    distances = np.arange(-half, half + 1) * _ACROSS
    across = normals(gaussian_smoothed(points, sigma=2.0))
    x = points[:, :1] + across[:, :1] * distances
    y = points[:, 1:] + across[:, 1:] * distances
    return np.asarray(ndimage.map_coordinates(ink, [y, x], order=1, mode="nearest"), dtype=np.float32)


def autocorrelation(profiles: Float32Array) -> FloatArray:
    """Return the typical autocorrelation of profiles (n, m) at lags 0 … m // 2 samples, 1 at lag 0."""
    floor = np.quantile(profiles, 0.3, axis=1, keepdims=True)
    above = np.clip(profiles - floor, 0, None)
    power = (above * above).sum(axis=1)
    written = power >= 0.25 * np.quantile(power, 0.9)
    above, power = above[written], power[written]
    lags = profiles.shape[1] // 2 + 1
    result = np.empty(lags)
    for lag in range(lags):
        products = (above[:, : above.shape[1] - lag] * above[:, lag:]).sum(axis=1)
        result[lag] = np.median(products / np.maximum(power, 1e-9))
    return result


def cross_section(profiles: Float32Array) -> CrossSection:
    """Tell one line from two edges by the autocorrelation of profiles across a rough path."""
    likeness = autocorrelation(profiles)
    below = np.flatnonzero(likeness < 0.5)
    half = int(below[0]) if len(below) else len(likeness) - 1
    before = likeness[max(half - 1, 0)]
    part = (before - 0.5) / max(before - likeness[half], 1e-9) if half else 0.0
    # A bar of width w is half like itself at a lag of w / 2.
    width = max(1.0, 2.0 * (half - 1 + part) * _ACROSS)
    dips = np.minimum.accumulate(likeness)
    rise = likeness - dips
    rise[: max(3, half)] = 0.0
    lag = int(rise.argmax())
    if rise[lag] < 0.15 or likeness[lag] < 0.22 or likeness[lag] < 1.6 * dips[lag]:
        return CrossSection(width=width, edges=None)
    return CrossSection(width=width + lag * _ACROSS, edges=lag * _ACROSS)


def _shifted(profiles: Float32Array, samples: int) -> Float32Array:
    """Profiles read `samples` further out; beyond the end there is no ink."""
    result = np.zeros_like(profiles)
    if samples >= 0:
        result[:, : profiles.shape[1] - samples] = profiles[:, samples:]
    else:
        result[:, -samples:] = profiles[:, :samples]
    return result


def middle_score(profiles: Float32Array, *, section: CrossSection) -> Float32Array:
    """Return (n, m): how much each place across the path looks like the middle of the line, about 0 to 1."""
    if section.edges is not None:
        apart = section.edges / _ACROSS
        low, high = int(np.floor(apart / 2)), int(np.ceil(apart / 2))
        widened = ndimage.maximum_filter1d(profiles, 3, axis=1)
        pair = np.minimum(_shifted(widened, high), _shifted(widened, -high))
        if low != high:
            pair = np.maximum(pair, np.minimum(_shifted(widened, low), _shifted(widened, -low)))
        # One edge alone still says a little, so that a broken edge does not let go of the line.
        one = np.maximum(_shifted(widened, high), _shifted(widened, -high))
        return np.asarray(pair + np.float32(0.25) * one, dtype=np.float32)
    inside = max(1, round(section.width / _ACROSS)) | 1
    outside = 2 * inside + 5
    mean_in = ndimage.uniform_filter1d(profiles, inside, axis=1, mode="nearest")
    mean_all = ndimage.uniform_filter1d(profiles, outside, axis=1, mode="nearest")
    return np.asarray(np.clip(mean_in - 0.7 * mean_all, 0, None) * 1.5, dtype=np.float32)


def best_way(score: Float32Array) -> Generator[float, None, FloatArray]:
    """Return the place across (n,), in samples, of the smoothest way with the most score (n, m).

    Dynamic programming over the stations; a way moves at most three samples sideways a station.
    """
    count, places = score.shape
    steps = np.arange(-_MOST_SIDEWAYS, _MOST_SIDEWAYS + 1)
    penalty = (_SIDEWAYS * np.abs(steps)).astype(np.float32)[:, None]
    came_from = np.zeros((count, places), dtype=np.int8)
    padded = np.full(places + 2 * _MOST_SIDEWAYS, -1e9, dtype=np.float32)
    inner = slice(_MOST_SIDEWAYS, _MOST_SIDEWAYS + places)
    windows = np.lib.stride_tricks.sliding_window_view(padded, places)
    columns = np.arange(places)
    total = score[0].copy()
    for station in range(1, count):
        padded[inner] = total
        options = windows - penalty
        choice = options.argmax(axis=0)
        came_from[station] = choice
        total = options[choice, columns] + score[station]
        if station % 1000 == 0:
            yield station / count
    place = int(total.argmax())
    way = np.empty(count)
    for station in range(count - 1, -1, -1):
        way[station] = place
        place += int(came_from[station, place]) - _MOST_SIDEWAYS
    return way


def _rough(path: FloatArray) -> FloatArray:
    return gaussian_smoothed(resampled(gaussian_smoothed(path, sigma=2.0), step=_ALONG), sigma=2.0)


def section_along(ink: Float32Array, path: FloatArray, *, kind: str = "auto", furthest: float = 24.0) -> CrossSection:
    """Return what the line along a rough path (n, 2), copy pixels, looks like.

    Parameters
    ----------
    ink
        (h, w) share of line colour.
    kind
        "single" or "double" where the user knows, else "auto".
    furthest
        Largest distance of two edges that is looked for, copy pixels.
    """
    section = cross_section(ink_across(ink, _rough(path), reach=2 * furthest))
    if kind == "single" and section.edges is not None:
        return CrossSection(width=section.width - section.edges, edges=None)
    return section


def centred(ink: Float32Array, path: FloatArray, *, section: CrossSection) -> Generator[float, None, FloatArray]:
    """Move a rough path (n, 2), copy pixels, to the middle of its line."""
    rough = _rough(path)
    profiles = ink_across(ink, rough, reach=1.5 * section.width + 8.0)
    yield 0.3
    score = middle_score(profiles, section=section)
    middle = profiles.shape[1] // 2
    reach = int(((section.edges or 0.5 * section.width) + _PATH_ERROR) / _ACROSS)
    near = np.ascontiguousarray(score[:, middle - reach : middle + reach + 1])
    yield 0.6
    way = yield from best_way(near)
    shift = ndimage.gaussian_filter1d((way - reach) * _ACROSS, 2.0, mode="nearest")
    moved = rough + normals(gaussian_smoothed(rough, sigma=2.0)) * shift[:, None]
    return gaussian_smoothed(resampled(moved, step=_ALONG), sigma=1.5)


def filled(ink: Float32Array, *, edges: float) -> Generator[float, None, Float32Array]:
    """Return the ink (h, w) with the space between two edges filled: a band, whole also where lines cross."""
    size = int(np.ceil(edges)) + 2
    wide = ndimage.maximum_filter(ink, size=size, mode="nearest")
    yield 0.5
    closed = ndimage.minimum_filter(wide, size=size, mode="nearest", origin=0 if size % 2 else -1)
    yield 1.0
    return np.asarray(closed, dtype=np.float32)

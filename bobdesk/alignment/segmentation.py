"""Find the straights and curves of a centreline."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.ndimage import maximum_filter1d

from bobdesk.alignment.boundary_fit import fit_boundaries
from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.curvature import curvature
from bobdesk.alignment.labels import (
    Blocks,
    best_labels,
    best_labels_of_count,
    blocks_of,
    gain_by_count,
    otsu_threshold,
)
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segment, Segments, is_kept, keep_corrections
from bobdesk.arrays import FloatArray, IntArray
from bobdesk.errors import InputError

USUAL_THRESHOLD = 0.004
_LOWEST_THRESHOLD, _HIGHEST_THRESHOLD = 0.0025, 0.008
_STRAIGHT_BEYOND_DOUBT = 1e-4
_PUBLISHED_NEIGHBOURS = 2
_UNSURE_AT_ENDS = 7.5


def detect_segments(
    centreline: Centreline, settings: SegmentationSettings | None = None, *, previous: Segments = ()
) -> Segments:
    """Find the straights and curves; locked and hand-made segments of `previous` stay as they are.

    Raises
    ------
    InputError
        If the wanted number of segments cannot be told apart in this line, or a setting is out of range.
    """
    settings = settings or SegmentationSettings()
    _check(settings)
    detected = _detected(centreline, settings)
    if not any(is_kept(segment) or segment.name for segment in previous):
        return detected
    # A wanted number goes before the shortest segment, with corrections as without.
    shortest = settings.shortest if settings.count is None else min(settings.shortest, SegmentationSettings().shortest)
    return keep_corrections(detected, previous, shortest=shortest)


def threshold_of(centreline: Centreline, settings: SegmentationSettings) -> float:
    """Return the curvature threshold in force, 1/m: the user's, or the automatic one."""
    if settings.threshold is not None:
        return settings.threshold
    if settings.rule == "published":
        return USUAL_THRESHOLD
    size = np.abs(curvature(centreline, settings.curvature))
    size = size[size > _STRAIGHT_BEYOND_DOUBT]
    if len(size) < 10:
        return USUAL_THRESHOLD
    return float(np.clip(np.exp(otsu_threshold(np.log(size))), _LOWEST_THRESHOLD, _HIGHEST_THRESHOLD))


def fit_by_count(centreline: Centreline, settings: SegmentationSettings, *, most: int = 60) -> FloatArray:
    """Return the gain of the best segmentation with 1, 2, … segments, m: where more stop paying."""
    blocks = _blocks(centreline, settings)
    return gain_by_count(blocks, min(most, len(blocks.scores)))


@lru_cache(maxsize=16)
def _detected(centreline: Centreline, settings: SegmentationSettings) -> Segments:
    if settings.rule == "published":
        boundaries, labels = _by_published_rule(centreline, settings)
    else:
        boundaries, labels = _by_best_labels(centreline, settings)
    edges = [0.0, *boundaries.tolist(), centreline.length]
    return tuple(
        Segment("curve" if label else "straight", start, end)
        for label, start, end in zip(labels, edges[:-1], edges[1:], strict=True)
    )


def _by_best_labels(centreline: Centreline, settings: SegmentationSettings) -> tuple[FloatArray, IntArray]:
    blocks = _blocks(centreline, settings)
    if settings.count is None:
        of_blocks = best_labels(blocks, change_cost=settings.change_cost)
    else:
        if settings.count > len(blocks.scores):
            raise InputError(
                f"{settings.count} segments cannot be told apart in this line; want {len(blocks.scores)} at most"
            )
        of_blocks = best_labels_of_count(blocks, settings.count)
    crossed, labels = _runs(blocks.edges, of_blocks)
    bends = curvature(centreline, settings.curvature)
    fitted = _apart(fit_boundaries(centreline, bends, crossed, labels != 0), crossed, centreline.length, settings)
    if settings.count is not None:
        return fitted, labels
    return _without_slivers(fitted, labels, centreline.length, settings.shortest)


def _blocks(centreline: Centreline, settings: SegmentationSettings) -> Blocks:
    stations = centreline.stations
    # With points on one side only, the curvature at an end is a few times as noisy as elsewhere.
    trusted = np.minimum(1.0, np.minimum(stations, stations[-1] - stations) / _UNSURE_AT_ENDS)
    bends = trusted * curvature(centreline, settings.curvature)
    return blocks_of(stations, bends, threshold_of(centreline, settings))


def _runs(edges: FloatArray, of_blocks: IntArray) -> tuple[FloatArray, IntArray]:
    """Return the inner boundaries and the label of each run of equal labels."""
    changes = np.flatnonzero(np.diff(of_blocks))
    return edges[1:-1][changes], of_blocks[np.concatenate([[0], changes + 1])]


def _apart(fitted: FloatArray, crossed: FloatArray, length: float, settings: SegmentationSettings) -> FloatArray:
    """Take back fitted boundaries that would leave a segment shorter than the shortest allowed."""
    result = fitted.copy()
    for index in range(len(result)):
        before = result[index - 1] if index else 0.0
        after = fitted[index + 1] if index + 1 < len(result) else length
        if min(result[index] - before, after - result[index]) < settings.shortest:
            result[index] = max(crossed[index], before)
    return result


def _without_slivers(
    boundaries: FloatArray, labels: IntArray, length: float, shortest: float
) -> tuple[FloatArray, IntArray]:
    """Join segments shorter than `shortest` to their neighbours, the shortest first."""
    while len(labels) > 1:
        lengths = np.diff(np.concatenate([[0.0], boundaries, [length]]))
        index = int(lengths.argmin())
        if lengths[index] >= shortest:
            break
        if 0 < index < len(labels) - 1 and labels[index - 1] == labels[index + 1]:
            boundaries, labels = (
                np.delete(boundaries, [index - 1, index]),
                np.delete(labels, [index, index + 1]),
            )
        else:
            with_next = index == 0 or (index < len(labels) - 1 and lengths[index + 1] > lengths[index - 1])
            boundaries = np.delete(boundaries, index if with_next else index - 1)
            labels = np.delete(labels, index)
    return boundaries, labels


def _by_published_rule(centreline: Centreline, settings: SegmentationSettings) -> tuple[FloatArray, IntArray]:
    """Straight where the curvature and that of the neighbouring stations is below the threshold."""
    if settings.count is not None:
        raise InputError("the published rule has no wanted number of segments; change its threshold instead")
    bends = curvature(centreline, "published")
    around = maximum_filter1d(np.abs(bends), 2 * _PUBLISHED_NEIGHBOURS + 1, mode="nearest")
    curved = (around >= threshold_of(centreline, settings)).astype(np.int64)
    stations = centreline.stations
    middles = 0.5 * (stations[1:] + stations[:-1])
    return _runs(np.concatenate([[0.0], middles, [stations[-1]]]), curved)


def _check(settings: SegmentationSettings) -> None:
    if settings.threshold is not None and not 1e-5 <= settings.threshold <= 1.0:
        raise InputError(
            f"the curvature threshold must lie between 0.00001 and 1 per metre, not {settings.threshold:g}"
        )
    if settings.count is not None and settings.count < 1:
        raise InputError(f"the number of segments must be at least 1, not {settings.count}")

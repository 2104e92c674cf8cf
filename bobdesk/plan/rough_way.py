"""The way of a line on the small copy: once with what the clicks say, again with what that taught."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy import ndimage

from bobdesk.arrays import FloatArray
from bobdesk.plan.cheapest_path import cheapest_path, path_points
from bobdesk.plan.clicks import snapped
from bobdesk.plan.double_edge import CrossSection, centred, filled, section_along
from bobdesk.plan.gaps import bridged, typical_gap
from bobdesk.plan.line_colour import contrast, fill_at, ink, line_colours
from bobdesk.plan.raster import Float32Array
from bobdesk.plan.ridge import ridge_score, scale_at, step_cost, strength_near
from bobdesk.plan.stages import at_fraction
from bobdesk.plan.straight_lines import without_straight_lines
from bobdesk.plan.work_copy import WorkCopy

Line = Literal["auto", "single", "double"]

# The colour along the middle is another colour than those known: a band with a fill.
_STANDS_OUT = 12.0
_OTHER_COLOUR = 20.0
# Gaps that are closed before anything is known of the line, unless so much of the picture is ridge.
_SHORT_GAP = 12.0
_GRAIN = 0.08
_THIN = 2.0


@dataclass(frozen=True, eq=False)
class RoughWay:
    """The way of a line on the copy, good to about a pixel.

    Attributes
    ----------
    middle
        (n, 2) copy pixels.
    score
        (h, w) the ridge it follows, 0 to 1.
    share
        (h, w) how much line colour there is.
    section
        What the line looks like across.
    gap
        Length of the gaps of a dashed line, copy pixels, else 0.
    """

    middle: FloatArray
    score: Float32Array
    share: Float32Array
    section: CrossSection
    gap: float


def line_ink(copy: WorkCopy, colours: list[Float32Array]) -> Generator[float, None, Float32Array]:
    """Return how much line colour there is (h, w), the most of all `colours`; yields the fraction done."""
    height, width = copy.colours.shape[0], copy.colours.shape[1]
    share = np.zeros((height, width), dtype=np.float32)
    rows = max(1, 150_000 // width)
    for index, colour in enumerate(colours):
        for first in range(0, len(share), rows):
            part = slice(first, first + rows)
            found = ink(copy.colours[part], copy.background[part], colour)
            share[part] = np.maximum(share[part], found)
            yield (index + first / len(share)) / len(colours)
    return share


def _ridge_of(share: Float32Array, clicks: FloatArray) -> Generator[float, None, tuple[Float32Array, float]]:
    """Ridge score at the scale of the line under the clicks, without grid lines; and that scale."""
    sigma, strength = scale_at(share, clicks)
    score = yield from ridge_score(share, sigmas=(sigma / 1.3, sigma * 1.3), reference=0.8 * strength)
    return (yield from without_straight_lines(score, share)), sigma


def _without_short_gaps(score: Float32Array, share: Float32Array) -> Generator[float, None, Float32Array]:
    """Close gaps as those of dashes; not in grain, which would join to lines."""
    if np.count_nonzero(score > 0.3) > _GRAIN * score.size:
        return score
    return (yield from bridged(score, share, gap=_SHORT_GAP, worth=0.4))


def _fill_along(copy: WorkCopy, middle: FloatArray, known: list[Float32Array]) -> Float32Array | None:
    """Return the colour (c,) along the middle if it is that of a fill: neither paper nor known."""
    at = [middle[:, 1], middle[:, 0]]
    channels = range(copy.colours.shape[2])
    along = [ndimage.map_coordinates(copy.colours[..., c], at, order=1, mode="nearest") for c in channels]
    behind = [ndimage.map_coordinates(copy.background[..., c], at, order=1, mode="nearest") for c in channels]
    colour = np.median(along, axis=1).astype(np.float32)
    paper = np.median(behind, axis=1).astype(np.float32)
    if float(contrast(colour, paper)) < _STANDS_OUT:
        return None
    return colour if all(np.linalg.norm(colour - other) > _OTHER_COLOUR for other in known) else None


def rough_way(copy: WorkCopy, clicks: FloatArray, *, reach: float, line: Line) -> Generator[float, None, RoughWay]:
    """Find the way of the line through `clicks` (k, 2), copy pixels, each up to `reach` pixels off.

    Once more when it proves to be a band with an outline, two edges or dashes: these are then filled or
    joined, so that crossings and gaps do not send the way elsewhere.
    """
    colours = line_colours(copy, clicks)
    share = yield from line_ink(copy, colours)
    score, sigma = yield from at_fraction(_ridge_of(share, clicks), 0.2)
    joined = score
    if sigma <= _THIN and all(fill_at(copy, click) is None for click in clicks):
        joined = yield from at_fraction(_without_short_gaps(score, share), 0.3)
    points = yield from at_fraction(_way(joined, clicks, reach=reach), 0.4)
    section = section_along(share, points, kind=line)
    yield 0.45
    if section.edges is None and section.width > 4.0:
        middle = yield from at_fraction(centred(share, points, section=section), 0.5)
        fill = _fill_along(copy, middle, colours)
        if fill is not None:
            share = np.maximum(share, (yield from at_fraction(line_ink(copy, [fill]), 0.5)))
            score, _ = yield from at_fraction(_ridge_of(share, clicks), 0.6)
            points = yield from at_fraction(_way(score, clicks, reach=reach), 0.7)
            section = section_along(share, points, kind=line)
            yield 0.75
    gap = 0.0
    if section.edges is not None:
        band = yield from at_fraction(filled(share, edges=section.edges), 0.75)
        sigma = 0.4 * section.width
        reference = 0.8 * strength_near(band, clicks, sigma=sigma)[0]
        score = yield from at_fraction(ridge_score(band, sigmas=(sigma,), reference=reference), 0.8)
        points = yield from at_fraction(_way(score, clicks, reach=reach), 0.85)
    else:
        gap = typical_gap(score, points)
        if gap > 0.0:
            score = yield from at_fraction(bridged(score, share, gap=gap, worth=0.6), 0.8)
            points = yield from at_fraction(_way(score, clicks, reach=reach), 0.85)
    middle = yield from at_fraction(centred(share, points, section=section), 0.9)
    return RoughWay(middle, score, share, section, gap)


def _way(score: Float32Array, clicks: FloatArray, *, reach: float) -> Generator[float, None, FloatArray]:
    """Return the cheapest way (n, 2) over the ridges beside the clicks."""
    stops = [snapped(score, click, reach=reach) for click in clicks]
    return path_points((yield from cheapest_path(step_cost(score), score, stops)))

"""The colour of a line from clicks on it, and how much of that colour each pixel holds."""

from __future__ import annotations

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.plan.raster import Float32Array
from bobdesk.plan.ridge import ridge
from bobdesk.plan.stages import at_once
from bobdesk.plan.work_copy import WorkCopy

# Lab distances: two clicks on one colour agree within this …
_SAME_COLOUR = 25.0
# … and this much off the way from background to line colour is another colour (1 sigma).
_OFF_COLOUR = 22.0
# Lightness counts less than hue: shadows and scans change it along a line.
_LIGHTNESS_WEIGHT = 0.7
# Thin lines and strokes; grain is smaller than these.
_CREST_SCALES = (1.2, 2.4)


def contrast(colours: Float32Array, background: Float32Array) -> Float32Array:
    """Distance (...,) of Lab colours (..., c) from their background, lightness counted less."""
    difference = colours - background
    if difference.shape[-1] == 3:
        difference = difference * np.array([_LIGHTNESS_WEIGHT, 1.0, 1.0], dtype=np.float32)
    return np.asarray(np.linalg.norm(difference, axis=-1), dtype=np.float32)


def colour_at(copy: WorkCopy, click: FloatArray, *, radius: float = 6.0) -> Float32Array:
    """Return the Lab colour (c,) of the line near `click` (copy pixels).

    It is the median of the pixels on the strongest ridge of contrast to the background, within about
    `radius`; the search widens up to 4 times while nothing stands out, as between two edges far apart.
    """
    height, width = copy.colours.shape[:2]
    x = float(np.clip(click[0], 0, width - 1))
    y = float(np.clip(click[1], 0, height - 1))
    for reach in (radius, 2 * radius, 4 * radius):
        outer = int(3 * reach) + 10
        top, left = max(0, int(y) - outer), max(0, int(x) - outer)
        window = (slice(top, int(y) + outer + 1), slice(left, int(x) + outer + 1))
        colours = copy.colours[window]
        stands_out = contrast(colours, copy.background[window])
        rows, columns = np.mgrid[0 : colours.shape[0], 0 : colours.shape[1]]
        away = np.hypot(columns + left - x, rows + top - y)
        # All places are as good up to some pixels off: that is how well people click.
        nearness = np.exp(-(np.clip(away - 0.7 * reach, 0, None) ** 2) / (2 * (0.25 * reach) ** 2))
        crest = np.max([at_once(ridge(stands_out, sigma=sigma)) for sigma in _CREST_SCALES], axis=0)
        weighted = crest * np.where(away <= 1.3 * reach, nearness, 0.0)
        count = max(3, int(0.04 * np.pi * reach**2))
        best = np.argpartition(weighted.ravel(), -count)[-count:]
        colour = np.median(colours.reshape(-1, colours.shape[2])[best], axis=0)
        if np.median(stands_out.ravel()[best]) > 3.0 * np.median(stands_out) + 4.0:
            break
    return np.asarray(colour, dtype=np.float32)


def fill_at(copy: WorkCopy, click: FloatArray) -> Float32Array | None:
    """Return the colour (c,) of a wide line's fill if `click` lies on one: 3 x 3 pixels of one colour."""
    height, width = copy.colours.shape[:2]
    row = int(np.clip(round(float(click[1])), 1, height - 2))
    column = int(np.clip(round(float(click[0])), 1, width - 2))
    patch = copy.colours[row - 1 : row + 2, column - 1 : column + 2].reshape(9, -1)
    colour = np.asarray(np.median(patch, axis=0), dtype=np.float32)
    spread = float(np.linalg.norm(patch - colour, axis=1).max())
    stands_out = float(contrast(colour, copy.background[row, column]))
    return colour if stands_out > max(12.0, 3.0 * spread) else None


def line_colours(copy: WorkCopy, clicks: FloatArray) -> list[Float32Array]:
    """Return the one colour that the clicks (n, 2), copy pixels, agree on, or all where they differ.

    A band has two: that of its outline and that of its fill.
    """
    groups: list[list[Float32Array]] = []
    found = [colour_at(copy, click) for click in clicks]
    found += [fill for fill in (fill_at(copy, click) for click in clicks) if fill is not None]
    for colour in found:
        for group in groups:
            if np.linalg.norm(np.mean(group, axis=0) - colour) < _SAME_COLOUR:
                group.append(colour)
                break
        else:
            groups.append([colour])
    return [np.asarray(np.mean(group, axis=0), dtype=np.float32) for group in groups]


def ink(colours: Float32Array, background: Float32Array, line: Float32Array) -> Float32Array:
    """Return how much line colour there is: 0 as the background, 1 as the line; shape (...,).

    The colour is projected on the way from `background` to `line` (Lab, broadcast); what lies off that way
    is another thing, and what goes far beyond (a black label on a grey line) is damped.
    """
    way = line - background
    length = (way * way).sum(axis=-1) + np.float32(40.0)
    difference = colours - background
    share = (difference * way).sum(axis=-1) / length
    off = difference - share[..., None] * way
    damping = (off * off).sum(axis=-1) / np.float32(2 * _OFF_COLOUR**2)
    damping += np.clip(share - np.float32(1.25), 0, None) ** 2 * np.float32(2.0)
    return np.asarray(np.clip(share, 0, 1.15) * np.exp(-damping), dtype=np.float32)

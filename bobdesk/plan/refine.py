"""Sub-pixel places of a line at full size: profiles across it, laid over their own typical profile.

Every profile is compared with the median of all of them, made symmetric, so that the middle of the line is
the middle of whatever it looks like: a stroke, a band, two edges.  What does not look like that (labels,
ticks, leaders, crossings, gaps of dashes) loses its weight and the line goes on through it.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from bobdesk.arrays import BoolArray, FloatArray
from bobdesk.plan.line_colour import ink
from bobdesk.plan.polyline_geometry import gaussian_smoothed, normals, resampled, whittaker_smoothed
from bobdesk.plan.raster import Float32Array, Pixels, lab, sample
from bobdesk.plan.stages import at_fraction

_ROUNDS = 5
_SAMPLES_A_CHUNK = 60_000
# How strongly a point without a fit is held where the path put it: up to some 40 points are bridged.
_HOLD = 1e-5


@dataclass(frozen=True, eq=False)
class Refined:
    """A line at full size.

    Attributes
    ----------
    points
        (n, 2) picture pixels.
    fit
        (n,) how well each profile matches the typical one, 0 to 1.
    strength
        (n,) how much ink there is compared with the typical profile, about 1 on the line.
    blank
        (n,) True where there is plain background.
    width
        Full width at half of the typical profile, over both edges of a double line, pixels.
    """

    points: FloatArray
    fit: FloatArray
    strength: FloatArray
    blank: BoolArray
    width: float


def straightened(
    pixels: Pixels, points: FloatArray, across: FloatArray, distances: FloatArray
) -> Generator[float, None, Float32Array]:
    """Return the Lab colours (n, m, c) at `distances` (m,) along the normals `across` (n, 2) of `points`."""
    strips: list[Float32Array] = []
    for part in _parts(len(points), len(distances)):
        x = points[part, :1] + across[part, :1] * distances
        y = points[part, 1:] + across[part, 1:] * distances
        strips.append(lab(sample(pixels, x, y)))
        yield min(1.0, part.stop / len(points))
    return np.concatenate(strips)


def _running_median(values: Float32Array, *, size: int) -> Float32Array:
    """Median along the first axis of (n, c)."""
    size = max(1, min(size, len(values) // 2 * 2 - 1))
    return np.asarray(ndimage.median_filter(values, size=(size, 1), mode="nearest"))


def _ink_of(
    strip: Float32Array, distances: FloatArray, *, inner: float, outer: float, shape: FloatArray | None
) -> Generator[float, None, Float32Array]:
    """Share of line colour (n, m), with colours of line and background that may change along the line.

    The background is what lies between `outer` and the ends of the profiles; the line colour is the
    mean over `shape`, or within `inner` what stands out most.
    """
    flanks = np.abs(distances) >= outer
    core = np.abs(distances) <= inner
    count, _, channels = strip.shape
    background = np.empty((count, channels), dtype=np.float32)
    line = np.empty((count, channels), dtype=np.float32)
    parts = _parts(count, len(distances))
    for part in parts:
        background[part] = np.median(strip[part][:, flanks], axis=1)
        if shape is None:
            inside = strip[part][:, core]
            contrast = ((inside - background[part, None]) ** 2).sum(axis=2)
            line[part] = inside[np.arange(len(inside)), contrast.argmax(axis=1)]
        else:
            weights = (shape**2 / max(float((shape**2).sum()), 1e-12)).astype(np.float32)
            line[part] = np.einsum("nmc,m->nc", strip[part], weights)
        yield 0.0
    background = _running_median(background, size=41)
    line = _running_median(_without_gaps(line, background), size=81)
    result = np.empty(strip.shape[:2], dtype=np.float32)
    for part in parts:
        result[part] = ink(strip[part], background[part, None], line[part, None])
        yield 1.0
    return result


def _without_gaps(line: Float32Array, background: Float32Array) -> Float32Array:
    """Put the colours of the neighbours where the line (n, c) hardly differs from the background."""
    stands_out = np.linalg.norm(line - background, axis=1)
    there = np.flatnonzero(stands_out >= 0.6 * np.quantile(stands_out, 0.8))
    places = np.arange(len(line))
    nearest = there[np.clip(np.searchsorted(there, places), 0, len(there) - 1)]
    return np.asarray(line[nearest])


def _parts(count: int, places: int) -> list[slice]:
    """Cut `count` profiles of `places` samples into parts of some 10 ms of work each."""
    rows = max(1, _SAMPLES_A_CHUNK // places)
    return [slice(first, first + rows) for first in range(0, count, rows)]


def symmetric_template(profiles: Float32Array, weights: FloatArray, *, inside: BoolArray) -> FloatArray:
    """Return the median of the well-fitting profiles (n, m), mirrored onto itself, its floor at 0.

    Profiles with little ink, as in the gaps of dashes, say nothing about the line.
    """
    amount = profiles[:, inside].sum(axis=1)
    written = amount >= 0.4 * np.quantile(amount, 0.8)
    good = written & (weights > 0.5)
    if np.count_nonzero(good) < 10:
        good = written
    template = np.median(profiles[good], axis=0)
    template = 0.5 * (template + template[::-1])
    template = template - template[~inside].min(initial=float(template.min()))
    return np.asarray(np.where(inside, np.clip(template, 0, None), 0.0), dtype=np.float64)


def _half_width(template: FloatArray, distances: FloatArray) -> float:
    high = np.flatnonzero(template > 0.5 * template.max())
    return float(max(abs(distances[high[0]]), abs(distances[high[-1]]))) if len(high) else 1.0


def fit_shifts(
    profiles: Float32Array, template: FloatArray, *, window: FloatArray, most: int
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Lay the template over every profile (n, m) at shifts of -most … most samples.

    Returns the best shift (n,) in fractions of samples, the misfit (n,), 0 for a perfect match, and the
    strength (n,), the factor on the template that fits, and the ink of any shape (n,) beside that
    of the template.
    """
    shifts = np.arange(-most, most + 1)
    moved = np.stack([np.roll(template, shift) for shift in shifts], axis=1)
    windows = np.stack([np.roll(window, shift) for shift in shifts], axis=1)
    power = float((template**2).sum()) + 1e-12
    cross = profiles @ moved
    energy = (profiles.astype(np.float64) ** 2) @ windows
    gain = np.clip(cross / power, 0.4, 1.3)
    misfit = (energy - 2 * gain * cross + gain**2 * power) / power
    # Of two equal places the nearer one.
    judged = misfit + 0.02 * (shifts / max(most, 1)) ** 2
    best = judged.argmin(axis=1)
    row = np.arange(len(profiles))
    centre = np.clip(best, 1, len(shifts) - 2)
    before, at, after = judged[row, centre - 1], judged[row, centre], judged[row, centre + 1]
    bend = before - 2 * at + after
    part = np.where(bend > 1e-9, 0.5 * (before - after) / np.where(bend > 1e-9, bend, 1.0), 0.0)
    at_edge = best != centre
    shift = shifts[best] + np.where(at_edge, 0.0, np.clip(part, -1, 1))
    return shift, misfit[row, best], cross[row, best] / power, energy[row, best] / power


def refined(
    pixels: Pixels, path: FloatArray, *, width: float, search: float, step: float, wavelength: float
) -> Generator[float, None, Refined]:
    """Move a path (n, 2), picture pixels, to the middle of its line with sub-pixel accuracy.

    Parameters
    ----------
    width
        Width of the line over all, pixels.
    search
        How far the path may be off, pixels.
    step
        Distance of the points, pixels.
    wavelength
        Wiggles shorter than this are noise, pixels.
    """
    points = path
    weights = np.ones(len(points))
    strength = amount = np.zeros(len(points))
    half = 0.5 * width
    for turn in range(_ROUNDS):
        points = resampled(points, step=step)
        weights = np.interp(np.linspace(0, 1, len(points)), np.linspace(0, 1, len(weights)), weights)
        reach = search if turn < 3 else max(1.5, 0.5 * search)
        spacing = float(np.clip(half / 10, 0.4, 1.0))
        margin = max(2.5, 0.6 * half)
        outer = half + reach + margin
        count = int(np.ceil((outer + max(4.0, half)) / spacing))
        distances = np.arange(-count, count + 1, dtype=np.float64) * spacing
        across = normals(gaussian_smoothed(points, sigma=2.0))
        done = turn / _ROUNDS
        strip = yield from at_fraction(straightened(pixels, points, across, distances), done)
        inside = np.abs(distances) <= half + margin
        rough = yield from at_fraction(_ink_of(strip, distances, inner=half + reach, outer=outer, shape=None), done)
        template = symmetric_template(rough, weights, inside=inside)
        yield done
        profiles = yield from at_fraction(_ink_of(strip, distances, inner=half, outer=outer, shape=template), done)
        template = symmetric_template(profiles, weights, inside=inside)
        yield done
        most = max(2, int(reach / spacing))
        shift, misfit, strength, amount = np.zeros((4, len(points)))
        for part in _parts(len(points), len(distances)):
            shift[part], misfit[part], strength[part], amount[part] = fit_shifts(
                profiles[part], template, window=inside.astype(np.float64), most=most
            )
            yield done
        shift *= spacing
        weights = _trust(shift, misfit, strength)
        moved = points + across * shift[:, None]
        points = whittaker_smoothed(
            np.where(weights[:, None] > 0.05, moved, points),
            weights=np.maximum(weights, _HOLD),
            wavelength=(2.0 if turn < 2 else 1.0) * wavelength / step,
        )
        half = float(np.clip(_half_width(template, distances), 0.4 * width, 0.75 * width))
        yield (turn + 1) / _ROUNDS
    return Refined(points, weights, np.clip(strength, 0, None), amount < 0.15, 2 * _half_width(template, distances))


def _trust(shift: FloatArray, misfit: FloatArray, strength: FloatArray) -> FloatArray:
    """Weight from 0 to 1 of each profile's shift: a good match, enough ink, in line with its neighbours."""
    typical = float(np.median(misfit))
    weights = 1.0 / (1.0 + (misfit / (2.0 * typical + 0.05)) ** 4)
    weights *= np.clip((strength - 0.25) / 0.25, 0, 1)
    size = max(1, min(15, len(shift) // 2 * 2 - 1))
    # In gaps the shifts mean nothing: what their neighbours say stands in.
    sure = np.flatnonzero(weights > 0.3)
    if len(sure) == 0:
        return np.zeros_like(shift)
    meant = np.interp(np.arange(len(shift)), sure, shift[sure])
    middle = ndimage.median_filter(meant, size=size, mode="nearest")
    spread = float(np.median(np.abs(meant - middle)[sure])) + 0.15
    weights *= np.abs(shift - middle) < 4 * spread
    return np.asarray(weights, dtype=np.float64)

"""From clicks on a line to its centre: the trace in pixels, with how sure each point is."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from bobdesk.arrays import FloatArray, IntArray, frozen
from bobdesk.errors import InputError
from bobdesk.plan.cheapest_path import Pixel, cheapest_path, path_points
from bobdesk.plan.double_edge import CrossSection, centred, filled, section_along
from bobdesk.plan.gaps import bridged, typical_gap
from bobdesk.plan.line_colour import ink, line_colours
from bobdesk.plan.polyline_geometry import arc_lengths, extended, nearest_station, part_between
from bobdesk.plan.raster import Float32Array, Pixels, check_pixels
from bobdesk.plan.refine import Refined, refined
from bobdesk.plan.ridge import ridge_score, scale_at, step_cost, strength_near
from bobdesk.plan.stages import stage
from bobdesk.plan.straight_lines import without_straight_lines
from bobdesk.plan.work_copy import WorkCopy, work_copy
from bobdesk.progress import Progress

Kind = Literal["single", "double", "dashed"]


@dataclass(frozen=True)
class TraceSettings:
    """How a line is traced; the defaults need no thought.

    Attributes
    ----------
    work_megapixels
        Size of the copy on which the way is sought.
    snap_px
        How far a click may lie off the line, pixels of the copy.
    line
        "single" or "double" where the user knows better than the program.
    step_px
        Distance of the trace's points, picture pixels.
    known_length_px
        Length that the line should have, or None; another length gives a warning.
    """

    work_megapixels: float = 1.5
    snap_px: float = 7.0
    line: Literal["auto", "single", "double"] = "auto"
    step_px: float = 2.0
    known_length_px: float | None = None


@dataclass(frozen=True, eq=False)
class Trace:
    """A line in a picture.

    Attributes
    ----------
    points
        (n, 2) x, y in picture pixels from the top left pixel's centre, y down, read-only.
    confidence
        (n,) from 0 (guessed) to 1 (the picture says so).
    line_width_px
        Width of the drawn line over all, pixels.
    kind
        One stroke, two edges, or dashes.
    warnings
        One sentence each, for a person.
    suspect
        (k, 2) first and last index of the points to look at.
    """

    points: FloatArray
    confidence: FloatArray
    line_width_px: float
    kind: Kind
    warnings: tuple[str, ...]
    suspect: IntArray

    @property
    def length_px(self) -> float:
        """Length of the trace in pixels."""
        return float(arc_lengths(self.points)[-1])


def _checked_clicks(pixels: Pixels, clicks: npt.ArrayLike) -> FloatArray:
    points = np.asarray(clicks, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2:
        raise InputError("A line is traced from at least two points: its start and its finish.")
    height, width = pixels.shape[:2]
    for x, y in points:
        if not (np.isfinite(x) and np.isfinite(y) and -1 <= x <= width and -1 <= y <= height):
            raise InputError(
                f"The point {x:.0f},{y:.0f} lies outside the picture of {width} x {height} pixels."
            )
    if np.any(np.hypot(*np.diff(points, axis=0).T) < 1.0):
        raise InputError(
            "Two points that follow each other are the same place; start and finish must differ."
        )
    return points


def snapped(score: Float32Array, click: FloatArray, *, reach: float) -> Pixel:
    """Return the pixel (row, column) with the most ridge near `click`, near ones first."""
    height, width = score.shape
    column = int(np.clip(round(float(click[0])), 0, width - 1))
    row = int(np.clip(round(float(click[1])), 0, height - 1))
    outer = int(np.ceil(reach))
    top, left = max(0, row - outer), max(0, column - outer)
    window = score[top : row + outer + 1, left : column + outer + 1]
    rows, columns = np.mgrid[0 : window.shape[0], 0 : window.shape[1]]
    squares = (rows + top - click[1]) ** 2 + (columns + left - click[0]) ** 2
    weighted = window * np.exp(-squares / (2 * (0.6 * reach) ** 2))
    best = np.unravel_index(int(weighted.argmax()), weighted.shape)
    return top + int(best[0]), left + int(best[1])


def _ink_and_score(
    copy: WorkCopy, clicks: FloatArray
) -> Generator[float, None, tuple[Float32Array, Float32Array]]:
    share = np.zeros(copy.colours.shape[:2], dtype=np.float32)
    rows = max(1, 150_000 // share.shape[1])
    for colour in line_colours(copy, clicks):
        for first in range(0, len(share), rows):
            part = slice(first, first + rows)
            found = ink(copy.colours[part], copy.background[part], colour)
            share[part] = np.maximum(share[part], found)
            yield 0.0
    sigma, strength = scale_at(share, clicks)
    score = yield from ridge_score(share, sigmas=(sigma / 1.3, sigma * 1.3), reference=0.8 * strength)
    score = yield from without_straight_lines(score, share)
    return share, score


@dataclass(frozen=True, eq=False)
class _RoughWay:
    """A path on the copy: (n, 2) pixels, what the line looks like across, the length of its gaps or 0."""

    points: FloatArray
    section: CrossSection
    gap: float


def _rough_way(
    share: Float32Array, score: Float32Array, clicks: FloatArray, *, settings: TraceSettings
) -> Generator[float, None, _RoughWay]:
    """Find the way; once more when it proves to run along two edges or dashes, with these joined."""
    stops = [snapped(score, click, reach=settings.snap_px) for click in clicks]
    points = path_points((yield from cheapest_path(step_cost(score), score, stops)))
    section = section_along(share, points, kind=settings.line)
    yield 0.5
    gap = 0.0
    if section.edges is not None:
        band = yield from filled(share, edges=section.edges)
        sigma = 0.4 * section.width
        strength = strength_near(band, clicks, sigma=sigma)
        better = yield from ridge_score(band, sigmas=(sigma,), reference=0.8 * strength)
    else:
        gap = typical_gap(score, points)
        if gap == 0.0:
            return _RoughWay(points, section, gap)
        better = yield from bridged(score, share, gap=gap)
    stops = [snapped(better, click, reach=settings.snap_px) for click in clicks]
    points = path_points((yield from cheapest_path(step_cost(better), better, stops)))
    return _RoughWay(points, section, gap)


def _cut_to_clicks(
    line: Refined, clicks: FloatArray, *, slack: float, step: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Cut the prolonged line where the first and last click lie beside it."""
    points = line.points
    along = arc_lengths(points)
    near_start = along <= 3 * slack + 10
    near_end = along >= along[-1] - 3 * slack - 10
    start = nearest_station(points[near_start], position=clicks[0])
    offset = along[near_end][0]
    end = offset + nearest_station(points[near_end], position=clicks[-1])
    part = part_between(points, start=start, end=max(end, start + step))
    stations = start + arc_lengths(part)
    return (
        part,
        np.interp(stations, along, line.fit),
        np.interp(stations, along, line.strength),
    )


def trace_line(
    pixels: Pixels, clicks: npt.ArrayLike, *, settings: TraceSettings = TraceSettings()
) -> Generator[Progress, None, Trace]:
    """Trace the centre of the line through `clicks`.

    Parameters
    ----------
    pixels
        See `bobdesk.plan.raster`.
    clicks
        (k, 2) with k >= 2, picture pixels: start, points on the way, finish.

    Raises
    ------
    InputError
        If the picture or the clicks cannot be used.
    """
    check_pixels(pixels)
    places = _checked_clicks(pixels, clicks)
    copy = yield from stage(
        work_copy(pixels, megapixels=settings.work_megapixels), "Reading the picture", start=0.0, end=0.3
    )
    stops_at = copy.to_copy(places)
    share, score = yield from stage(
        _ink_and_score(copy, stops_at), "Looking for the line", start=0.3, end=0.5
    )
    rough = yield from stage(
        _rough_way(share, score, stops_at, settings=settings), "Following the line", start=0.5, end=0.7
    )
    middle = yield from stage(
        centred(share, rough.points, section=rough.section), "Finding the middle", start=0.7, end=0.8
    )
    section = rough.section
    width = section.width / copy.scale
    slack = settings.snap_px / copy.scale
    path = extended(copy.to_picture(middle), length=slack + width, step=settings.step_px)
    line = yield from stage(
        refined(
            pixels,
            path,
            width=width,
            search=max(2.0, 1.5 / copy.scale),
            step=settings.step_px,
            wavelength=10.0 / copy.scale,
        ),
        "Measuring the line",
        start=0.8,
        end=1.0,
    )
    points, fit, strength = _cut_to_clicks(line, places, slack=slack + width, step=settings.step_px)
    kind: Kind = "dashed" if rough.gap else "double" if section.edges is not None else "single"
    return Trace(frozen(points), frozen(fit), line.width, kind, (), np.zeros((0, 2), dtype=np.int64))

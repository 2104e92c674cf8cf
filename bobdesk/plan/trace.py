"""From clicks on a line to its centre: the trace in pixels, with how sure each point is."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from bobdesk.arrays import FloatArray, IntArray, frozen
from bobdesk.plan.cheapest_path import cheapest_path, path_points
from bobdesk.plan.clicks import checked_clicks, ends_at_clicks, snapped
from bobdesk.plan.double_edge import CrossSection, centred, filled, section_along
from bobdesk.plan.doubts import (
    confidence,
    doubtful_turns,
    length_sentence,
    turn_sentences,
    weak_sentences,
    weak_stretches,
)
from bobdesk.plan.gaps import bridged, typical_gap
from bobdesk.plan.line_colour import ink, line_colours
from bobdesk.plan.polyline_geometry import arc_lengths, extended, nearest_vertex, part_between, resampled
from bobdesk.plan.raster import Float32Array, Pixels, check_pixels
from bobdesk.plan.refine import Refined, refined
from bobdesk.plan.ridge import ridge_along, ridge_score, scale_at, step_cost, strength_near
from bobdesk.plan.stages import stage
from bobdesk.plan.straight_lines import without_straight_lines
from bobdesk.plan.work_copy import WorkCopy, work_copy
from bobdesk.progress import Progress

Kind = Literal["single", "double", "dashed"]
# A point without a fit is sure while a good one is nearer than half of this, pixels of the copy.
_SURE = 30.0


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
    """A path on the copy (n, 2), the ridge it follows, the line across, the length of its gaps or 0."""

    points: FloatArray
    score: Float32Array
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
            return _RoughWay(points, score, section, gap)
        better = yield from bridged(score, share, gap=gap)
    stops = [snapped(better, click, reach=settings.snap_px) for click in clicks]
    points = path_points((yield from cheapest_path(step_cost(better), better, stops)))
    return _RoughWay(points, better, section, gap)


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
    places = checked_clicks(pixels, clicks)
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
    yield Progress(1.0, "Looking for doubtful places")
    return _judged(line, rough, places, copy=copy, settings=settings)


def _judged(
    line: Refined, rough: _RoughWay, clicks: FloatArray, *, copy: WorkCopy, settings: TraceSettings
) -> Trace:
    """Cut the line at its clicks and say how sure it is."""
    slack = settings.snap_px / copy.scale + line.width
    start, finish = ends_at_clicks(line, clicks, slack=slack, dashed=rough.gap > 0)
    points = resampled(
        part_between(line.points, start=start, end=max(finish, start + settings.step_px)),
        step=settings.step_px,
    )
    reach = (_SURE + 2 * rough.gap) / copy.scale
    stations = np.linspace(start, finish, len(points))
    along = arc_lengths(line.points)
    sure = confidence(np.interp(stations, along, line.fit), step=settings.step_px, reach=reach)
    weak = weak_stretches(sure)
    doubts = []
    for doubt in doubtful_turns(rough.score, rough.points, width=rough.section.width):
        x, y = copy.to_picture([[doubt.x, doubt.y]])[0]
        doubts.append((doubt, float(x), float(y)))
        index = nearest_vertex(points, position=np.array([x, y]))
        weak = np.concatenate([weak, [[max(0, index - 10), min(len(points) - 1, index + 10)]]])
    warnings = turn_sentences(doubts) + weak_sentences(points, weak_stretches(sure))
    if np.mean(ridge_along(rough.score, rough.points)) < 0.3:
        warnings.insert(0, "There is hardly a line between the points; are they on the line?")
    if settings.known_length_px is not None:
        sentence = length_sentence(float(arc_lengths(points)[-1]), settings.known_length_px)
        warnings += [sentence] if sentence else []
    kind: Kind = "dashed" if rough.gap else "double" if rough.section.edges is not None else "single"
    suspect = weak[np.argsort(weak[:, 0], kind="stable")]
    suspect.flags.writeable = False
    return Trace(frozen(points, columns=2), frozen(sure), line.width, kind, tuple(warnings), suspect)

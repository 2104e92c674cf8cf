"""From clicks on a line to its centre: the trace in pixels, with how sure each point is."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from bobdesk.arrays import FloatArray, frozen
from bobdesk.plan.clicks import checked_clicks, ends_at_clicks
from bobdesk.plan.doubts import (
    confidence,
    doubtful_turns,
    length_sentence,
    turn_sentences,
    weak_sentences,
    weak_stretches,
)
from bobdesk.plan.loops import around_loops
from bobdesk.plan.polyline_geometry import arc_lengths, extended, nearest_vertex, part_between, resampled
from bobdesk.plan.raster import Pixels, check_pixels
from bobdesk.plan.refine import Refined, refined
from bobdesk.plan.ridge import ridge_along
from bobdesk.plan.rough_way import Line, RoughWay, rough_way
from bobdesk.plan.stages import stage
from bobdesk.plan.traced_line import Kind, Trace
from bobdesk.plan.work_copy import WorkCopy, work_copy
from bobdesk.progress import Progress

# A point without a fit is sure while a good one is nearer than half of this, pixels of the copy.
_SURE = 30.0
_SHORTEST_DOUBT = 10.0
# Width of a line on the copy, pixels: where a smaller copy is better, and what is wanted then.
_WIDEST, _WANTED = 18.0, 10.0
# A line with this share of plain background along it is dashed.
_BLANK_SHARE = 0.05


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
    line: Line = "auto"
    step_px: float = 2.0
    known_length_px: float | None = None


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
    copy, rough = yield from _found(pixels, places, settings=settings)
    return (yield from _measured(pixels, places, copy, rough, settings=settings))


def propose_loops(
    pixels: Pixels, clicks: npt.ArrayLike, *, settings: TraceSettings = TraceSettings()
) -> Generator[Progress, None, Trace | None]:
    """Trace a line that crosses itself from its start and finish alone, going straight on at crossings.

    The result is a proposal to be looked at, and None where no longer way is found than that of
    `trace_line`.  Points on the way are not needed; those given are passed in order.  Raises InputError as
    `trace_line`.
    """
    check_pixels(pixels)
    places = checked_clicks(pixels, clicks)
    copy, rough = yield from _found(pixels, places, settings=settings)
    around = yield from stage(around_loops(rough), "Going around loops", start=0.7, end=0.8)
    if around is None:
        return None
    return (yield from _measured(pixels, places, copy, around, settings=settings))


def _found(
    pixels: Pixels, clicks: FloatArray, *, settings: TraceSettings
) -> Generator[Progress, None, tuple[WorkCopy, RoughWay]]:
    """Find the line on a small copy; a wide line once more on a smaller one."""
    megapixels = settings.work_megapixels
    for looks in (1, 2):
        copy = yield from stage(
            work_copy(pixels, megapixels=megapixels),
            "Reading the picture",
            start=0.35 * (looks - 1),
            end=0.2 * looks,
        )
        rough = yield from stage(
            rough_way(copy, copy.to_copy(clicks), reach=settings.snap_px, line=settings.line),
            "Following the line",
            start=0.2 * looks,
            end=0.35 * looks,
        )
        if rough.section.width <= _WIDEST:
            break
        # A line this wide hides its own background; on a smaller copy it is like any other.
        shrink = _WANTED / rough.section.width
        megapixels = copy.colours.shape[0] * copy.colours.shape[1] * shrink**2 / 1e6
    return copy, rough


def _measured(
    pixels: Pixels, clicks: FloatArray, copy: WorkCopy, rough: RoughWay, *, settings: TraceSettings
) -> Generator[Progress, None, Trace]:
    """Measure the line in the picture itself and say how sure it is."""
    width = rough.section.width / copy.scale
    slack = settings.snap_px / copy.scale
    line = yield from stage(
        refined(
            pixels,
            extended(copy.to_picture(rough.middle), length=slack + width, step=settings.step_px),
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
    return _judged(line, rough, clicks, copy=copy, settings=settings)


def _judged(line: Refined, rough: RoughWay, clicks: FloatArray, *, copy: WorkCopy, settings: TraceSettings) -> Trace:
    """Cut the line at its clicks and say how sure it is."""
    slack = settings.snap_px / copy.scale + line.width
    start, finish = ends_at_clicks(line, clicks, slack=slack, dashed=True)
    along = arc_lengths(line.points)
    between = (along > start + slack) & (along < finish - slack)
    dashed = rough.gap > 0 or (between.any() and float(np.mean(line.blank[between])) > _BLANK_SHARE)
    if not dashed:
        start, finish = ends_at_clicks(line, clicks, slack=slack, dashed=False)
    points = resampled(
        part_between(line.points, start=start, end=max(finish, start + settings.step_px)),
        step=settings.step_px,
    )
    reach = (_SURE + 2 * rough.gap) / copy.scale
    stations = np.linspace(start, finish, len(points))
    sure = confidence(np.interp(stations, along, line.fit), step=settings.step_px, reach=reach)
    hardly_shown = weak_stretches(sure, shortest=round(_SHORTEST_DOUBT / copy.scale / settings.step_px))
    weak = hardly_shown
    doubts = []
    for doubt in doubtful_turns(rough.score, copy.to_copy(points), width=rough.section.width):
        x, y = copy.to_picture([[doubt.x, doubt.y]])[0]
        doubts.append((doubt, float(x), float(y)))
        index = nearest_vertex(points, position=np.array([x, y]))
        weak = np.concatenate([weak, [[max(0, index - 10), min(len(points) - 1, index + 10)]]])
    warnings = turn_sentences(doubts) + weak_sentences(points, hardly_shown)
    if np.mean(ridge_along(rough.score, rough.middle)) < 0.3:
        warnings.insert(0, "There is hardly a line between the points; are they on the line?")
    if settings.known_length_px is not None:
        sentence = length_sentence(float(arc_lengths(points)[-1]), settings.known_length_px)
        warnings += [sentence] if sentence else []
    kind: Kind = "dashed" if dashed else "double" if rough.section.edges is not None else "single"
    suspect = weak[np.argsort(weak[:, 0], kind="stable")]
    suspect.flags.writeable = False
    return Trace(frozen(points, columns=2), frozen(sure), line.width, kind, tuple(warnings), suspect)

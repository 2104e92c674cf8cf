"""A wire that clings to the drawn line between the last click and the mouse.

The way of every pixel near the last click is found once; then the wire to any place is read back from it,
which takes no time.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.sparse.csgraph import dijkstra

from bobdesk.arrays import FloatArray, frozen
from bobdesk.plan.cheapest_path import pixel_graph
from bobdesk.plan.clicks import snapped
from bobdesk.plan.double_edge import centred, section_along
from bobdesk.plan.doubts import confidence
from bobdesk.plan.line_colour import line_colours
from bobdesk.plan.polyline_geometry import (
    arc_lengths,
    extended,
    gaussian_smoothed,
    nearest_station,
    part_between,
    resampled,
)
from bobdesk.plan.raster import Float32Array, Pixels, check_pixels
from bobdesk.plan.refine import refined
from bobdesk.plan.ridge import ridge_score, scale_at, step_cost
from bobdesk.plan.rough_way import line_ink
from bobdesk.plan.stages import at_once, stage
from bobdesk.plan.work_copy import WorkCopy, work_copy
from bobdesk.progress import Progress

# Half the side of the window around a click in which ways are found, copy pixels: some 0.2 s of work.
_HALF = 210
# How far a click may lie off the line, copy pixels.
_SNAP = 7.0
_STEP_PX = 2.0
_SURE = 30.0
# Shorter pieces are left as they were found: there is nothing to measure them by.
_SHORTEST = 12.0


@dataclass(frozen=True, eq=False)
class LiveWire:
    """A picture that is ready to be followed.

    Attributes
    ----------
    pixels
        See `bobdesk.plan.raster`.
    copy
        The small copy on which ways are found.
    """

    pixels: Pixels
    copy: WorkCopy


@dataclass(frozen=True, eq=False)
class Anchor:
    """All ways from one click.

    Attributes
    ----------
    place
        The click, moved onto the line beside it, picture pixels.
    colours
        Lab colours of the line, for the next anchor.
    """

    place: tuple[float, float]
    colours: tuple[Float32Array, ...]
    copy: WorkCopy
    share: Float32Array
    score: Float32Array
    corner: tuple[int, int]
    predecessors: npt.NDArray[np.int32]

    def path(self, end: tuple[float, float], *, snap: bool = True) -> FloatArray:
        """Return the wire (n, 2), picture pixels, from the anchor's place to the line beside `end`.

        Beyond the window in which ways were found it goes on straight.
        """
        height, width = self.score.shape
        top, left = self.corner
        at = self.copy.to_copy([end])[0] - [left, top]
        inside = bool(-0.5 <= at[0] < width - 0.5 and -0.5 <= at[1] < height - 0.5)
        clipped = np.clip(at, 0, [width - 1, height - 1])
        goal = (
            snapped(self.score, clipped, reach=_SNAP) if snap else (round(float(clipped[1])), round(float(clipped[0])))
        )
        nodes = [goal[0] * width + goal[1]]
        while self.predecessors[nodes[-1]] >= 0:
            nodes.append(int(self.predecessors[nodes[-1]]))
        way = np.array(nodes[::-1], dtype=np.int64)
        points = np.column_stack([way % width, way // width]).astype(np.float64)
        if len(points) > 2:
            points = gaussian_smoothed(points, sigma=1.5)
        picture = self.copy.to_picture(points + np.array([left, top]))
        if not inside:
            picture = np.vstack([picture, end])
        elif len(picture) == 1:
            picture = np.vstack([picture, picture])
        return picture


@dataclass(frozen=True, eq=False)
class Followed:
    """A piece of wire, measured in the picture itself.

    Attributes
    ----------
    points, confidence
        (n, 2) picture pixels and (n,) from 0 to 1, read-only.
    width
        Of the drawn line over all, pixels.
    """

    points: FloatArray
    confidence: FloatArray
    width: float


def prepare(pixels: Pixels, *, megapixels: float = 1.5) -> Generator[Progress, None, LiveWire]:
    """Make a picture ready to be followed.

    Raises
    ------
    InputError
        If the pixels cannot be used.
    """
    check_pixels(pixels)
    copy = yield from stage(work_copy(pixels, megapixels=megapixels), "Preparing the picture", start=0.0, end=1.0)
    return LiveWire(pixels, copy)


def anchored(wire: LiveWire, click: tuple[float, float], *, colours: tuple[Float32Array, ...] = ()) -> Anchor:
    """Find all ways from a click, some 0.2 s of work.

    Parameters
    ----------
    click
        On the line, or up to some pixels beside it; picture pixels.
    colours
        Of the line where it is known from an earlier anchor; else it is looked up at the click.
    """
    copy = wire.copy
    height, width = copy.colours.shape[:2]
    at = np.clip(copy.to_copy([click])[0], 0, [width - 1, height - 1])
    top, left = (max(0, int(at[axis]) - _HALF) for axis in (1, 0))
    window = (slice(top, int(at[1]) + _HALF + 1), slice(left, int(at[0]) + _HALF + 1))
    known = list(colours) or line_colours(copy, at[None])
    part = WorkCopy(copy.colours[window], copy.background[window], copy.scale_x, copy.scale_y)
    share = at_once(line_ink(part, known))
    here = at - [left, top]
    sigma, strength = scale_at(share, here[None])
    score = at_once(ridge_score(share, sigmas=(sigma / 1.3, sigma * 1.3), reference=0.8 * strength))
    start = snapped(score, here, reach=_SNAP)
    graph, numbers, _ = pixel_graph(step_cost(score), np.ones(score.shape, dtype=bool))
    _, predecessors = dijkstra(graph, indices=np.array([numbers[start]]), return_predecessors=True)
    x, y = copy.to_picture([[start[1] + left, start[0] + top]])[0]
    return Anchor(
        (float(x), float(y)),
        tuple(known),
        copy,
        share,
        score,
        (top, left),
        predecessors[0].astype(np.int32, copy=False),
    )


def followed(wire: LiveWire, anchor: Anchor, points: FloatArray) -> Generator[Progress, None, Followed]:
    """Measure a piece of wire (n, 2), picture pixels, that was accepted: to a fraction of a pixel.

    A line of two edges is brought to its middle.
    """
    copy, corner = wire.copy, np.array(anchor.corner[::-1], dtype=np.float64)
    if float(arc_lengths(points)[-1]) * copy.scale < _SHORTEST:
        return Followed(frozen(points, columns=2), frozen(np.ones(len(points))), 0.0)
    on_copy = resampled(copy.to_copy(points) - corner, step=1.0)
    section = section_along(anchor.share, on_copy, kind="auto")
    middle = yield from stage(centred(anchor.share, on_copy, section=section), "Finding the middle", start=0.0, end=0.2)
    width = section.width / copy.scale
    reach = width + _SNAP / copy.scale
    line = yield from stage(
        refined(
            wire.pixels,
            extended(copy.to_picture(middle + corner), length=reach, step=_STEP_PX),
            width=width,
            search=max(2.0, 1.5 / copy.scale),
            step=_STEP_PX,
            wavelength=10.0 / copy.scale,
        ),
        "Measuring the line",
        start=0.2,
        end=1.0,
    )
    along = arc_lengths(line.points)
    start, end = _ends(line.points, along, points, reach=reach)
    piece = resampled(part_between(line.points, start=start, end=end), step=_STEP_PX)
    fit = np.interp(np.linspace(start, end, len(piece)), along, line.fit)
    sure = confidence(fit, step=_STEP_PX, reach=_SURE / copy.scale)
    return Followed(frozen(piece, columns=2), frozen(sure), line.width)


def _ends(line: FloatArray, along: FloatArray, points: FloatArray, *, reach: float) -> tuple[float, float]:
    """Return the stations of `line`, prolonged at both ends, beside the ends of the wire; a loop is no short cut."""
    room = 2 * reach + 10
    first, last = along <= min(room, along[-1] / 2), along >= max(along[-1] - room, along[-1] / 2)
    start = nearest_station(line[first], position=points[0]) if first.sum() > 1 else 0.0
    end = float(along[last][0])
    end = end + nearest_station(line[last], position=points[-1]) if last.sum() > 1 else float(along[-1])
    return start, max(end, start + _STEP_PX)

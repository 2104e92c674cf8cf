"""Loops from start and finish alone: the way goes around where the line crosses itself, and stays where not."""

from __future__ import annotations

import io
import time

import numpy as np
import numpy.typing as npt
import pytest
import shapely
from PIL import Image

from bobdesk.plan.polyline_geometry import arc_lengths
from bobdesk.plan.trace import Trace, propose_loops
from bobdesk.progress import finish

from .drawn_lines import Array, Style, clothoid_track, draw, looped_track, random_track

_RED = (190, 30, 40)
_PATCHES = ((190, 215, 170), (170, 200, 230), (140, 180, 120))


def _as_jpeg(pixels: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, "JPEG", quality=75)
    return np.asarray(Image.open(stream))


def _is_the_line(trace: Trace | None, truth: Array) -> None:
    assert trace is not None
    apart = shapely.distance(shapely.LineString(trace.points), shapely.points(truth))
    assert apart.mean() < 0.5
    assert abs(trace.length_px / arc_lengths(truth)[-1] - 1) < 0.005


@pytest.mark.parametrize("turn", [215.0, 250.0, 290.0, 330.0])
@pytest.mark.parametrize(
    "style",
    [Style(width=2), Style(width=5, colour=_RED), Style(width=13, colour=_RED), Style(width=2, double=10)],
    ids=["hairline", "stroke", "broad stroke", "two edges"],
)
def test_a_loop_is_found_whatever_the_angle_of_its_crossing(turn: float, style: Style) -> None:
    # Two edges at a crossing of 30 degrees hide each other over most of a loop this small.
    radius = 90.0 if style.double and turn > 320 else 65.0
    drawn = draw(looped_track(turn, radius=radius), style, seed=1)
    _is_the_line(finish(propose_loops(_as_jpeg(drawn.pixels), drawn.track[[0, -1]])), drawn.track)


@pytest.mark.parametrize(
    ("style", "radius"),
    [
        (Style(width=2, dash=(10, 7)), 55.0),
        (Style(width=3, noise=18, blur=0.8, shade=0.3, labels=16, ticks=True), 55.0),
        (Style(width=2.5, colour=_RED, patches=_PATCHES, grid=(150, 150, 150), grid_angle=0.3), 55.0),
        (Style(width=9, fill=(220, 180, 90)), 55.0),
        (Style(width=2.5), 22.0),
        (Style(width=4), 150.0),
    ],
    ids=["dashes", "poor scan", "map with a grid", "band", "small", "large"],
)
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_loop_is_found_in_any_style_and_size(style: Style, radius: float, side: float) -> None:
    drawn = draw(looped_track(285.0, radius=radius, side=side), style, seed=2)
    _is_the_line(finish(propose_loops(_as_jpeg(drawn.pixels), drawn.track[[0, -1]])), drawn.track)


def test_two_loops_are_found_from_either_end() -> None:
    ramp = (25.0, 0.0, 0.02), (25.0, 0.02, 0.0)
    first = [(120.0, 0.0, 0.0), ramp[0], (210.0, 0.02, 0.02), ramp[1], (140.0, 0.0, 0.0), (30.0, 0.0, 0.01)]
    second = [(30.0, 0.01, 0.0), (120.0, 0.0, 0.0), (25.0, 0.0, -0.02), (220.0, -0.02, -0.02), (25.0, -0.02, 0.0)]
    drawn = draw(clothoid_track([*first, *second, (160.0, 0.0, 0.0)]), Style(width=3), seed=3)
    for clicks in (drawn.track[[0, -1]], drawn.track[[-1, 0]]):
        _is_the_line(finish(propose_loops(drawn.pixels, clicks)), drawn.track)


@pytest.mark.parametrize("seed", range(6))
def test_no_loop_is_found_on_a_track_without_one(seed: int) -> None:
    style = [
        Style(width=2, labels=40, ticks=True),
        Style(width=9),
        Style(width=2, double=12),
        Style(width=2, dash=(10, 8)),
        Style(width=1.6, grid=(20, 20, 20)),
        Style(width=1.4, noise=14),
    ][seed]
    drawn = draw(random_track(100 + seed, curves=10), style, seed=seed)
    assert finish(propose_loops(_as_jpeg(drawn.pixels), drawn.track[[0, -1]])) is None


def test_between_two_yields_there_is_at_most_a_tenth_of_a_second_of_work() -> None:
    drawn = draw(looped_track(285.0, radius=150.0), Style(width=6), seed=4)
    pixels = np.asarray(Image.fromarray(drawn.pixels).resize((2000, 1500)))
    scale = np.array([2000 / drawn.pixels.shape[1], 1500 / drawn.pixels.shape[0]])
    job = propose_loops(pixels, (drawn.track[[0, -1]] + 0.5) * scale - 0.5)
    longest = 0.0
    while True:
        before = time.process_time()
        try:
            next(job)
        except StopIteration:
            break
        longest = max(longest, time.process_time() - before)
    # Twice the promise: the machine that runs the tests may be slower than the one measured.
    assert longest < 0.2

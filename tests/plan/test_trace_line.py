"""A line through clicks: the sample plans, drawn pictures of many styles, and what must hold for any."""

from __future__ import annotations

import csv
import json
import time
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
import shapely

from bobdesk.errors import InputError
from bobdesk.plan.polyline_geometry import arc_lengths, self_crossings
from bobdesk.plan.trace import TraceSettings, propose_loops, trace_line
from bobdesk.plan.traced_line import Trace
from bobdesk.progress import finish

from PIL import Image  # isort: skip

from .drawn_lines import Array, Style, draw, exact_line, random_track

_PLANS = Path(__file__).parents[1] / "data" / "plans"
_INDEX = {plan["style"]: plan for plan in json.loads((_PLANS / "index.json").read_text())}


def _deviation(trace: Trace, truth: Array) -> tuple[float, float, float]:
    """Mean and largest distance of the truth from the trace, and the largest of the trace from the truth."""
    there = shapely.distance(shapely.LineString(trace.points), shapely.points(truth))
    back = shapely.distance(shapely.LineString(truth), shapely.points(trace.points))
    return float(there.mean()), float(there.max()), float(back.max())


def _plan(style: str) -> tuple[npt.NDArray[np.uint8], Array, Array]:
    """Pixels, truth and clicks of a sample plan, two of these in each loop."""
    plan = _INDEX[style]
    pixels = np.asarray(Image.open(_PLANS / plan["file"]))
    with (_PLANS / plan["truth"]).open() as lines:
        truth = np.array([[float(row["px"]), float(row["py"])] for row in csv.DictReader(lines)])
    vias = [
        truth[round(first + share * (second - first))]
        for first, second in plan["crossing_stations_m"]
        for share in (1 / 3, 2 / 3)
    ]
    return pixels, truth, np.array([plan["start_px"], *vias, plan["end_px"]])


@pytest.mark.parametrize("style", ["band", "dashed", "double_scan"])
def test_a_sample_plan_is_traced_to_a_tenth_of_a_pixel(style: str) -> None:
    pixels, truth, clicks = _plan(style)
    trace = finish(trace_line(pixels, clicks))
    mean, furthest, _ = _deviation(trace, truth)
    assert mean < 0.1
    assert furthest < 1.0
    assert np.hypot(*(trace.points[0] - clicks[0])) < 1.0
    assert np.hypot(*(trace.points[-1] - clicks[-1])) < 1.0
    assert trace.kind == {"band": "single", "dashed": "dashed", "double_scan": "double"}[style]
    assert trace.warnings == ()


def test_without_points_on_the_loop_the_trace_says_where_it_was_cut_and_a_proposal_goes_around() -> None:
    pixels, truth, clicks = _plan("double_scan")
    ends = clicks[[0, -1]]
    trace = finish(trace_line(pixels, ends, settings=TraceSettings(known_length_px=arc_lengths(truth)[-1])))
    first, _ = _INDEX["double_scan"]["crossing_stations_m"][0]
    x, y = truth[round(first)]
    assert len(trace.warnings) == 2
    assert f"{x:.0f}"[:-1] in trace.warnings[0]
    assert "cut a loop" in trace.warnings[0]
    assert "shorter than the known" in trace.warnings[1]
    middles = trace.points[trace.suspect.mean(axis=1).astype(int)]
    assert np.hypot(*(middles - [x, y]).T).min() < 20
    proposal = finish(propose_loops(pixels, ends))
    assert proposal is not None
    assert _deviation(proposal, truth)[1] < 1.0


def test_no_loop_is_proposed_where_there_is_none() -> None:
    pixels, _, clicks = _plan("dashed")
    assert finish(propose_loops(pixels, clicks)) is None


_STYLES = {
    "hairline, grain": Style(width=1.2, noise=14),
    "grid of the same colour": Style(width=1.6, grid=(20, 20, 20)),
    "turned grid": Style(width=1.6, grid=(60, 60, 60), grid_width=1.2, grid_angle=0.3),
    "light on blue": Style(width=1.6, colour=(220, 230, 255), paper=(30, 60, 140), grid=(70, 100, 180)),
    "broad stroke": Style(width=20, colour=(90, 90, 90)),
    "edges far apart": Style(width=2, double=16),
    "dashes with long gaps": Style(width=2, dash=(10, 12)),
    "two colours": Style(width=2.5, colour=(200, 30, 30), second_colour=(30, 60, 200)),
    "map": Style(width=2.5, colour=(200, 30, 30), patches=((190, 215, 170), (170, 200, 230), (140, 180, 120))),
    "aerial": Style(
        width=6,
        colour=(175, 170, 165),
        paper=(70, 90, 60),
        patches=((60, 80, 50), (90, 100, 70), (110, 100, 80)),
        noise=18,
        blur=1,
        labels=4,
    ),
    "poor scan": Style(width=2, blur=1.2, noise=10, shade=0.35, grid=(180, 180, 180), ticks=True),
}


@pytest.mark.parametrize("name", list(_STYLES))
def test_a_drawn_track_is_found_in_any_style(name: str) -> None:
    drawn = draw(random_track(1, curves=8), _STYLES[name], seed=1)
    trace = finish(trace_line(drawn.pixels, drawn.track[[0, -1]]))
    mean, furthest, beside = _deviation(trace, drawn.track)
    # The drawing itself is good to an eighth of a pixel.
    assert mean < 0.3
    assert furthest < 2.0
    assert beside < 2.5


def test_clicks_off_the_line_snap_to_it_and_neither_shorten_nor_prolong_it() -> None:
    drawn = draw(random_track(3, curves=6), Style(width=2.5), seed=3)
    before = drawn.track[0] + [-4.0, 1.5]
    after = drawn.track[-1] + 2.5
    trace = finish(trace_line(drawn.pixels, np.array([before, after])))
    assert np.hypot(*(trace.points[0] - drawn.track[0])) < 1.5
    assert _deviation(trace, drawn.track)[2] < 4.0
    within = finish(trace_line(drawn.pixels, drawn.track[[60, -60]] + [0.0, 3.0]))
    assert np.hypot(*(within.points[0] - drawn.track[60])) < 3.1
    assert np.hypot(*(within.points[-1] - drawn.track[-60])) < 3.1


def test_circle_and_clothoid_drawn_at_known_places_come_back_within_a_tenth_of_a_pixel() -> None:
    angle = np.linspace(0.3, 5.6, 2000)
    circle = np.column_stack([150.3 + 90.7 * np.cos(angle), 151.8 + 90.7 * np.sin(angle)])
    heading = np.cumsum(np.linspace(0, 1 / 40, 1200)) * 0.25
    clothoid = 40.4 + 0.25 * np.cumsum(np.column_stack([np.cos(heading), np.sin(heading)]), axis=0)
    for line in (circle, clothoid):
        pixels = exact_line(line, width=3.0, size=(300, 330))
        trace = finish(trace_line(pixels, line[[0, -1]]))
        mean, furthest, beside = _deviation(trace, line)
        assert mean < 0.03
        assert furthest < 0.1
        assert beside < 0.1


def test_a_mirrored_picture_gives_the_mirrored_trace() -> None:
    drawn = draw(random_track(2, curves=6), Style(width=3, double=9), seed=2)
    plain = finish(trace_line(drawn.pixels, drawn.track[[0, -1]]))
    width = drawn.pixels.shape[1]
    clicks = drawn.track[[0, -1]] * [-1, 1] + [width - 1, 0]
    mirrored = finish(trace_line(np.ascontiguousarray(drawn.pixels[:, ::-1]), clicks))
    turned = mirrored.points * [-1, 1] + [width - 1, 0]
    assert _deviation(plain, turned)[0] < 0.02
    assert _deviation(plain, turned)[1] < 0.1


@pytest.mark.parametrize("layout", ["1-bit", "8-bit", "16-bit", "RGBA"])
def test_every_layout_of_pixels_gives_the_same_line(layout: str) -> None:
    drawn = draw(random_track(4, curves=5), Style(width=3), seed=4)
    grey = drawn.pixels.mean(axis=2)
    pixels = {
        "1-bit": grey > 130,
        "8-bit": grey.astype(np.uint8),
        "16-bit": (grey * 40 + 2000).astype(np.uint16),
        "RGBA": np.dstack([np.zeros_like(drawn.pixels), (255 - grey).astype(np.uint8)]),
    }[layout]
    pixels.flags.writeable = False
    trace = finish(trace_line(pixels, drawn.track[[0, -1]]))
    mean, furthest, _ = _deviation(trace, drawn.track)
    assert mean < 0.25
    assert furthest < 1.0


def test_one_point_in_a_loop_is_enough_to_go_around_it() -> None:
    drawn = draw(random_track(2, loop=True, curves=6), Style(width=2.5, labels=4), seed=2)
    along = arc_lengths(drawn.track)
    loop = self_crossings(drawn.track)[0]
    via = drawn.track[np.searchsorted(along, 0.5 * (loop.first + loop.second))]
    trace = finish(trace_line(drawn.pixels, np.array([drawn.track[0], via, drawn.track[-1]])))
    assert _deviation(trace, drawn.track)[1] < 4.0
    assert abs(trace.length_px - along[-1]) < 0.02 * along[-1]


def test_what_hides_the_line_is_bridged_and_named() -> None:
    drawn = draw(random_track(3, curves=6), Style(width=2.5, labels=0), seed=3)
    pixels = drawn.pixels.copy()
    middle = len(drawn.track) // 2
    x, y = drawn.track[middle].astype(int)
    pixels[y - 30 : y + 31, x - 30 : x + 31] = 245
    trace = finish(trace_line(pixels, drawn.track[[0, -1]]))
    hidden = np.abs(trace.points - [x, y]).max(axis=1) < 12
    clear = np.abs(trace.points - [x, y]).max(axis=1) > 50
    assert trace.confidence[hidden].max() < 0.6
    assert trace.confidence[clear].min() > 0.7
    assert any("hardly shows the line" in sentence for sentence in trace.warnings)
    assert len(trace.suspect) == 1


def test_a_trace_is_a_value_with_points_about_two_pixels_apart() -> None:
    drawn = draw(random_track(5, curves=4), Style(), seed=5)
    trace = finish(trace_line(drawn.pixels, drawn.track[[0, -1]]))
    gaps = np.diff(arc_lengths(trace.points))
    assert gaps.min() > 1.9
    assert gaps.max() < 2.1
    assert trace.confidence.shape == (len(trace.points),)
    for values in (trace.points, trace.confidence, trace.suspect):
        assert not values.flags.writeable


def test_between_two_yields_there_is_at_most_a_tenth_of_a_second_of_work() -> None:
    pixels, _, clicks = _plan("double_scan")
    longest = 0.0
    fractions = []
    job = trace_line(pixels, clicks)
    while True:
        before = time.process_time()
        try:
            fractions.append(next(job).fraction)
        except StopIteration:
            break
        longest = max(longest, time.process_time() - before)
    # Twice the promise: the machine that runs the tests may be slower than the one measured.
    assert longest < 0.2
    assert min(fractions) >= 0.0
    assert max(fractions) <= 1.0


@pytest.mark.parametrize(
    ("clicks", "sentence"),
    [
        ([[5.0, 5.0]], "at least two points"),
        ([[5.0, 5.0], [900.0, 5.0]], "outside the picture"),
        ([[5.0, 5.0], [119.6, 5.0]], "119.6,5 lies outside the picture of 120 x 100 pixels"),
        ([[5.0, -0.6], [50.0, 5.0]], "outside the picture"),
        ([[5.0, 5.0], [np.nan, 5.0]], "not a number"),
        ([[5.0, 5.0], [5.2, 5.0], [50.0, 50.0]], "the same place"),
    ],
)
def test_clicks_that_cannot_be_used_are_named(clicks: list[list[float]], sentence: str) -> None:
    with pytest.raises(InputError, match=sentence):
        finish(trace_line(np.zeros((100, 120), dtype=np.uint8), clicks))


@pytest.mark.parametrize("pixels", [np.zeros((50, 50, 2), np.uint8), np.zeros((50, 50)), np.zeros((4, 90), np.uint8)])
def test_pixels_that_cannot_be_used_are_named(pixels: npt.NDArray[np.generic]) -> None:
    with pytest.raises(InputError, match=r"layout|too small"):
        finish(trace_line(pixels, [[1, 1], [40, 2]]))


def test_an_empty_picture_gives_a_trace_that_says_so() -> None:
    trace = finish(trace_line(np.full((200, 300), 255, np.uint8), [[20.0, 20.0], [250.0, 180.0]]))
    assert trace.confidence.max() < 0.5
    assert "hardly a line" in trace.warnings[0]


@pytest.mark.parametrize("width", [3.0, 5.0, 7.0, 9.0, 13.0, 20.0])
def test_a_stroke_with_sharp_edges_is_followed_whatever_its_width(width: float) -> None:
    drawn = draw(
        random_track(3, curves=9, radius=60.0), Style(width=width, colour=(200, 30, 30), paper=(232, 236, 226)), seed=3
    )
    trace = finish(trace_line(drawn.pixels, drawn.track[[0, -1]]))
    apart = shapely.distance(shapely.LineString(trace.points), shapely.points(drawn.track))
    assert apart.mean() < 0.5
    assert trace.kind == "single"
    assert not any("hardly a line" in warning for warning in trace.warnings)

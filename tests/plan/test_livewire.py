"""A wire between two clicks follows what is drawn: circles, crossings, two edges, grey scans."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from bobdesk.errors import InputError
from bobdesk.plan.livewire import LiveWire, anchored, followed, prepare
from bobdesk.progress import finish
from tests.plan.drawn_lines import Style, clothoid_track, draw, exact_line

_RADIUS = 120.0


def circle(share: float = 1.0) -> np.ndarray:
    angle = np.linspace(0, 2 * np.pi * share, 2000)
    return np.column_stack([200 + _RADIUS * np.cos(angle), 200 + _RADIUS * np.sin(angle)])


@pytest.fixture(scope="module")
def wire() -> LiveWire:
    """A circle on grey paper."""
    return finish(prepare(exact_line(circle(), width=2.0, size=(400, 400))))


def off_circle(points: np.ndarray) -> np.ndarray:
    return np.abs(np.hypot(points[:, 0] - 200, points[:, 1] - 200) - _RADIUS)


def test_the_preview_lies_within_a_pixel_of_a_circle_and_what_is_taken_within_a_tenth(wire: LiveWire) -> None:
    ends = circle()[[100, 700]]
    anchor = anchored(wire, tuple(ends[0] + [3, -2]))
    path = anchor.path(tuple(ends[1] + [-3, 3]))
    assert off_circle(path).max() < 1.0
    found = finish(followed(wire, anchor, path))
    assert off_circle(found.points).max() < 0.1
    assert np.hypot(*(found.points[0] - ends[0])) < 4.0
    assert np.hypot(*(found.points[-1] - ends[1])) < 5.0
    assert found.confidence.min() > 0.5
    assert found.width == pytest.approx(2.0, abs=0.5)


def test_the_wire_takes_the_shorter_way_around(wire: LiveWire) -> None:
    start = circle()[0]
    quarter = anchored(wire, tuple(start)).path(tuple(circle()[500]))
    length = np.hypot(*np.diff(quarter, axis=0).T).sum()
    assert length == pytest.approx(np.pi / 2 * _RADIUS, rel=0.03)


def test_a_crossing_does_not_lead_astray_when_clicks_lie_on_both_sides_of_it() -> None:
    pixels = np.minimum(
        exact_line(circle(), width=2.0, size=(400, 400)),
        exact_line(np.array([[40.0, 200.0], [380.0, 210.0]]), width=2.0, size=(400, 400)),
    )
    wire = finish(prepare(pixels))
    ends = circle()[[1850, 150]]
    path = anchored(wire, tuple(ends[0])).path(tuple(ends[1]))
    assert off_circle(path).max() < 1.5


def test_two_edges_are_brought_to_their_middle() -> None:
    drawn = draw(clothoid_track([(150, 0, 0), (60, 0, 0.01), (80, 0.01, 0.01), (100, 0, 0)]), Style(double=9.0), seed=2)
    wire = finish(prepare(drawn.pixels))
    anchor = anchored(wire, tuple(drawn.track[60]))
    found = finish(followed(wire, anchor, anchor.path(tuple(drawn.track[500]))))
    away = cKDTree(drawn.track).query(found.points)[0]
    assert away.max() < 1.0
    assert found.width > 6.0


def test_beyond_its_window_the_wire_goes_on_straight(wire: LiveWire) -> None:
    anchor = anchored(wire, tuple(circle()[0]))
    path = anchor.path((2000.0, 200.0))
    assert path[-1] == pytest.approx([2000.0, 200.0])


def test_to_the_same_place_leads_a_short_wire_that_is_left_as_it_is(wire: LiveWire) -> None:
    anchor = anchored(wire, tuple(circle()[0]))
    path = anchor.path(anchor.place)
    assert np.hypot(*np.diff(path, axis=0).T).sum() < 5
    assert (finish(followed(wire, anchor, path)).points == path).all()


def test_a_picture_too_small_is_refused() -> None:
    with pytest.raises(InputError, match="too small"):
        finish(prepare(np.zeros((4, 4), dtype=np.uint8)))


def test_plain_paper_gives_some_wire_and_no_error() -> None:
    wire = finish(prepare(np.full((100, 120), 240, dtype=np.uint8)))
    path = anchored(wire, (20.0, 20.0)).path((90.0, 80.0))
    assert np.isfinite(path).all()

"""Geometry of polylines and the middle between two edges, against circles and lines."""

from __future__ import annotations

import numpy as np
import pytest

from bobdesk.errors import InputError
from bobdesk.plan.midline import midline
from bobdesk.plan.polyline_geometry import (
    arc_lengths,
    extended,
    nearest_station,
    nearest_vertex,
    normals,
    offset_line,
    part_between,
    resampled,
    self_crossings,
    simplified,
    simplified_indices,
    whittaker_smoothed,
)

from .drawn_lines import Array, random_track


def _arc(radius: float, start: float = 0.0, end: float = 2.0, count: int = 2000) -> Array:
    angle = np.linspace(start, end, count)
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def test_a_figure_eight_crosses_itself_once_and_a_closed_circle_never() -> None:
    t = np.linspace(0.3, 2 * np.pi + 0.2, 800)
    eight = np.column_stack([np.sin(t), np.sin(t) * np.cos(t)]) * 100
    found = self_crossings(eight)
    assert len(found) == 1
    assert np.hypot(found[0].x, found[0].y) < 0.01
    assert found[0].first < found[0].second
    circle = _arc(50, 0, 2 * np.pi)
    circle[-1] = circle[0]
    assert self_crossings(circle) == ()


def test_a_drawn_kreisel_crosses_itself_once() -> None:
    assert len(self_crossings(random_track(2, loop=True, curves=6))) == 1


def test_normals_of_a_circle_point_to_its_middle_when_it_turns_from_x_to_y() -> None:
    points = _arc(30)
    assert np.abs((normals(points) * points).sum(axis=1) + 30).max() < 0.01


def test_an_offset_circle_has_another_radius() -> None:
    inner = offset_line(_arc(30), distance=5)
    assert np.abs(np.hypot(*inner.T) - 25).max() < 0.05


def test_cutting_and_prolonging_keep_to_the_line() -> None:
    line = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]])
    part = part_between(line, start=4.0, end=13.0)
    assert part.tolist() == [[4, 0], [10, 0], [10, 3]]
    assert nearest_station(line, position=np.array([11.0, 4.0])) == pytest.approx(14.0)
    assert nearest_vertex(line, position=np.array([9.0, 1.0])) == 1
    longer = extended(resampled(line, step=1.0), length=3.0, step=1.0)
    assert longer[0].tolist() == [-3, 0]
    assert longer[-1].tolist() == [10, 13]


def test_simplified_lines_stay_within_the_tolerance() -> None:
    points = _arc(40)
    few = simplified(points, tolerance=0.2)
    assert len(few) < 30
    assert np.array_equal(points[simplified_indices(points, tolerance=0.2)], few)


def test_smoothing_leaves_a_parabola_and_goes_on_through_a_gap() -> None:
    t = np.linspace(-1, 1, 200)
    truth = np.column_stack([t, 5 * t**2])
    weights = np.ones(200)
    weights[90:110] = 1e-6
    noisy = truth.copy()
    noisy[90:110, 1] += 40
    smooth = whittaker_smoothed(noisy, weights=weights, wavelength=20.0)
    assert np.abs(smooth - truth).max() < 0.02


@pytest.mark.parametrize("turned", [False, True])
def test_the_middle_of_two_circles_is_the_circle_between(turned: bool) -> None:
    inner, outer = _arc(40, count=300), _arc(52, count=900)
    middle = midline(inner, outer[::-1] if turned else outer, step=1.0)
    assert np.abs(np.hypot(*middle.T) - 46).max() < 0.05
    assert arc_lengths(middle)[-1] == pytest.approx(92, abs=0.5)
    assert not middle.flags.writeable


def test_edges_that_do_not_run_beside_each_other_are_refused() -> None:
    with pytest.raises(InputError, match="do not run beside"):
        midline(_arc(40), _arc(40, 0, 0.5))
    with pytest.raises(InputError, match="too short"):
        midline(_arc(40), np.zeros((2, 2)))

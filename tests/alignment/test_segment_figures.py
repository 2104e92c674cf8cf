import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bobdesk.alignment.segment_figures import fit_circle, segment_figures
from bobdesk.alignment.segments import Segment
from tests.alignment.made_lines import circle, correlated_noise, drive, fitted


@pytest.mark.parametrize(("bend", "direction"), [(1 / 25, "left"), (-1 / 25, "right")])
def test_figures_of_a_known_arc(bend, direction):
    centreline = fitted(drive([(60.0, 0.0, 0.0), (50.0, bend, bend), (60.0, 0.0, 0.0)]))
    figures = segment_figures(centreline, Segment("curve", 64, 106))
    assert figures.radius == pytest.approx(25.0, rel=0.005)
    assert figures.turn == pytest.approx(42 * bend, rel=0.01)
    assert figures.direction == direction
    assert figures.deviation < 0.02


def test_the_turn_of_a_whole_curve_is_its_angle():
    centreline = fitted(drive([(60.0, 0.0, 0.0), (50.0, 1 / 25, 1 / 25), (60.0, 0.0, 0.0)]))
    assert segment_figures(centreline, Segment("curve", 50, 120)).turn == pytest.approx(2.0, abs=2e-4)


def test_a_kreisel_turns_by_more_than_a_full_turn():
    bend = 1 / 20
    centreline = fitted(drive([(40.0, 0.0, 0.0), (150.0, bend, bend), (40.0, 0.0, 0.0)]))
    assert segment_figures(centreline, Segment("curve", 30, 200)).turn == pytest.approx(7.5, abs=1e-3)


def test_figures_of_a_straight():
    centreline = fitted(np.column_stack([np.linspace(0, 200, 60), np.linspace(0, 50, 60)]))
    straight = segment_figures(centreline, Segment("straight", 20, 120))
    assert straight.radius is None
    assert straight.turn == pytest.approx(0, abs=1e-9)
    assert straight.deviation < 1e-9
    assert segment_figures(centreline, Segment("curve", 20, 120)).radius == math.inf


def test_a_straight_over_an_arc_deviates_by_part_of_its_sagitta():
    centreline = fitted(circle(100.0, turn=2.0, count=300))
    figures = segment_figures(centreline, Segment("straight", 80, 120))
    sagitta = 100 * (1 - math.cos(0.2))
    # The best straight line through an arc halves the sagitta nearly: 2/3 of it is left at the ends.
    assert figures.deviation == pytest.approx(2 / 3 * sagitta, rel=0.05)


@settings(deadline=None, max_examples=50, derandomize=True)
@given(
    radius=st.floats(5, 500),
    turn=st.floats(0.15, 6.2),
    middle=st.tuples(st.floats(-1e4, 1e4), st.floats(-1e4, 1e4)),
)
def test_points_of_a_circle_give_that_circle(radius, turn, middle):
    centre, found = fit_circle(circle(radius, turn=turn, count=40) + np.array(middle))
    assert found == pytest.approx(radius, rel=1e-6)
    np.testing.assert_allclose(centre, middle, atol=1e-5 * radius)


def test_a_short_noisy_arc_is_not_fitted_too_small():
    points = circle(60.0, turn=0.5, count=31)
    found = [fit_circle(points + correlated_noise(31, sigma=0, rms=0.1, seed=seed))[1] for seed in range(200)]
    assert np.median(found) == pytest.approx(60.0, rel=0.02)


def test_points_on_a_line_have_no_circle():
    along = np.linspace(0, 50, 20)
    assert fit_circle(np.column_stack([along, 2 * along]))[1] > 1e5

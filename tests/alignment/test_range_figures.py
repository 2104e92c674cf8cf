import math

import numpy as np
import pytest

from bobdesk.alignment.boundary_comparison import compare_boundaries
from bobdesk.alignment.range_figures import range_figures

STATIONS = np.linspace(0.0, 100.0, 101)
BENDS = np.where((STATIONS >= 40) & (STATIONS <= 60), -0.05, 0.0)


def test_an_arc_has_its_radius_and_turn():
    found = range_figures(STATIONS, BENDS, 58.0, 42.5)
    assert (found.start, found.end, found.length) == (42.5, 58.0, 15.5)
    assert found.mean_radius == pytest.approx(20.0)
    assert found.least_radius == pytest.approx(20.0)
    assert found.turn == pytest.approx(-15.5 / 20)
    assert found.drop is None


def test_a_straight_has_no_radius_and_a_profile_gives_drop_and_gradient():
    found = range_figures(STATIONS, BENDS, -5.0, 30.0, profile=(STATIONS, 50.0 - 0.1 * STATIONS))
    assert found.mean_radius == found.least_radius == math.inf
    assert (found.start, found.drop, found.mean_gradient) == (0.0, pytest.approx(3.0), pytest.approx(0.1))


def test_boundaries_match_in_order_each_once():
    same = compare_boundaries(np.array([10.0, 20.0, 50.0]), np.array([11.0, 21.5, 22.0, 80.0]), within=3.0)
    assert same.pairs == ((10.0, 11.0), (20.0, 21.5))
    assert same.only_first == (50.0,)
    assert same.only_second == (22.0, 80.0)
    assert same.f1 == pytest.approx(4 / 7)
    assert same.moved == 2
    assert compare_boundaries(np.empty(0), np.empty(0)).f1 == 1.0

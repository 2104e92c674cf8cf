import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from bobdesk.alignment.centreline import at_stations, fit_centreline
from bobdesk.alignment.fit_settings import FitSettings
from bobdesk.errors import InputError
from bobdesk.plan.polyline import Polyline
from tests.alignment.made_lines import circle, correlated_noise, curve, drive, fitted, made_plan


def steps_of(centreline):
    return np.hypot(*np.diff(centreline.points, axis=0).T)


@pytest.mark.parametrize("spacing", [0.1, 0.3, 1.0, 2.5, 10.0])
@pytest.mark.parametrize(("wavelength", "off"), [(0.0, 1e-4), (15.0, 0.01)])
def test_a_circles_length_is_known(spacing, wavelength, off):
    radius, turn = 60.0, 5.0
    centreline = fitted(circle(radius, turn=turn, count=301), spacing=spacing, wavelength=wavelength)
    # Measured along chords: each is 2 R sin(angle / 2). Smoothing moves the two free ends by millimetres.
    count = len(centreline.stations) - 1
    assert centreline.length == pytest.approx(count * 2 * radius * np.sin(turn / count / 2), abs=off)
    assert centreline.spacing == pytest.approx(spacing, rel=0.02)


@pytest.mark.parametrize("spacing", [0.1, 1.0, 7.3, 10.0])
def test_all_steps_are_equal(spacing):
    centreline = fitted(made_plan(3), spacing=spacing)
    steps = steps_of(centreline)
    assert np.ptp(steps) < 1e-7
    np.testing.assert_allclose(np.diff(centreline.stations), steps, rtol=0, atol=1e-7)
    assert centreline.stations[0] == 0
    assert centreline.length == pytest.approx(steps.sum(), abs=1e-9)


def test_a_clothoids_length_and_ends_are_known():
    points = drive([(50.0, 0.0, 0.0), (40.0, 0.0, 1 / 30), (40.0, 1 / 30, 0.0), (50.0, 0.0, 0.0)], step=2.0)
    centreline = fitted(points)
    # Chords of 1 m lose R - R cos: length / (24 R^2) over the curve, about 1 mm.
    assert centreline.length == pytest.approx(180.0, abs=3e-3)
    np.testing.assert_allclose(centreline.points[[0, -1]], points[[0, -1]], atol=2e-3)
    exact = drive([(50.0, 0.0, 0.0), (40.0, 0.0, 1 / 30), (40.0, 1 / 30, 0.0), (50.0, 0.0, 0.0)], step=1.0)
    assert np.hypot(*(centreline.points - exact).T).max() < 0.02


def test_sparse_clicks_on_a_circle_do_not_cut_the_length():
    radius = 30.0
    clicks = circle(radius, count=11)
    apart = np.hypot(*(clicks[1] - clicks[0]))
    assert apart == pytest.approx(18.5, abs=0.1)
    cut = 1 - 10 * apart / (2 * np.pi * radius)
    assert cut > 0.015
    for wavelength in (0.0, 20.0):
        length = fitted(clicks, wavelength=wavelength).length
        assert abs(length / (2 * np.pi * radius) - 1) < 0.003


def test_jitter_of_dense_vertices_does_not_add_length():
    points = made_plan(5, step=2.0)
    noisy = points + correlated_noise(len(points), sigma=0, rms=0.2, seed=1)
    drawn = np.hypot(*np.diff(noisy, axis=0).T).sum()
    true = np.hypot(*np.diff(made_plan(5, step=0.1), axis=0).T).sum()
    assert drawn / true - 1 > 0.008
    assert abs(fitted(noisy).length / true - 1) < 0.0015


def test_a_long_straight_edge_beside_arcs_of_short_edges_stays_straight():
    arc = drive(curve(length=50.0, radius=25.0, ramp=1.0, left=True), step=2.0)
    ahead = arc[-1] - arc[-2]
    ahead /= np.hypot(*ahead)
    first_straight = np.array([[-120.0, 0.0]])
    second_straight = (arc[-1] + 100.0 * ahead)[None, :]
    points = np.concatenate([first_straight, arc, second_straight])
    centreline = fitted(points, wavelength=0.0)
    before = centreline.points[centreline.stations < 120.0]
    assert np.abs(before[:, 1]).max() < 0.02
    after = centreline.points[centreline.stations > 120.0 + 50.5]
    beside = (after - arc[-1]) @ np.array([-ahead[1], ahead[0]])
    assert np.abs(beside).max() < 0.02
    # Without the vertices that are put on the long edges the line bulges by more than half a metre.
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    assert np.abs(CubicSpline(along, points)(np.linspace(0, 120, 200))[:, 1]).max() > 0.5


def test_no_smoothing_goes_through_every_vertex():
    points = made_plan(7, step=5.0)
    centreline = fitted(points, wavelength=0.0, spacing=0.5)
    nearest = np.hypot(*(points[:, None, :] - centreline.points[None, :, :]).transpose(2, 0, 1)).min(axis=1)
    assert nearest.max() < 0.26
    fine = at_stations(centreline, np.arange(0.0, centreline.length, 0.01))
    nearest = [np.hypot(*(fine - point).T).min() for point in points[::7]]
    assert max(nearest) < 0.03


def test_a_straight_stays_the_straight_it_is():
    points = np.column_stack([np.linspace(0, 300, 61), 0.5 * np.linspace(0, 300, 61)])
    centreline = fitted(points)
    np.testing.assert_allclose(centreline.points[:, 1], 0.5 * centreline.points[:, 0], atol=1e-9)
    assert centreline.length == pytest.approx(300 * np.sqrt(1.25), abs=1e-8)


def test_stations_between_rows_lie_on_the_curve():
    centreline = fitted(circle(50.0, turn=4.0, count=200))
    between = at_stations(centreline, centreline.stations[:-1] + 0.5)
    np.testing.assert_allclose(np.hypot(*between.T), 50.0, atol=2e-3)
    np.testing.assert_allclose(at_stations(centreline, centreline.stations), centreline.points, atol=1e-9)


def test_nothing_of_it_can_be_written():
    centreline = fitted(made_plan(1))
    for array in (centreline.stations, centreline.points, centreline.raw_points):
        assert not array.flags.writeable


def test_the_same_inputs_are_fitted_once():
    polyline = Polyline(made_plan(1))
    assert fit_centreline(polyline, FitSettings(2.0)) is fit_centreline(polyline, FitSettings(2.0))


@pytest.mark.parametrize(
    ("spacing", "wavelength", "length", "words"),
    [
        (0.05, 15, 100, "between 0.1 and 10 m, not 0.05 m"),
        (11, 15, 1000, "between 0.1 and 10 m, not 11 m"),
        (float("nan"), 15, 100, "spacing"),
        (1, -1, 100, "wavelength must lie between 0 and 200 m, not -1 m"),
        (1, float("nan"), 100, "wavelength"),
        (1, 201, 100, "not 201 m"),
        (1, 15, 7.9, "only 7.9 m long, too short for stations every 1 m"),
        (1, 15, 2e6, "more than 1,000,000 stations"),
    ],
)
def test_settings_out_of_range_are_named(spacing, wavelength, length, words):
    points = np.column_stack([np.linspace(0, length, 50), np.zeros(50)])
    with pytest.raises(InputError, match=words):
        fitted(points, spacing=spacing, wavelength=wavelength)


@settings(deadline=None, max_examples=15, derandomize=True)
@given(
    seed=st.integers(0, 1000),
    angle=st.floats(-np.pi, np.pi),
    shift=st.tuples(st.floats(-1e5, 1e5), st.floats(-1e5, 1e5)),
)
def test_a_turned_and_shifted_plan_gives_the_turned_and_shifted_line(seed, angle, shift):
    points = made_plan(seed, curves=3)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    before = fitted(points)
    after = fitted(points @ turn.T + np.array(shift))
    assert after.length == pytest.approx(before.length, rel=1e-9)
    np.testing.assert_allclose(after.points, before.points @ turn.T + np.array(shift), atol=1e-6)

import numpy as np
import pytest

from bobdesk.alignment.curvature import curvature, curvature_by_differences, heading, plane_curvature
from tests.alignment.made_lines import circle, correlated_noise, drive, fitted

CLOTHOID = [(60.0, 0.0, 0.0), (50.0, 0.0, 1 / 40), (40.0, 1 / 40, 1 / 40), (50.0, 1 / 40, 0.0), (60.0, 0.0, 0.0)]
CORNERS = np.array([0.0, 60.0, 110.0, 150.0, 200.0, 260.0])
BENDS = np.array([0.0, 0.0, 1 / 40, 1 / 40, 0.0, 0.0])


@pytest.mark.parametrize(("sign", "bend"), [(1, 1 / 35), (-1, -1 / 35)])
@pytest.mark.parametrize("method", ["fitted", "l1", "published"])
def test_a_circle_is_positive_to_the_left(method, sign, bend):
    points = circle(35.0, turn=5.0, count=200) * [1, sign]
    found = curvature(fitted(points), method)
    np.testing.assert_allclose(found[10:-10], bend, rtol=2e-3)


@pytest.mark.parametrize("method", ["fitted", "l1", "published"])
def test_a_straight_has_no_curvature(method):
    points = np.column_stack([np.linspace(0, 200, 50), np.linspace(10, 90, 50)])
    assert np.abs(curvature(fitted(points), method)).max() < 1e-8


@pytest.mark.parametrize("method", ["fitted", "l1", "published"])
def test_a_clothoids_curvature_grows_in_proportion(method):
    centreline = fitted(drive(CLOTHOID))
    exact = np.interp(centreline.stations, CORNERS, BENDS)
    off = np.abs(curvature(centreline, method) - exact)
    away = np.abs(centreline.stations[:, None] - CORNERS).min(axis=1) > 8
    assert off[away].max() < 2e-4
    assert off.max() < 2e-3


def test_the_best_quality_errs_least_under_noise():
    points = drive(CLOTHOID)
    errors = {method: [] for method in ("fitted", "l1", "published")}
    for seed in range(4):
        centreline = fitted(points + correlated_noise(len(points), sigma=0, rms=0.1, seed=seed))
        exact = np.interp(centreline.stations, CORNERS, BENDS)
        for method, of_method in errors.items():
            of_method.append(np.sqrt(np.mean((curvature(centreline, method) - exact)[5:-5] ** 2)))
    fitted_, l1, published = (np.mean(errors[method]) for method in ("fitted", "l1", "published"))
    assert l1 < fitted_ < 0.1 * published
    assert fitted_ < 4e-3


def test_l1_curvature_is_piecewise_linear():
    points = drive(CLOTHOID)
    centreline = fitted(points + correlated_noise(len(points), sigma=0, rms=0.1, seed=3))
    kinks = {m: np.abs(np.diff(curvature(centreline, m), 2)) for m in ("fitted", "l1")}
    share = {m: np.sort(k)[::-1][:30].sum() / k.sum() for m, k in kinks.items()}
    assert share["l1"] > 0.8 > share["fitted"]


def test_published_differences_of_a_case_worked_by_hand():
    # x = 0, 1, 2, 3, 4 and y = x^2. numpy.gradient: one-sided at the ends, central inside.
    x = np.arange(5.0)
    points = np.column_stack([x, x**2])
    first_y = np.array([1.0, 2.0, 4.0, 6.0, 7.0])
    second_y = np.array([1.0, 1.5, 2.0, 1.5, 1.0])
    expected = second_y / (1 + first_y**2) ** 1.5
    np.testing.assert_allclose(curvature_by_differences(points), expected, rtol=1e-14)


def test_the_formula_of_plane_curvature():
    first, second = np.array([[3.0, 4.0], [0.0, 2.0]]), np.array([[1.0, 2.0], [5.0, 1.0]])
    np.testing.assert_allclose(plane_curvature(first, second), [(6 - 4) / 125, (0 - 10) / 8])


def test_heading_turns_without_jumps():
    points = circle(30.0, turn=4 * np.pi, count=500)
    headings = heading(fitted(points))
    assert headings[0] == pytest.approx(np.pi / 2, abs=0.01)
    assert headings[-1] - headings[0] == pytest.approx(4 * np.pi, rel=2e-3)
    assert np.abs(np.diff(headings)).max() < 0.05


def test_curvature_is_computed_once_and_cannot_be_written():
    centreline = fitted(drive(CLOTHOID))
    assert curvature(centreline) is curvature(centreline)
    assert not curvature(centreline).flags.writeable
    assert not heading(centreline).flags.writeable

import numpy as np
import pytest

from bobdesk.alignment.segments import Segment
from bobdesk.solve.iterates import Solution
from bobdesk.solve.profile import make_profile
from bobdesk.track.centreline3d import make_centreline3d
from tests.alignment.made_lines import circle, fitted
from tests.solve.made_plans import straight_plan

THREE = (Segment("straight", 0, 40), Segment("curve", 40, 90), Segment("straight", 90, 150))


def solution_of(profile, gradients, *, start, scale=1.0, edge_gradients=None):
    edges = np.zeros(max(len(profile.held), 1)) if edge_gradients is None else np.array(edge_gradients)
    return Solution("pgd", profile, np.array(gradients), edges, scale, start, 0, "", 0, 0, 0, 0.0, 0.0)


def helix(radius, gradient):
    centreline = fitted(circle(radius, turn=5.0, count=400), wavelength=0.0, spacing=0.5)
    segments = (Segment("curve", 0.0, centreline.length),)
    profile = make_profile(centreline, segments)
    start = abs(gradient) * centreline.length
    return make_centreline3d(centreline, segments, solution_of(profile, [gradient], start=start))


@pytest.mark.parametrize("gradient", [0.0, 0.08, 0.25, -0.15])
def test_a_helix_has_its_known_curvature_and_length(gradient):
    radius = 40.0
    line = helix(radius, gradient)
    inner = slice(5, -5)
    np.testing.assert_allclose(line.curvature[inner], 1 / (radius * (1 + gradient**2)), rtol=1e-3)
    np.testing.assert_allclose(line.plan_curvature[inner], 1 / radius, rtol=1e-3)
    assert line.slope_lengths[-1] == pytest.approx(line.stations[-1] * np.sqrt(1 + gradient**2), rel=1e-7)
    np.testing.assert_allclose(line.gradients, gradient, atol=3e-6)
    assert line.headings[-1] - line.headings[0] == pytest.approx(5.0, abs=0.01)


def test_curvature_keeps_the_plans_sign():
    centreline = fitted(circle(40.0, turn=5.0, count=400) * [1, -1], wavelength=0.0)
    segments = (Segment("curve", 0.0, centreline.length),)
    line = make_centreline3d(centreline, segments, solution_of(make_profile(centreline, segments), [0.1], start=20.0))
    assert (line.curvature[3:-3] < 0).all()
    np.testing.assert_allclose(line.curvature[5:-5], -1 / (40 * 1.01), rtol=1e-3)


def test_a_vertical_curve_on_a_straight_has_its_known_curvature():
    profile = make_profile(straight_plan(150.0), THREE, transition=20.0)
    line = make_centreline3d(straight_plan(150.0), THREE, solution_of(profile, [0.0, 0.1, 0.1], start=11.0))
    # A ramp of 0.1 over 20 m: z'' = 0.005 and curvature 0.005 / (1 + g^2)^1.5.
    inside = (line.stations > 32) & (line.stations < 48)
    expected = 0.005 / (1 + line.gradients[inside] ** 2) ** 1.5
    np.testing.assert_allclose(line.curvature[inside], expected, rtol=1e-3)
    assert np.abs(line.curvature[line.stations < 28]).max() < 1e-5


def test_rows_of_a_kinked_profile():
    centreline = straight_plan(150.0)
    gradients = [0.1, 0.05, 0.2]
    line = make_centreline3d(centreline, THREE, solution_of(make_profile(centreline, THREE), gradients, start=18.5))
    assert line.elevations[[0, 40, 90, 150]] == pytest.approx([18.5, 14.5, 12.0, 0.0], abs=1e-6)
    assert line.segment_of[[0, 39, 40, 89, 90, 150]].tolist() == [0, 0, 1, 1, 2, 2]
    np.testing.assert_allclose(line.gradients[[39, 40, 41, 89, 90]], [0.1, 0.05, 0.05, 0.05, 0.2], atol=3e-6)
    np.testing.assert_allclose(line.segment_gradients, gradients, atol=1e-9)


def test_slope_lengths_are_sums_of_the_rows_as_written():
    line = helix(33.0, 0.11)
    np.testing.assert_array_equal(line.points, line.points.round(6))
    steps = np.linalg.norm(np.diff(line.points, axis=0), axis=1)
    np.testing.assert_allclose(line.slope_lengths, np.concatenate([[0], np.cumsum(steps)]), rtol=0, atol=1e-12)
    assert not np.signbit(line.points[line.points == 0]).any()


def test_a_scale_enlarges_plan_and_segments_and_flattens_curvature():
    centreline = fitted(circle(40.0, turn=5.0, count=400), wavelength=0.0)
    segments = (Segment("curve", 0.0, 90.0), Segment("curve", 90.0, centreline.length))
    profile = make_profile(centreline, segments)
    one = make_centreline3d(centreline, segments, solution_of(profile, [0.1, 0.1], start=50.0))
    two = make_centreline3d(centreline, segments, solution_of(profile, [0.1, 0.1], start=50.0, scale=2.0))
    np.testing.assert_allclose(two.points[:, :2], 2 * one.points[:, :2], atol=2e-6)
    np.testing.assert_allclose(50 - two.elevations, 2 * (50 - one.elevations), atol=2e-6)
    np.testing.assert_allclose(two.plan_curvature, one.plan_curvature / 2)
    np.testing.assert_allclose(two.gradients, one.gradients, atol=3e-6)
    assert two.segments[0].end == 180.0
    np.testing.assert_array_equal(two.segment_of, one.segment_of)


def test_nothing_of_it_can_be_written():
    line = helix(30.0, 0.1)
    for name in ("stations", "slope_lengths", "points", "headings", "gradients", "curvature", "elevations"):
        assert not getattr(line, name).flags.writeable, name

"""The published method on cases small enough to be worked by hand, and on a made track."""

from functools import cache

import numpy as np
import pytest

from bobdesk.alignment.segmentation import detect_segments
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segment
from bobdesk.progress import finish
from bobdesk.solve.published import published
from bobdesk.solve.settings import PublishedSettings, Weights
from bobdesk.solve.targets import Targets
from bobdesk.track.centreline3d import make_centreline3d
from bobdesk.track.figures import figures
from tests.alignment.made_lines import fitted, made_plan
from tests.solve.made_plans import straight_plan

PIECES = np.array([50.0, 30.0, 40.0])
SEGMENTS = (Segment("straight", 0, 50), Segment("curve", 50, 80), Segment("straight", 80, 120))
TARGETS = Targets(121.0, 9.0, mean_gradient=0.08)
WEIGHTS = Weights(2.0, 3.0, 0.0, 500.0)


def run(targets=TARGETS, **settings):
    iterates = []
    steps = published(straight_plan(120.0), SEGMENTS, targets, PublishedSettings(**{"weights": WEIGHTS} | settings))
    return finish(steps, iterates.append), iterates


def by_hand(heights, scale=1.0, targets=TARGETS):
    """Work out J of a straight plan: each segment is a straight line in space, and its own length."""
    plan = scale * PIECES
    length = np.sqrt(plan**2 + heights**2).sum()
    mean = (heights / plan).mean()
    return (
        2 * (targets.length - length) ** 2
        + 3 * (targets.drop - np.abs(heights).sum()) ** 2
        + 500 * (mean - targets.mean_gradient) ** 2
    )


def test_it_starts_with_equal_height_differences():
    _, iterates = run()
    np.testing.assert_allclose(iterates[0].gradients, 3.0 / PIECES, rtol=1e-12)
    assert iterates[0].objective == pytest.approx(by_hand(np.full(3, 3.0)), rel=1e-9)


def test_the_first_iterates_are_those_worked_by_hand():
    rate = 1e-4
    _, iterates = run(rate=rate, threshold=1e-12)
    first = np.full(3, 3.0)
    # The first update uses an assigned derivative of -100.
    second = first + rate * 100.0
    third = second - rate * (by_hand(second) - by_hand(first)) / (second - first)
    fourth = third - rate * (by_hand(third) - by_hand(second)) / (third - second)
    for iterate, heights in zip(iterates, (first, second, third, fourth), strict=False):
        np.testing.assert_allclose(iterate.gradients * PIECES, heights, rtol=1e-7)
        assert iterate.objective == pytest.approx(by_hand(heights), rel=1e-6)
        assert iterate.length == pytest.approx(np.hypot(PIECES, heights).sum(), abs=1e-8)
        assert iterate.drop == pytest.approx(heights.sum(), abs=1e-8)


def test_a_gradient_out_of_the_limits_is_put_on_the_limit_before_j_is_evaluated():
    targets = Targets(121.0, 9.0, mean_gradient=0.08, min_gradient=0.07, max_gradient=0.09)
    solution, iterates = run(targets)
    # 3 m each are gradients of 0.06, 0.1 and 0.075.
    np.testing.assert_allclose(iterates[0].gradients, [0.07, 0.09, 0.075], rtol=1e-12)
    assert iterates[0].objective == pytest.approx(by_hand(np.array([3.5, 2.7, 3.0]), targets=targets), rel=1e-9)
    # Equal steps of 1 mm: the first stays on its limit, as 3.5 + 0.001 is inside, the second is cut.
    np.testing.assert_allclose(iterates[1].gradients * PIECES, [3.501, 2.7, 3.001], rtol=1e-12)
    for iterate in iterates:
        assert (iterate.gradients >= 0.07 - 1e-15).all()
        assert (iterate.gradients <= 0.09 + 1e-15).all()
    assert solution.method == "published"


def test_with_an_unknown_scale_f_is_updated_in_the_same_way():
    rate = 1e-6
    targets = Targets(121.0, 9.0, mean_gradient=0.08, unknown_scale=True)
    _, iterates = run(targets, rate=rate, threshold=1e-12)
    h0, f0 = np.full(3, 3.0), 1.0
    h1, f1 = h0 + rate * 100, f0 + rate * 100
    change = by_hand(h1, f1, targets) - by_hand(h0, f0, targets)
    h2, f2 = h1 - rate * change / (h1 - h0), f1 - rate * change / (f1 - f0)
    change = by_hand(h2, f2, targets) - by_hand(h1, f1, targets)
    h3, f3 = h2 - rate * change / (h2 - h1), f2 - rate * change / (f2 - f1)
    for iterate, heights, scale in zip(iterates, (h0, h1, h2, h3), (f0, f1, f2, f3), strict=False):
        assert iterate.scale == pytest.approx(scale, rel=1e-9)
        np.testing.assert_allclose(iterate.gradients * scale * PIECES, heights, rtol=1e-6)


def test_it_ends_where_j_changes_by_less_than_the_threshold():
    solution, iterates = run(threshold=1e-3)
    changes = np.abs(np.diff([iterate.objective for iterate in iterates]))
    assert changes[-1] < 1e-3
    assert (changes[:-1] >= 1e-3).all()
    assert solution.status == 0
    assert "less than 0.001" in solution.message


def test_iterates_can_be_followed():
    solution, iterates = run()
    assert [iterate.number for iterate in iterates] == list(range(solution.nit + 1))
    assert {iterate.stage for iterate in iterates} == {"published"}
    assert solution.nfev == len(iterates)
    assert solution.objective == iterates[-1].objective
    np.testing.assert_array_equal(solution.gradients, iterates[-1].gradients)


def test_it_says_so_when_it_is_stopped():
    solution, iterates = run(max_iterations=3, threshold=0.0)
    assert solution.status == 1
    assert len(iterates) == 4
    assert "Stopped after 3 iterations" in solution.message


@cache
def made_track():
    """Return a made track of 1,280 m in some 29 segments, with a drop of 9 %."""
    points = made_plan(4, curves=14)
    centreline = fitted(points * (1280.0 / fitted(points).length))
    segments = detect_segments(centreline, SegmentationSettings(count=29))
    drop = 0.09 * 1280.0
    return centreline, segments, Targets(float(np.hypot(1280.0, drop)) + 0.6, drop)


def test_whistlers_figures_on_a_made_track_lead_to_the_published_deviations():
    points = made_plan(4, curves=14)
    centreline = fitted(points * (1278.1 / fitted(points).length))
    segments = detect_segments(centreline, SegmentationSettings(count=33))
    iterates = []
    solution = finish(published(centreline, segments, Targets(1278.0, 149.3)), iterates.append)
    found = figures(make_centreline3d(centreline, segments, solution))
    # The paper's Table 1 has 1286.7 m (0.7 % more) and 148.7 m (0.4 % less), drop / length 0.1156.
    # All height differences start equal and move alike here, so that the mean over the segments
    # stays what the start makes it, and only drop / length can be compared.
    assert 100 * (found.length / 1278.0 - 1) == pytest.approx(0.7, abs=0.15)
    assert -1.5 < 100 * (found.drop / 149.3 - 1) < -0.2
    assert found.mean_gradient_drop_per_length == pytest.approx(0.1156, abs=0.0015)
    assert found.mean_curvature_difference < 2e-3
    assert 20 < len(iterates) < 5000
    assert iterates[-1].objective < iterates[0].objective


@pytest.mark.parametrize("drawn", [0.9, 0.995, 1.003])
def test_a_scale_that_overshoots_ends_the_run_with_a_sentence(drawn):
    centreline, segments, targets = made_track()
    smaller = fitted(drawn * centreline.points, wavelength=0.0)
    scaled = tuple(Segment(s.kind, drawn * s.start, drawn * s.end) for s in segments)
    scaled = (*scaled[:-1], Segment(scaled[-1].kind, scaled[-1].start, smaller.length))
    iterates = []
    unknown = Targets(targets.length, targets.drop, unknown_scale=True)
    solution = finish(published(smaller, scaled, unknown, PublishedSettings(rate=1e-5)), iterates.append)
    assert solution.status == 2
    assert "overshoots" in solution.message
    assert 0.5 <= solution.scale <= 2
    assert solution.scale == iterates[-1].scale
    np.testing.assert_allclose(solution.gradients, iterates[-1].gradients, rtol=1e-12)
    assert np.isfinite(make_centreline3d(smaller, scaled, solution).points).all()


@pytest.mark.parametrize("drawn_at", [0.9, 1.0, 1.1])
def test_with_a_rate_that_suits_the_plan_the_scale_is_found(drawn_at):
    points = made_plan(1, curves=14)
    true = fitted(points)
    drop = 0.1 * true.length
    length = 1.0004 * float(np.hypot(true.length, drop))
    drawn = fitted(drawn_at * points)
    solution = finish(published(drawn, detect_segments(drawn), Targets(length, drop, unknown_scale=True)))
    assert solution.status == 0
    assert solution.scale * drawn_at == pytest.approx(1, abs=2e-3)

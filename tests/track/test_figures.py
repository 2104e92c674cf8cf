import numpy as np
import pytest

from bobdesk.alignment.segments import Segment
from bobdesk.solve.profile import make_profile
from bobdesk.solve.targets import Targets
from bobdesk.track.centreline3d import make_centreline3d
from bobdesk.track.figures import deviations, figures
from tests.solve.made_plans import straight_plan
from tests.track.test_centreline3d import THREE, helix, solution_of


def line_of(gradients, *, start, segments=THREE):
    centreline = straight_plan(segments[-1].end)
    return make_centreline3d(
        centreline, segments, solution_of(make_profile(centreline, segments), gradients, start=start)
    )


def test_the_three_mean_gradients_are_what_they_are_called():
    found = figures(line_of([0.1, 0.05, 0.2], start=18.5))
    length = 40 * np.sqrt(1.01) + 50 * np.sqrt(1.0025) + 60 * np.sqrt(1.04)
    assert found.length == pytest.approx(length, abs=1e-6)
    assert found.drop == pytest.approx(18.5, abs=1e-6)
    assert found.plan_length == pytest.approx(150, abs=1e-6)
    assert found.mean_gradient_drop_per_length == pytest.approx(18.5 / length, abs=1e-8)
    assert found.mean_gradient_drop_per_plan == pytest.approx(18.5 / 150, abs=1e-8)
    assert found.mean_gradient_segments == pytest.approx((0.1 + 0.05 + 0.2) / 3, abs=1e-7)
    assert (found.min_gradient, found.max_gradient) == pytest.approx((0.05, 0.2), abs=3e-6)


def test_the_drop_counts_to_the_lowest_point_not_to_the_end():
    found = figures(line_of([0.1, 0.1, -0.05], start=9.0))
    assert found.drop == pytest.approx(9.0, abs=1e-6)
    assert found.mean_gradient_segments == pytest.approx(0.05, abs=1e-7)
    assert found.min_gradient == pytest.approx(-0.05, abs=3e-6)


def test_the_mean_curvature_difference_of_a_helix():
    found = figures(helix(40.0, 0.2))
    assert found.mean_curvature_difference == pytest.approx(1 / 40 - 1 / (40 * 1.04), rel=0.05)


@pytest.mark.parametrize(
    ("definition", "value"),
    [("drop-per-length", "mean_gradient_drop_per_length"), ("drop-per-plan", "mean_gradient_drop_per_plan"),
     ("segments", "mean_gradient_segments")],
)  # fmt: skip
def test_deviations_follow_the_definition_of_the_target(definition, value):
    found = figures(line_of([0.1, 0.05, 0.2], start=18.5))
    off = deviations(found, Targets(150.0, 18.0, mean_gradient=0.1, mean_gradient_is=definition))
    assert off.mean_gradient == pytest.approx(100 * (getattr(found, value) / 0.1 - 1))
    assert off.length == pytest.approx(100 * (found.length - 150) / 150)
    assert off.drop == pytest.approx(100 * 0.5 / 18, abs=1e-4)


def test_without_a_target_there_is_no_deviation_of_the_mean_gradient():
    assert deviations(figures(line_of([0.1, 0.05, 0.2], start=18.5)), Targets(150.0, 18.0)).mean_gradient is None


def test_a_segment_is_as_steep_as_it_falls():
    segments = (Segment("straight", 0, 33.3), Segment("curve", 33.3, 90))
    line = line_of([0.1, 0.05], start=10.0, segments=segments)
    # Boundaries between rows: the row's own fall is shared by both.
    np.testing.assert_allclose(line.segment_gradients, [0.1, 0.05], atol=1e-3)

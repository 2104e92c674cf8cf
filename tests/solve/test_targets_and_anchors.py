import numpy as np
import pytest

from bobdesk.errors import InputError, TargetError
from bobdesk.solve.anchors import anchors_of, elevations_of, gradients_through, stations_of
from bobdesk.solve.targets import KnownElevation, Targets, check_targets, in_scale

NAN = float("nan")


@pytest.mark.parametrize(
    ("targets", "words"),
    [
        (Targets(NAN, 10), "length must lie between"),
        (Targets(0.5, 0.1), "length must lie between"),
        (Targets(1e7, 10), "length must lie between"),
        (Targets(100, NAN), "drop must be"),
        (Targets(100, 0), "drop must be more than 0 m"),
        (Targets(100, 100), "less than the length"),
        (Targets(100, 9, min_gradient=NAN), "smallest gradient"),
        (Targets(100, 9, max_gradient=10.5), r"largest gradient .* \(0\.1 is 10 %"),
        (Targets(100, 9, min_gradient=0.1, max_gradient=0.1), "less than the largest"),
        (Targets(100, 9, mean_gradient=NAN), "mean gradient"),
        (Targets(100, 9, mean_gradient=0.0), "drop divided by the length, so it must be more than 0"),
        (Targets(100, 9, mean_gradient=-0.09), "drop divided by the length, so it must be more than 0"),
        (Targets(100, 9, mean_gradient=-0.09, mean_gradient_is="drop-per-plan"), "length in plan, so it must be more"),
        (Targets(100, 9, known=(KnownElevation(NAN, 1),)), "two finite numbers"),
        (Targets(100, 9, known=(KnownElevation(5, 1, -1),)), "tolerance of the elevation at 5 m"),
        (Targets(100, 9, known=(KnownElevation(5, 1, NAN),)), "tolerance of the elevation at 5 m"),
    ],
)
def test_figures_that_are_no_figures_are_named(targets, words):
    with pytest.raises(InputError, match=words):
        check_targets(targets)


def test_usable_figures_are_returned():
    targets = Targets(100, 9, mean_gradient=0.09, known=(KnownElevation(5, 8),))
    assert check_targets(targets) is targets
    assert targets.segments_mean is None
    assert Targets(100, 9, mean_gradient=0.09, mean_gradient_is="segments").segments_mean == 0.09


def test_the_mean_of_the_segments_may_be_negative():
    targets = Targets(100, 9, mean_gradient=-0.01, mean_gradient_is="segments")
    assert check_targets(targets) is targets


def test_a_scale_moves_stations_and_no_elevations():
    known = in_scale(Targets(100, 9, known=(KnownElevation(5, 8, 0.5),)), 2.0).known
    assert known == (KnownElevation(10, 8, 0.5),)


def anchors(*known, drop=9.0, length=100.0, lowest=()):
    items = tuple(KnownElevation(*item) for item in known)
    found = anchors_of(Targets(length * 1.01, drop, known=items), length, lowest)
    return list(zip(stations_of(found).tolist(), elevations_of(found).tolist(), strict=True))


def test_anchors_run_from_the_drop_to_the_lowest_point():
    assert anchors() == [(0, 9), (100, 0)]
    assert anchors((60, 3), (20, 7)) == [(0, 9), (20, 7), (60, 3), (100, 0)]
    assert anchors((80, 0), (100, 4)) == [(0, 9), (80, 0), (100, 4)]
    assert anchors(lowest=(90,)) == [(0, 9), (90, 0), (100, 0)]


def test_what_is_known_twice_alike_counts_once():
    assert anchors((0, 9), (50, 4), (50, 4)) == [(0, 9), (50, 4), (100, 0)]


def test_a_station_just_beyond_the_end_counts_as_the_end():
    assert anchors((80, 0), (100.4, 4)) == [(0, 9), (80, 0), (100, 4)]
    with pytest.raises(TargetError, match="outside the line"):
        anchors((80, 0), (100.6, 4))


def test_the_gradient_through_an_anchor_is_that_of_a_parabola_between_the_means():
    # z = 9 - 0.2 s + 0.001 s^2 has the gradient 0.2 - 0.002 s.
    stations = np.array([0.0, 20.0, 50.0, 70.0])
    heights = 9 - 0.2 * stations + 0.001 * stations**2
    items = tuple(KnownElevation(float(s), float(z)) for s, z in zip(stations, heights, strict=True))
    through = gradients_through(items, scale=1.0, level_at_lowest=True)
    np.testing.assert_allclose(through, [0.16, 0.10], atol=1e-12)
    np.testing.assert_allclose(gradients_through(items, scale=2.0, level_at_lowest=True), [0.08, 0.05], atol=1e-12)


def test_a_lowest_point_within_the_line_is_passed_level_if_the_track_may_climb():
    items = tuple(KnownElevation(*item) for item in ((0.0, 9.0), (80.0, 0.0), (100.0, 4.0)))
    assert gradients_through(items, scale=1.0, level_at_lowest=True).tolist() == [0.0]
    assert gradients_through(items, scale=1.0, level_at_lowest=False)[0] != 0.0


def test_an_elevation_at_the_end_of_the_points_is_that_of_the_fitted_line():
    # Points of 1,204 m in all, whose fitted line is 1,204.06 m long.
    known = (KnownElevation(1050, 0), KnownElevation(1204, 8.34))
    found = anchors_of(Targets(1210, 102.5, known=known), 1204.06)
    assert [(anchor.station, anchor.elevation) for anchor in found] == [(0, 102.5), (1050, 0), (1204.06, 8.34)]
    further = (KnownElevation(1050, 0), KnownElevation(1203, 8.34))
    assert len(anchors_of(Targets(1210, 102.5, known=further), 1204.06)) == 4


def test_an_end_behind_a_known_lowest_point_is_free_unless_it_is_known():
    def end_of(*known, lowest=()):
        return anchors_of(Targets(101, 9, known=tuple(KnownElevation(*item) for item in known)), 100.0, lowest)[-1]

    assert end_of((80, 0)) == end_of((80, 0, 0.5)) == end_of((80, -0.2, 0.5)) == KnownElevation(100, 0, np.inf)
    assert end_of((80, 0), (90, 4)) == KnownElevation(100, 0, np.inf)
    # What may be 0, or is held at 0 to keep the drop, is not known to be the lowest point.
    assert end_of((80, 0.3, 0.5)) == end_of((80, 2)) == end_of(lowest=(80,)) == KnownElevation(100, 0)
    assert end_of((80, 0), (100, 4)) == KnownElevation(100, 4)
    assert end_of((80, 0), (100, 0)) == KnownElevation(100, 0)

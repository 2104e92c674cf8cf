import numpy as np
import pytest

from bobdesk.progress import finish
from bobdesk.solve.anchors import anchors_of, elevations_of, stations_of
from bobdesk.solve.pgd import pgd
from bobdesk.solve.targets import KnownElevation, Targets
from bobdesk.solve.tolerances import settled
from bobdesk.track.centreline3d import make_centreline3d
from tests.solve.made_plans import height_at, made
from tests.solve.test_pgd_any_plan import targets_for

BUMPY = ((200.0, 66.0), (400.0, 50.5), (600.0, 33.0), (800.0, 16.5))


def targets(tolerance, **others):
    return Targets(1010.0, 80.0, known=tuple(KnownElevation(s, z, tolerance) for s, z in BUMPY), **others)


def roughness(anchors):
    means = -np.diff(elevations_of(anchors)) / np.diff(stations_of(anchors))
    return float((np.diff(means) ** 2).sum())


@pytest.mark.parametrize("tolerance", [0.5, 1.5, 4.0])
def test_elevations_move_within_their_tolerance_and_become_smoother(tolerance):
    given = targets(tolerance)
    before = anchors_of(given, 1000.0)
    after = settled(before, given)
    moved = np.abs(elevations_of(after) - elevations_of(before))
    assert (moved[1:-1] <= tolerance + 1e-12).all()
    assert moved[[0, -1]].max() == 0
    assert moved.max() > 0.1
    assert roughness(after) < roughness(before)
    np.testing.assert_array_equal(stations_of(after), stations_of(before))


def test_a_wide_tolerance_ends_at_one_even_gradient():
    given = targets(10.0)
    after = settled(anchors_of(given, 1000.0), given)
    np.testing.assert_allclose(elevations_of(after), 80 - 0.08 * stations_of(after), atol=1e-4)


def test_more_tolerance_is_never_rougher():
    found = [roughness(settled(anchors_of(targets(t), 1000.0), targets(t))) for t in (0.0, 0.3, 1.0, 3.0)]
    assert (np.diff(found) <= 1e-12).all()


def test_without_tolerances_nothing_moves():
    given = targets(0.0)
    anchors = anchors_of(given, 1000.0)
    assert settled(anchors, given) is anchors


def test_an_exact_elevation_beside_tolerant_ones_stays():
    known = (KnownElevation(200.0, 66.0, 3.0), KnownElevation(500.0, 45.0), KnownElevation(800.0, 14.0, 3.0))
    given = Targets(1010.0, 80.0, known=known)
    after = settled(anchors_of(given, 1000.0), given)
    assert after[2].elevation == 45.0
    assert after[1].elevation != 66.0


def test_the_limits_are_kept_where_the_tolerances_allow():
    given = Targets(1010.0, 80.0, known=(KnownElevation(200.0, 70.0, 8.0),), max_gradient=0.085, min_gradient=0.06)
    after = settled(anchors_of(given, 1000.0), given)
    means = -np.diff(elevations_of(after)) / np.diff(stations_of(after))
    assert means.max() <= 0.085 + 1e-9
    assert means.min() >= 0.06 - 1e-9


def test_nothing_falls_below_the_lowest_point():
    known = (KnownElevation(700.0, 1.0, 5.0), KnownElevation(850.0, 0.0, 5.0))
    after = settled(anchors_of(Targets(1010.0, 80.0, known=known), 1000.0), Targets(1010.0, 80.0, known=known))
    assert elevations_of(after).min() >= 0


def test_the_result_lies_within_the_tolerances_and_is_smoother():
    centreline, segments = made(1, curves=5)
    length = centreline.length
    drop = 0.09 * length
    rng = np.random.default_rng(5)
    shares = np.linspace(0, 1, 7)[1:-1]
    heights = drop * (1 - shares) + rng.uniform(-1, 1, len(shares))

    def line(tolerance):
        known = tuple(
            KnownElevation(float(s * length), float(z), tolerance) for s, z in zip(shares, heights, strict=True)
        )
        solution = finish(pgd(centreline, segments, targets_for(centreline, more=1.0004, known=known)))
        return make_centreline3d(centreline, segments, solution)

    exact, tolerant = line(0.0), line(1.0)
    assert np.abs(height_at(exact, shares * length) - heights).max() < 1e-6
    assert np.abs(height_at(tolerant, shares * length) - heights).max() <= 1.0 + 1e-6
    assert np.abs(height_at(tolerant, shares * length) - heights).max() > 0.05
    assert tolerant.elevations[0] == pytest.approx(drop, abs=1e-6)


LOWEST_AT, LENGTH = 399.0, 443.445360636652


@pytest.mark.parametrize(
    "known",
    [
        ((LENGTH, 1.0, 2.0),),
        ((LOWEST_AT, 0.0, 0.5), (LENGTH, 8.0)),
        ((LOWEST_AT, 0.2, 0.5), (LENGTH, 8.0, 1.0)),
        ((LOWEST_AT, 0.0, 0.5),),
        ((LOWEST_AT, 0.0), (420.0, 5.0, 2.0)),
    ],
)
def test_the_drop_is_exact_though_the_lowest_point_has_a_tolerance(known):
    centreline, segments = made(1, curves=5)
    assert centreline.length == pytest.approx(LENGTH)
    given = targets_for(centreline, more=1.0006, known=tuple(KnownElevation(*item) for item in known))
    line = make_centreline3d(centreline, segments, finish(pgd(centreline, segments, given)))
    assert line.elevations.min() == pytest.approx(0, abs=1e-6)
    assert line.elevations[0] == pytest.approx(given.drop, abs=1e-6)
    for item in given.known:
        assert abs(height_at(line, item.station) - item.elevation) <= item.tolerance + 1e-6


def test_a_free_end_goes_on_from_what_is_known_before_it():
    known = (KnownElevation(800.0, 0.0), KnownElevation(900.0, 5.0))
    given = Targets(1010.0, 80.0, known=known)
    after = settled(anchors_of(given, 1000.0), given)
    assert after[-1] == KnownElevation(1000.0, pytest.approx(10.0, abs=1e-4))
    # Where nothing but the lowest point is known, level is the smoothest that does not lie below it.
    level = Targets(1010.0, 80.0, known=known[:1])
    assert settled(anchors_of(level, 1000.0), level)[-1] == KnownElevation(1000.0, pytest.approx(0.0, abs=1e-9))

"""An end of which nothing is known, behind a lowest point: what can be met with it, and what the result makes of it."""

from functools import cache

import pytest

from bobdesk.errors import TargetError
from bobdesk.progress import finish
from bobdesk.solve.feasibility import feasibility
from bobdesk.solve.pgd import pgd
from bobdesk.solve.targets import KnownElevation, Targets
from bobdesk.solve.tolerances import room_of_free_end
from bobdesk.track.centreline3d import make_centreline3d
from bobdesk.track.figures import figures
from tests.solve.made_plans import made

BEHIND = 120.0


@cache
def track():
    return made(1, curves=5)


def targets(*known, length=None, **limits):
    plan = track()[0].length
    lowest = KnownElevation(plan - BEHIND, 0.0)
    length = plan + 4.0 if length is None else length
    return Targets(length, 0.07 * plan, known=(lowest, *known), **({"min_gradient": -0.15} | limits))


def reachable(*known, **others):
    return feasibility(*track(), targets(*known, **others)).reachable_length


def line_of(wanted):
    return make_centreline3d(*track(), finish(pgd(*track(), wanted)))


def test_the_room_is_from_level_to_the_steepest_climb():
    plan = track()[0].length
    assert room_of_free_end(targets(), plan) == pytest.approx((0.0, 0.15 * BEHIND))
    five = KnownElevation(plan - 20.0, 5.0)
    assert room_of_free_end(targets(five), plan) == pytest.approx((5.0, 5.0 + 0.15 * 20.0))
    assert room_of_free_end(targets(KnownElevation(plan, 3.0)), plan) is None
    assert room_of_free_end(targets(min_gradient=0.0), plan) == (0.0, 0.0)


@pytest.mark.parametrize("share", [0.01, 0.3, 0.5, 0.7, 0.99])
def test_what_can_be_met_is_met_on_the_smoothest_course(share):
    low, high = reachable()
    line = line_of(targets(length=low + share * (high - low)))
    assert line.slope_lengths[-1] == pytest.approx(low + share * (high - low), rel=1e-6)
    assert line.elevations[-1] == pytest.approx(0.0, abs=1e-9)
    assert line.elevations[0] == pytest.approx(targets().drop, abs=1e-6)


def test_a_climb_that_the_length_would_need_is_named_and_not_made_up():
    plan = track()[0].length
    high = reachable()[1]
    steepest = reachable(KnownElevation(plan, 0.15 * BEHIND))[1]
    wanted = targets(length=high + 0.5)
    found = feasibility(*track(), wanted)
    assert not found.feasible
    assert f"with a climb to {0.15 * BEHIND:.1f} m there the longest is {steepest:.2f} m" in found.sentence
    line = line_of(wanted)
    assert line.elevations[-1] == pytest.approx(0.0, abs=1e-9)
    # No cliff: just beyond the reach the nearest length is that at its edge.
    assert line.slope_lengths[-1] == pytest.approx(high, abs=0.05)


def test_an_end_that_contradicts_the_limits_is_refused():
    with pytest.raises(TargetError, match="must fall by"):
        line_of(targets(KnownElevation(track()[0].length, 0.16 * BEHIND)))


def test_a_mean_over_the_segments_moves_the_end_where_it_must():
    # Above, the end climbs by what the smoothest profile of that mean does; held level, there is none.
    centreline, segments = made(1, curves=8)
    plan = centreline.length
    lowest = KnownElevation(0.8 * plan, 0.0)

    def wanted(*known):
        return Targets(696.0, 0.08 * plan, 0.04, "segments", known=(lowest, *known))

    with pytest.raises(TargetError, match="mean of the segments"):
        finish(pgd(centreline, segments, wanted(KnownElevation(plan, 0.0))))
    free = wanted()
    assert feasibility(centreline, segments, free).feasible
    line = make_centreline3d(centreline, segments, finish(pgd(centreline, segments, free)))
    assert line.slope_lengths[-1] == pytest.approx(696.0, rel=1e-6)
    assert figures(line).mean_gradient_segments == pytest.approx(0.04, abs=1e-6)
    assert line.elevations.min() == pytest.approx(0.0, abs=1e-6)
    assert 2.0 < line.elevations[-1] < 0.2 * 0.2 * plan

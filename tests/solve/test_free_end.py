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
from tests.solve.made_plans import height_at, made

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


@pytest.mark.parametrize("climb", [0.0, 6.0, 12.0, 17.0])
def test_what_can_be_met_with_some_end_can_be_met_with_a_free_one(climb):
    end = KnownElevation(track()[0].length, climb)
    held, free = reachable(end), reachable()
    assert free[0] <= held[0] + 1e-3
    assert free[1] >= held[1] - 1e-3


def test_the_end_climbs_by_no_more_than_the_length_asks_for():
    plan = track()[0].length
    level = reachable(KnownElevation(plan, 0.0))
    steep = reachable(KnownElevation(plan, 0.14 * BEHIND))
    assert line_of(targets(length=level[1] - 0.05)).elevations[-1] == pytest.approx(0.0, abs=1e-9)
    wanted = targets(length=0.5 * (level[1] + steep[1]))
    assert feasibility(*track(), wanted).feasible
    line = line_of(wanted)
    assert line.slope_lengths[-1] == pytest.approx(wanted.length, rel=1e-6)
    assert line.elevations.min() == pytest.approx(0.0, abs=1e-9)
    assert line.elevations[0] == pytest.approx(wanted.drop, abs=1e-6)
    end = float(line.elevations[-1])
    assert 1.0 < end < 0.14 * BEHIND
    lower = targets(KnownElevation(plan, end - 0.2), length=wanted.length)
    assert not feasibility(*track(), lower).feasible


def test_a_length_below_that_of_the_smoothest_course_levels_the_end():
    # Steep to the lowest point and on to 9 m: the smoothest course goes on climbing, which is longer than need be.
    plan = track()[0].length
    nine = KnownElevation(plan - 60.0, 9.0)
    shortest, longest = reachable(nine)
    level = reachable(nine, KnownElevation(plan, 9.0))
    assert shortest == pytest.approx(level[0], abs=1e-3)
    smooth = line_of(targets(nine, length=0.5 * (shortest + longest)))
    assert smooth.elevations[-1] > 12.0
    line = line_of(targets(nine, length=shortest + 0.02))
    assert line.slope_lengths[-1] == pytest.approx(shortest + 0.02, rel=1e-6)
    assert 8.9 < line.elevations[-1] < smooth.elevations[-1] - 1.0
    assert height_at(line, plan - 60.0) == pytest.approx(9.0, abs=1e-6)


def test_what_no_end_meets_keeps_the_smoothest_course():
    line = line_of(targets(length=reachable()[1] + 20.0))
    assert line.elevations[-1] == pytest.approx(0.0, abs=1e-9)


def test_an_end_that_contradicts_the_limits_is_refused():
    with pytest.raises(TargetError, match="must fall by"):
        line_of(targets(KnownElevation(track()[0].length, 0.16 * BEHIND)))

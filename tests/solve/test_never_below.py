"""A profile is nowhere below its lowest point, whatever is known there: else the drop is too large."""

from functools import cache

import numpy as np
import pytest

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import stretched
from bobdesk.errors import TargetError
from bobdesk.progress import finish
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.feasibility import feasibility
from bobdesk.solve.pgd import pgd
from bobdesk.solve.targets import KnownElevation, Targets
from bobdesk.solve.tolerances import settled
from bobdesk.track.centreline3d import make_centreline3d
from tests.solve import made_plans
from tests.solve.made_plans import height_at

made = cache(made_plans.made)


def check_line(track, targets):
    """Solve and return the line after a look at all that must hold exactly."""
    line = make_centreline3d(*track, finish(pgd(*track, targets)))
    assert line.elevations.min() == pytest.approx(0, abs=1.1e-6)
    assert line.elevations[0] - line.elevations.min() == pytest.approx(targets.drop, abs=2e-6)
    for item in targets.known:
        assert abs(height_at(line, item.station) - item.elevation) <= item.tolerance + 2e-6
    return line


def known(*items):
    return tuple(KnownElevation(*item) for item in items)


@pytest.mark.parametrize(
    ("seed", "curves", "length", "drop", "items"),
    [
        (0, 7, 634.84, 48.86, ((313.4, 0, 0.5), (328.3, 0.02), (332.8, 0.02, 0.5))),
        (3, 8, 649.73, 48.9, ((511.6, 0), (526.5, 0.02, 0.05), (646.2, 1.0, 0.5))),
        (1, 8, 694.5, 55.0, ((483.0, 0.02), (552.0, 5.0), (600.0, 3.0))),
    ],
)
def test_a_dip_beside_a_known_elevation_is_taken_out(seed, curves, length, drop, items):
    line = check_line(made(seed, curves=curves), Targets(length, drop, known=known(*items)))
    assert line.slope_lengths[-1] == pytest.approx(length, rel=1e-6)


@pytest.mark.parametrize("seed", range(14))
def test_what_is_said_to_be_possible_is_met_with_small_elevations_along_a_flat_end(seed):
    random = np.random.default_rng(seed)
    track = made(seed % 4, curves=6)
    plan = track[0].length
    drop = float(random.uniform(0.05, 0.1)) * plan
    at = float(random.uniform(0.5, 0.8)) * plan
    items = [(at, 0.0, float(random.choice([0.0, 0.0, 0.05, 0.5])))] if seed % 2 else []
    for _ in range(int(random.integers(1, 5))):
        at += float(random.uniform(4, 60))
        if at < plan - 3:
            items.append((at, float(random.choice([0, 0.02, 0.1, 0.5, 1.5])), float(random.choice([0, 0.05, 0.5, 2]))))
    targets = Targets(1.005 * plan, drop, known=known(*items))
    reachable = feasibility(*track, targets).reachable_length
    assert reachable is not None
    low, high = reachable
    length = low + float(random.uniform(0.05, 0.95)) * (high - low)
    line = check_line(track, Targets(length, drop, known=targets.known))
    assert line.slope_lengths[-1] == pytest.approx(length, rel=1e-6)


def test_another_elevation_is_the_lowest_point_where_the_first_one_cannot_be():
    track = made(1, curves=8)
    plan = track[0].length
    # 2.5 m, 5 m before an end that is given as lower: with limits of 25 % it cannot be 0.
    items = ((0.8 * plan, 0.5, 0.5), (plan - 5, 2.5), (plan, 0.4, 3.0))
    targets = Targets(1.005 * plan, 0.08 * plan, known=known(*items))
    held = settled(anchors_of(targets, plan), targets)
    assert held[1].elevation == 0.0
    check_line(track, targets)


def test_two_elevations_for_one_place_leave_what_both_allow():
    def held(*items):
        found = anchors_of(Targets(101, 9, known=known(*items)), 100.0)
        return [(item.station, item.elevation, item.tolerance) for item in found[1:]]

    assert held((50, 4, 1), (50, 5, 1)) == [(50, 4.5, 0.5), (100, 0, 0)]
    assert held((50, 4, 1), (50, 5)) == held((50, 5), (50, 4, 1)) == [(50, 5, 0), (100, 0, 0)]
    assert held((80, 0.3, 0.5), (80, 0)) == [(80, 0, 0), (100, 0, np.inf)]
    assert held((80, 0), (100, 4, 1), (100, 5, 1)) == [(80, 0, 0), (100, 4.5, 0.5)]
    for item in (50, 100):
        with pytest.raises(TargetError, match="contradicts 5 m: two elevations"):
            held((80, 0), (item, 5), (item, 6.5, 1))


@pytest.mark.parametrize("drawn", [0.2, 1.0, 2.0])
def test_a_steep_place_is_no_contradiction_at_the_wrong_scale(drawn):
    # 11.15 m in 45 m are nearly 25 %, and more than that where the plan is taken to be smaller than it is.
    plan, parts = made(1, curves=8)
    centreline = Centreline(drawn * plan.stations, drawn * plan.points, drawn * plan.raw_points)
    segments = stretched(parts, centreline.length)
    targets = Targets(697.0, 55.0, known=known((600.0 * drawn, 12.9), (645.0 * drawn, 1.75)), unknown_scale=True)
    found = feasibility(centreline, segments, targets)
    assert found.feasible, found.sentence
    line = make_centreline3d(centreline, segments, finish(pgd(centreline, segments, targets)))
    assert line.slope_lengths[-1] == pytest.approx(targets.length, rel=1e-6)
    assert line.stations[-1] / centreline.length == pytest.approx(found.scale, rel=1e-4)

import numpy as np
import pytest

from bobdesk.errors import TargetError
from bobdesk.progress import finish
from bobdesk.solve.feasibility import feasibility
from bobdesk.solve.pgd import pgd
from bobdesk.solve.settings import PgdSettings
from bobdesk.solve.targets import KnownElevation, Targets
from tests.alignment.made_lines import fitted, made_plan
from tests.solve.made_plans import made, plan_of

LENGTH, DROP = 1278.0, 149.3


def whistler_like():
    """Return a made plan that is 1278.1 m long, as that of the paper's Whistler data must be."""
    points = made_plan(4, curves=14)
    points = points * (1278.1 / fitted(points).length)
    return plan_of(points * (1278.1 / fitted(points).length))


def test_whistlers_length_is_out_of_reach_and_it_says_by_how_much_and_what_to_doubt():
    centreline, segments = whistler_like()
    assert centreline.length == pytest.approx(1278.1, abs=1e-3)
    found = feasibility(centreline, segments, Targets(LENGTH, DROP))
    shortest = np.hypot(1278.1, DROP)
    assert not found.feasible
    assert found.reachable_length[0] == pytest.approx(shortest, abs=2e-3)
    sentence = found.sentence
    assert "No 3D line of this plan is as short as 1278.00 m" in sentence
    assert f"the shortest is {shortest:.2f} m" in sentence
    assert "8.79 m (0.69 %) more" in sentence
    assert "drop of 149.30 m" in sentence
    assert "the plan alone is 1278.10 m long" in sentence
    assert "Doubt the length" in sentence
    assert f"a factor of {found.scale:.4f}" in sentence
    # At that scale a profile that swings as tracks do has the length: about sqrt(L^2 - H^2) of plan.
    without_swing = LENGTH / (1 + 0.5 * PgdSettings().typical_swing ** 2)
    assert found.scale == pytest.approx(np.sqrt(without_swing**2 - DROP**2) / 1278.1, abs=1e-4)


def test_a_length_within_reach_is_said_to_be_so_with_the_interval():
    centreline, segments = whistler_like()
    found = feasibility(centreline, segments, Targets(1288.0, DROP))
    assert found.feasible
    low, high = found.reachable_length
    assert low < 1288.0 < high
    assert f"between {low:.2f} m and {high:.2f} m" in found.sentence
    assert found.plan_length == centreline.length


def test_a_length_beyond_the_plausible_is_named_with_numbers():
    centreline, segments = whistler_like()
    found = feasibility(centreline, segments, Targets(1300.0, DROP))
    high = found.reachable_length[1]
    assert not found.feasible
    assert "as long as 1300.00 m" in found.sentence
    assert f"the longest is {high:.2f} m, {1300 - high:.2f} m" in found.sentence
    assert "Doubt the length" in found.sentence


def test_what_digitising_is_worth_is_said_where_it_matters():
    centreline, segments = whistler_like()
    found = feasibility(centreline, segments, Targets(float(np.hypot(1278.1, DROP)) - 0.5, DROP))
    assert "less than digitising a plan is often off by" in found.sentence
    assert "less than digitising" not in feasibility(centreline, segments, Targets(LENGTH, DROP)).sentence


def test_an_unknown_scale_makes_whistler_agree():
    centreline, segments = whistler_like()
    found = feasibility(centreline, segments, Targets(LENGTH, DROP, unknown_scale=True))
    assert found.feasible
    assert f"scale factor of {found.scale:.4f}" in found.sentence


CONTRADICTIONS = [
    ([(300, 50), (300, 60)], r"elevation 60 m at 300 m contradicts 50 m: two elevations for one station"),
    ([(0, 80)], r"elevation 80 m at 0 m contradicts 60 m: the start is at the drop"),
    ([(150, 30), (170, 40)], r"between 150 m and 170 m the elevation must fall by -10\.00 m"),
    ([(100, 59), (200, 20)], r"between 100 m and 200 m the elevation must fall by 39\.00 m"),
    ([(9000, 5)], r"elevation known at 9000 m lies outside the line"),
    ([(-3, 5)], r"elevation known at -3 m lies outside the line"),
    ([(200, -4)], r"elevation at 200 m is -4 m, below the lowest point"),
    ([(100, 100)], r"between 0 m and 100 m the elevation must fall by -40\.00 m"),
]


@pytest.mark.parametrize(("known", "words"), CONTRADICTIONS)
def test_contradicting_known_elevations_are_named(known, words):
    centreline, segments = made(1)
    items = tuple(KnownElevation(float(station), float(z)) for station, z in known)
    targets = Targets(centreline.length * 1.005, 60.0, known=items)
    with pytest.raises(TargetError, match=words) as caught:
        finish(pgd(centreline, segments, targets))
    found = feasibility(centreline, segments, targets)
    assert not found.feasible
    assert found.reachable_length is None
    assert str(caught.value)[1:] in found.sentence


def test_a_stretch_above_the_reach_of_the_limits_says_what_it_could_fall():
    centreline, segments = made(1)
    targets = Targets(centreline.length * 1.005, 60.0, known=(KnownElevation(100.0, 59.0), KnownElevation(200.0, 20.0)))
    sentence = feasibility(centreline, segments, targets).sentence
    assert "with gradients from -20 % to 25 % it can fall by -20.00 m to 25.00 m only" in sentence
    assert "doubt the elevations there or the limits" in sentence


def test_a_drop_that_the_limits_cannot_reach():
    centreline, segments = made(1, curves=3)
    sentence = feasibility(centreline, segments, Targets(centreline.length * 1.1, 0.3 * centreline.length)).sentence
    assert f"must fall by {0.3 * centreline.length:.2f} m" in sentence


@pytest.mark.parametrize(
    ("definition", "plan_based"), [("drop-per-length", False), ("drop-per-plan", True)]
)  # fmt: skip
def test_a_mean_gradient_that_does_not_follow_is_doubted(definition, plan_based):
    centreline, segments = made(1)
    length = centreline.length * 1.005
    follows = 60 / (centreline.length if plan_based else length)

    def sentence(mean):
        targets = Targets(length, 60.0, mean_gradient=mean, mean_gradient_is=definition)
        return feasibility(centreline, segments, targets).sentence

    assert "does not follow" not in sentence(follows * 1.015)
    doubted = sentence(follows * 1.03)
    assert f"mean gradient of {103 * follows:.2f} % does not follow" in doubted
    assert f"{100 * follows:.2f} %; one of the three is wrong" in doubted


def test_known_elevations_narrow_the_interval():
    centreline, segments = made(1)
    middle = (KnownElevation(centreline.length / 2, 20.0),)
    free = feasibility(centreline, segments, Targets(centreline.length * 1.005, 60.0)).reachable_length
    held = feasibility(centreline, segments, Targets(centreline.length * 1.005, 60.0, known=middle)).reachable_length
    # Two straights of different gradients: sqrt(D^2/4 + 40^2) + sqrt(D^2/4 + 20^2).
    half = centreline.length / 2
    assert held[0] == pytest.approx(np.hypot(half, 40) + np.hypot(half, 20), abs=5e-3)
    assert held[0] > free[0]


def test_an_end_of_which_nothing_is_known_is_named_with_how_far_it_may_climb():
    centreline, segments = made(1)
    length = centreline.length

    def found(*known, **limits):
        targets = Targets(length * 1.005, 60.0, known=tuple(KnownElevation(*item) for item in known), **limits)
        return feasibility(centreline, segments, targets)

    free = found((length - 100.0, 0.0), min_gradient=-0.12)
    assert free.feasible
    assert "may climb to 12.0 m there" in free.open_end
    assert free.open_end in free.sentence
    assert not found((length - 100.0, 0.0), (length, 7.0)).open_end
    assert not found((length - 100.0, 0.0), min_gradient=0.0).open_end
    assert not found((length - 100.0, 6.0)).open_end


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(
    "tail",
    [
        (),
        ((0.46, 0.5, 2.0), (0.55, 0.0, 0.0), (1.0, 3.0, 0.0)),
        ((0.7, 0.02, 0.0), (0.71, 0.5, 0.0), (0.78, 1.5, 0.0), (0.9, 0.0, 0.05)),
    ],
    ids=["nothing known", "a dip and a climb", "a flat tail with small elevations"],
)
def test_what_it_says_of_a_length_is_what_a_run_does(seed, tail):
    centreline, segments = made(seed, curves=6)
    plan = centreline.length
    known = tuple(KnownElevation(share * plan, elevation, tolerance) for share, elevation, tolerance in tail)
    first = feasibility(centreline, segments, Targets(1.005 * plan, 0.08 * plan, known=known))
    low, high = first.reachable_length
    for share in (-0.1, 0.02, 0.3, 0.6, 0.9, 0.98, 1.03, 1.1, 1.4):
        targets = Targets(low + share * (high - low), 0.08 * plan, known=known)
        solution = finish(pgd(centreline, segments, targets))
        found = feasibility(centreline, segments, targets)
        assert found.feasible == (solution.status == 0), (share, solution.message)
        if tail == () and 0 <= share <= 1:
            assert found.feasible


def test_a_length_that_may_exist_but_that_a_run_misses_is_not_called_impossible():
    centreline, segments = made(1, curves=6)
    plan = centreline.length
    tail = ((0.7054, 0.02, 0.0), (0.7129, 0.5, 0.0), (0.7235, 0.0, 0.5), (0.7731, 1.5, 0.0), (0.8915, 0.0, 0.05))
    known = tuple(KnownElevation(share * plan, elevation, tolerance) for share, elevation, tolerance in tail)
    targets = Targets(1.00706 * plan, 0.07048 * plan, known=known)
    iterates = []
    assert finish(pgd(centreline, segments, targets), iterates.append).status != 0
    found = feasibility(centreline, segments, targets)
    low, high = found.reachable_length
    assert low < targets.length < high
    assert not found.feasible
    assert f"Lines of this plan can be {low:.2f} m to {high:.2f} m long" in found.sentence
    assert f"none of {targets.length:.2f} m was found" in found.sentence
    assert f"a run ends at {iterates[-1].length:.2f} m" in found.sentence

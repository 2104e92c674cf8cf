"""What must hold of the recommended method on any plan."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bobdesk.errors import TargetError
from bobdesk.progress import finish
from bobdesk.solve.feasibility import feasibility
from bobdesk.solve.pgd import pgd
from bobdesk.solve.run import solve
from bobdesk.solve.settings import PgdSettings, SolverSettings
from bobdesk.solve.targets import KnownElevation, Targets
from tests.alignment.made_lines import drive, made_plan
from tests.solve.made_plans import height_at, length_of, made, plan_of, run_pgd

FEW = settings(deadline=None, max_examples=10, derandomize=True)


def targets_for(centreline, *, mean=0.09, more=1.0006, **others):
    drop = mean * centreline.length
    return Targets(float(np.hypot(centreline.length, drop)) * more, drop, **others)


@cache
def usual(seed):
    centreline, segments = made(seed, curves=5)
    targets = targets_for(centreline)
    return targets, run_pgd(centreline, segments, targets)


def assert_meets(run, targets):
    line = run.line
    assert run.solution.status == 0
    assert line.elevations.min() == pytest.approx(0, abs=1e-6)
    assert line.elevations[0] == pytest.approx(targets.drop, abs=1e-6)
    assert length_of(line) == pytest.approx(targets.length, rel=1e-5)
    assert line.gradients.min() >= targets.min_gradient - 2e-6
    assert line.gradients.max() <= targets.max_gradient + 2e-6
    for item in targets.known:
        assert height_at(line, item.station) == pytest.approx(item.elevation, abs=1e-6)


@FEW
@given(
    seed=st.integers(0, 4),
    angle=st.floats(-np.pi, np.pi),
    shift=st.tuples(st.floats(-1e4, 1e4), st.floats(-1e4, 1e4)),
    mirrored=st.booleans(),
)
def test_a_plan_turned_shifted_or_mirrored_has_the_same_gradients(seed, angle, shift, mirrored):
    targets, before = usual(seed)
    assert_meets(before, targets)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    points = made_plan(seed, curves=5) * [1, -1 if mirrored else 1] @ turn.T + np.array(shift)
    after = run_pgd(*plan_of(points), targets)
    assert len(after.line.gradients) == len(before.line.gradients)
    np.testing.assert_allclose(after.line.gradients, before.line.gradients, rtol=0, atol=5e-6)
    np.testing.assert_allclose(after.line.elevations, before.line.elevations, rtol=0, atol=5e-5)
    sign = -1 if mirrored else 1
    np.testing.assert_allclose(after.line.plan_curvature, sign * before.line.plan_curvature, rtol=0, atol=1e-6)


@pytest.mark.parametrize("seed", range(4))
def test_a_track_that_climbs_at_its_end(seed):
    centreline, segments = made(seed, curves=5)
    length = centreline.length
    climb = (KnownElevation(0.8 * length, 0.0), KnownElevation(length, 5.0))
    targets = targets_for(centreline, mean=0.07, known=climb)
    reachable = feasibility(centreline, segments, targets).reachable_length
    targets = Targets(0.5 * sum(reachable), targets.drop, known=climb)
    run = run_pgd(centreline, segments, targets)
    assert_meets(run, targets)
    assert run.line.elevations[-1] == pytest.approx(5.0, abs=1e-6)
    row = int(np.searchsorted(run.line.stations, 0.8 * length - 1e-3))
    assert run.line.gradients[row - 1] >= -2e-6
    assert run.line.gradients[row + 1] <= 2e-6


def test_an_end_above_the_lowest_point_needs_the_lowest_point():
    centreline, segments = made(1, curves=5)
    targets = targets_for(centreline, known=(KnownElevation(centreline.length, 5.0),))
    with pytest.raises(TargetError, match="say where the lowest point is"):
        finish(pgd(centreline, segments, targets))


def kreisel():
    bend = 1 / 22
    return drive([(80.0, 0, 0), (10.0, 0, bend), (140.0, bend, bend), (10.0, bend, 0), (90.0, 0, 0)])


@pytest.mark.parametrize("sign", [1, -1], ids=["anticlockwise", "clockwise"])
def test_a_kreisel_that_crosses_itself(sign):
    centreline, segments = plan_of(kreisel() * [1, sign])
    assert [s.kind for s in segments] == ["straight", "curve", "straight"]
    targets = targets_for(centreline, more=1.0003)
    run = run_pgd(centreline, segments, targets)
    assert_meets(run, targets)
    assert run.line.headings[-1] - run.line.headings[0] == pytest.approx(sign * 150 / 22, abs=1e-3)
    other = run_pgd(*plan_of(kreisel() * [1, -sign]), targets)
    np.testing.assert_allclose(other.line.gradients, run.line.gradients, atol=1e-6)


@FEW
@given(
    seed=st.integers(0, 4),
    mean=st.floats(0.03, 0.13),
    share=st.floats(0, 1),
    shape=st.floats(-0.05, 0.05),
    count=st.integers(0, 4),
)
def test_any_length_inside_the_reachable_interval_is_met(seed, mean, share, shape, count):
    centreline, segments = made(seed, curves=4 + seed)
    drop = mean * centreline.length
    at = np.linspace(0, 1, count + 2)[1:-1]
    heights = drop * (1 - at + 4 * shape * at * (1 - at))
    known = tuple(KnownElevation(float(s * centreline.length), float(z)) for s, z in zip(at, heights, strict=True))
    found = feasibility(centreline, segments, Targets(1.003 * centreline.length, drop, known=known))
    low, high = found.reachable_length
    assert low >= np.hypot(centreline.length, drop) * (1 - 1e-9)
    targets = Targets(low + share * (high - low), drop, known=known)
    assert feasibility(centreline, segments, targets).feasible
    assert_meets(run_pgd(centreline, segments, targets), targets)


@pytest.mark.parametrize("seed", range(3))
def test_limits_that_bind_are_kept(seed):
    centreline, segments = made(seed, curves=5)
    limits = {"min_gradient": 0.07, "max_gradient": 0.105}
    reachable = feasibility(centreline, segments, targets_for(centreline, **limits)).reachable_length
    targets = Targets(reachable[0] + 0.9 * (reachable[1] - reachable[0]), 0.09 * centreline.length, **limits)
    run = run_pgd(centreline, segments, targets)
    assert_meets(run, targets)
    assert np.isclose(run.solution.gradients, 0.07, atol=1e-3).any()


def test_a_mean_over_the_segments_is_met():
    centreline, segments = made(2)
    targets = targets_for(centreline, mean_gradient=0.095, mean_gradient_is="segments")
    run = run_pgd(centreline, segments, targets)
    assert run.line.elevations[0] == pytest.approx(targets.drop, abs=1e-6)
    # Of the elevations as they are written, at the segments' boundaries.
    ends = np.array([0.0, *(segment.end for segment in segments)])
    means = -np.diff(height_at(run.line, ends)) / np.diff(ends)
    assert np.mean(means) == pytest.approx(0.095, abs=1e-7)


def test_a_length_too_long_is_met_as_far_as_plausible():
    centreline, segments = made(2)
    targets = targets_for(centreline, more=1.03)
    run = run_pgd(centreline, segments, targets)
    assert run.solution.status == 2
    assert "swing by more than 6 %" in run.solution.message
    high = feasibility(centreline, segments, targets).reachable_length[1]
    assert length_of(run.line) == pytest.approx(high, rel=1e-4)
    assert run.line.elevations[0] == pytest.approx(targets.drop, abs=1e-6)


def test_a_length_too_short_gives_the_shortest_line():
    centreline, segments = made(2)
    targets = targets_for(centreline, more=0.99)
    run = run_pgd(centreline, segments, targets)
    assert run.solution.status == 2
    assert "m too long" in run.solution.message
    assert length_of(run.line) == pytest.approx(np.hypot(centreline.length, targets.drop), rel=1e-7)
    np.testing.assert_allclose(run.line.gradients, 0.09, atol=1e-4)


def test_two_runs_are_the_same_to_the_bit():
    centreline, segments = made(3)
    targets = targets_for(centreline)
    first, second = (run_pgd(centreline, segments, targets) for _ in range(2))
    np.testing.assert_array_equal(first.line.points, second.line.points)
    assert first.solution.nit == second.solution.nit == len(first.iterates) - 1


@pytest.mark.parametrize("spacing", [0.5, 2.0, 5.0])
def test_the_spacing_hardly_matters(spacing):
    points = made_plan(1, curves=5)
    targets, usual_run = usual(1)
    run = run_pgd(*plan_of(points, spacing=spacing), Targets(targets.length, targets.drop), PgdSettings())
    line = usual_run.line
    share = np.linspace(0, 1, 200)
    found = np.interp(share * run.line.stations[-1], run.line.stations, run.line.elevations)
    before = np.interp(share * line.stations[-1], line.stations, line.elevations)
    assert np.abs(found - before).max() < 0.05 * targets.drop


def test_solve_starts_the_method_by_its_name():
    centreline, segments = made(0, curves=3)
    targets = targets_for(centreline)
    for method in ("pgd", "published", "lbfgsb", "slsqp"):
        solution = finish(solve(centreline, segments, targets, SolverSettings(method=method)))
        assert solution.method == method

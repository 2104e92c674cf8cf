from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from bobdesk.errors import TargetError
from bobdesk.solve.projection import FeasibleSet, Projection


def random_set(seed, *, pieces, stretches, mean=False):
    """Return a feasible set with an inner point, and a row mean that the point has."""
    rng = np.random.default_rng(seed)
    lengths = np.exp(rng.uniform(np.log(1.0), np.log(300.0), pieces))
    cuts = np.sort(rng.choice(np.arange(1, pieces), stretches - 1, replace=False)) if stretches > 1 else []
    stretch_of = np.searchsorted(cuts, np.arange(pieces), side="right")
    roots = np.sqrt(lengths)
    low, high = -0.2 * roots, 0.25 * roots
    inside = low + rng.uniform(0.05, 0.95, pieces) * (high - low)
    mean_weights = rng.uniform(0.2, 1.0, pieces) / roots / pieces if mean else None
    return FeasibleSet(
        weights=roots,
        stretch_of=stretch_of,
        falls=np.bincount(stretch_of, roots * inside),
        low=low,
        high=high,
        mean_weights=mean_weights,
        mean=float(mean_weights @ inside) if mean else 0.0,
    )


def kkt_violation(feasible, point, projected):
    """Return how far the nearest point is from meeting the conditions that it alone meets.

    point - projected must be a sum of the rows of the equations at all free components, and push
    outwards of the limits at those that lie on them.
    """
    rows = [np.where(feasible.stretch_of == m, feasible.weights, 0.0) for m in range(len(feasible.falls))]
    if feasible.mean_weights is not None:
        rows.append(feasible.mean_weights)
    matrix = np.array(rows).T
    rest = point - projected
    width = feasible.high - feasible.low
    on_low = projected <= feasible.low + 1e-9 * width
    on_high = projected >= feasible.high - 1e-9 * width
    free = ~(on_low | on_high)
    # A stretch without a free piece has a multiplier within an interval; the free ones fix the others.
    active = np.abs(matrix[free]).sum(axis=0) > 0
    multipliers = np.zeros(matrix.shape[1])
    multipliers[active] = np.linalg.lstsq(matrix[free][:, active], rest[free], rcond=None)[0]
    known = np.array([active[m] for m in feasible.stretch_of])
    left = rest - matrix @ multipliers
    off = np.abs(left[free]).max(initial=0.0)
    off = max(off, np.maximum(left[on_low & known], 0).max(initial=0.0))
    return max(off, np.maximum(-left[on_high & known], 0).max(initial=0.0)) / (1 + np.abs(rest).max())


sets = st.builds(
    lambda seed, pieces, share, mean: random_set(
        seed, pieces=pieces, stretches=1 + int(share * (pieces - 1) / 2), mean=mean
    ),
    st.integers(0, 10_000),
    st.integers(2, 40),
    st.floats(0, 1),
    st.booleans(),
)
FEW = settings(deadline=None, max_examples=80, derandomize=True)


@FEW
@given(sets, st.integers(0, 1000), st.sampled_from([0.01, 1.0, 10.0, 1e3, 1e6]))
def test_the_projection_lies_in_the_set_and_is_nearest(feasible, seed, size):
    point = size * np.random.default_rng(seed).standard_normal(len(feasible.low))
    projected = Projection(feasible)(point)
    assert (projected >= feasible.low).all()
    assert (projected <= feasible.high).all()
    if feasible.mean_weights is not None:
        assert feasible.mean_weights @ projected == pytest.approx(feasible.mean, abs=1e-9)
    sums = np.bincount(feasible.stretch_of, feasible.weights * projected)
    np.testing.assert_allclose(sums, feasible.falls, rtol=1e-12, atol=1e-12)
    assert kkt_violation(feasible, point, projected) < 1e-7


@pytest.mark.parametrize("size", [1e7, 1e9, 1e12])
def test_the_equations_hold_from_however_far_away(size):
    for seed in range(20):
        feasible = random_set(seed, pieces=20, stretches=4)
        projected = Projection(feasible)(size * np.random.default_rng(seed).standard_normal(20))
        sums = np.bincount(feasible.stretch_of, feasible.weights * projected)
        np.testing.assert_allclose(sums, feasible.falls, rtol=1e-12, atol=1e-12)
        assert (projected >= feasible.low).all()
        assert (projected <= feasible.high).all()


@FEW
@given(sets, st.integers(0, 1000), st.floats(0.01, 100))
def test_it_never_moves_two_points_apart_and_leaves_the_set_alone(feasible, seed, size):
    rng = np.random.default_rng(seed)
    project = Projection(feasible)
    one, two = size * rng.standard_normal((2, len(feasible.low)))
    first, second = project(one), project(two)
    assert np.linalg.norm(first - second) <= np.linalg.norm(one - two) * (1 + 1e-9)
    np.testing.assert_allclose(project(first), first, rtol=0, atol=1e-8)


@FEW
@given(sets, st.integers(0, 1000), st.sampled_from([1e-3, 0.1, 1.0, 30.0]), st.booleans())
def test_what_was_projected_before_does_not_matter(feasible, seed, step, cornered):
    rng = np.random.default_rng(seed)
    if cornered and len(feasible.falls) > 1:  # a stretch that the limits alone decide
        corner = feasible.stretch_of == 0
        falls = np.r_[feasible.reach()[0][0], feasible.falls[1:]]
        inside = Projection(replace(feasible, falls=falls, mean_weights=None))(np.zeros(len(feasible.low)))
        np.testing.assert_allclose(inside[corner], feasible.low[corner], rtol=1e-9)
        mean = float(feasible.mean_weights @ inside) if feasible.mean_weights is not None else 0.0
        feasible = replace(feasible, falls=falls, mean=mean)
    project = Projection(feasible)
    point = rng.standard_normal(len(feasible.low))
    for _ in range(12):
        point = point + step * rng.standard_normal(len(point))
        projected = project(point)
        sums = np.bincount(feasible.stretch_of, feasible.weights * projected)
        np.testing.assert_allclose(sums, feasible.falls, rtol=1e-12, atol=1e-12)
        assert kkt_violation(feasible, point, projected) < 1e-7
        np.testing.assert_allclose(projected, Projection(feasible)(point), rtol=0, atol=1e-8)


@pytest.mark.parametrize("mean", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_scipy_finds_the_same_point(seed, mean):
    feasible = random_set(seed, pieces=12, stretches=3, mean=mean)
    point = 3 * np.random.default_rng(seed + 50).standard_normal(12)
    rows = [np.where(feasible.stretch_of == m, feasible.weights, 0.0) for m in range(3)]
    wanted = list(feasible.falls)
    if feasible.mean_weights is not None:
        rows.append(feasible.mean_weights)
        wanted.append(feasible.mean)
    matrix, values = np.array(rows), np.array(wanted)
    found = minimize(
        lambda v: 0.5 * ((v - point) ** 2).sum(),
        np.clip(point, feasible.low, feasible.high),
        jac=lambda v: v - point,
        method="SLSQP",
        bounds=list(zip(feasible.low, feasible.high, strict=True)),
        constraints={"type": "eq", "fun": lambda v: matrix @ v - values, "jac": lambda v: matrix},
        options={"ftol": 1e-13, "maxiter": 500},
    )
    # SLSQP ends where it finds no further decrease; that its end keeps the equations is what counts.
    np.testing.assert_allclose(matrix @ found.x, values, atol=1e-9)
    projected = Projection(feasible)(point)
    np.testing.assert_allclose(projected, found.x, atol=5e-6)
    assert 0.5 * ((projected - point) ** 2).sum() <= found.fun * (1 + 1e-12)


def test_a_case_worked_by_hand():
    # Nearest to (2, 0) with v1 + v2 = 1 is (1.5, -0.5); the limit at 1.2 makes it (1.2, -0.2).
    feasible = FeasibleSet(np.ones(2), np.zeros(2, int), np.ones(1), np.full(2, -1.0), np.array([1.2, 9.0]))
    np.testing.assert_allclose(Projection(feasible)(np.array([2.0, 0.0])), [1.2, -0.2], atol=1e-14)
    wide = FeasibleSet(np.ones(2), np.zeros(2, int), np.ones(1), np.full(2, -9.0), np.full(2, 9.0))
    np.testing.assert_allclose(Projection(wide)(np.array([2.0, 0.0])), [1.5, -0.5], atol=1e-14)


def test_the_limits_alone_may_meet_a_stretch():
    feasible = random_set(3, pieces=6, stretches=2)
    lowest, highest = feasible.reach()
    corner = FeasibleSet(
        feasible.weights, feasible.stretch_of, np.array([lowest[0], highest[1]]), feasible.low, feasible.high
    )
    projected = Projection(corner)(np.zeros(6))
    first = feasible.stretch_of == 0
    np.testing.assert_allclose(projected[first], feasible.low[first], rtol=1e-12)
    np.testing.assert_allclose(projected[~first], feasible.high[~first], rtol=1e-12)


def test_an_empty_set_is_refused():
    feasible = random_set(3, pieces=6, stretches=2)
    _, highest = feasible.reach()
    with pytest.raises(TargetError, match="contradict"):
        Projection(FeasibleSet(feasible.weights, feasible.stretch_of, highest * 1.001, feasible.low, feasible.high))


def test_a_mean_out_of_reach_is_refused():
    feasible = random_set(3, pieces=6, stretches=2, mean=True)
    most = float(np.abs(feasible.mean_weights) @ np.maximum(feasible.high, -feasible.low))
    unreachable = FeasibleSet(
        feasible.weights, feasible.stretch_of, feasible.falls, feasible.low, feasible.high,
        feasible.mean_weights, 2 * most,
    )  # fmt: skip
    with pytest.raises(TargetError, match="mean of the segments' gradients cannot be met"):
        Projection(unreachable)(np.zeros(6))

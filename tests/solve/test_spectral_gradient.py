import numpy as np
import pytest
from scipy.optimize import minimize

from bobdesk.progress import finish
from bobdesk.solve.projection import FeasibleSet, Projection
from bobdesk.solve.spectral_gradient import DescentSettings, descend
from tests.solve.test_projection import random_set


def quadratic(matrix, target):
    def objective(v):
        off = matrix @ (v - target)
        return float(0.5 * (v - target) @ off), off

    return objective


def spread_out(seed, size, condition):
    rng = np.random.default_rng(seed)
    basis, _ = np.linalg.qr(rng.standard_normal((size, size)))
    return basis @ np.diag(np.geomspace(1, condition, size)) @ basis.T


@pytest.mark.parametrize("condition", [1, 30, 1000])
def test_a_quadratic_on_a_plane_ends_at_the_known_answer(condition):
    size = 15
    matrix = spread_out(1, size, condition)
    target = np.random.default_rng(2).standard_normal(size)
    weights = np.linspace(1, 2, size)
    feasible = FeasibleSet(weights, np.zeros(size, int), np.ones(1), np.full(size, -1e3), np.full(size, 1e3))
    # Lagrange: v = target + multiplier * matrix^-1 weights, with weights @ v = 1.
    inverse = np.linalg.solve(matrix, weights)
    exact = target + (1 - weights @ target) / (weights @ inverse) * inverse
    last = finish(descend(quadratic(matrix, target), np.zeros(size), Projection(feasible), DescentSettings(1e-7, 5000)))
    np.testing.assert_allclose(last.v, exact, atol=1e-6)
    assert last.optimality <= 1e-7


@pytest.mark.parametrize("seed", range(5))
def test_scipy_finds_the_same_minimum_within_limits(seed):
    feasible = random_set(seed, pieces=14, stretches=3)
    matrix = spread_out(seed, 14, 1e3)
    target = 4 * np.random.default_rng(seed + 9).standard_normal(14)
    objective = quadratic(matrix, target)
    rows = np.array([np.where(feasible.stretch_of == m, feasible.weights, 0.0) for m in range(3)])
    other = minimize(
        objective, np.zeros(14), jac=True, method="SLSQP",
        bounds=list(zip(feasible.low, feasible.high, strict=True)),
        constraints={"type": "eq", "fun": lambda v: rows @ v - feasible.falls, "jac": lambda v: rows},
        options={"ftol": 1e-15, "maxiter": 1000},
    )  # fmt: skip
    last = finish(descend(objective, np.zeros(14), Projection(feasible), DescentSettings(1e-9, 20_000)))
    agreement = 1e-7 * other.fun
    assert last.objective == pytest.approx(other.fun, abs=agreement)
    np.testing.assert_allclose(rows @ last.v, feasible.falls, atol=1e-9)
    # Where objectives agree so far, strong convexity says how far apart the places can lie; SLSQP, which meets
    # the falls to 1e-5 only, lies differently far with each number of its linear algebra's threads.
    least = np.linalg.eigvalsh(matrix).min()
    assert np.linalg.norm(last.v - other.x) < 2 * np.sqrt(2 * agreement / least)


def test_every_point_on_the_way_lies_in_the_set_and_evaluations_are_counted():
    feasible = random_set(7, pieces=20, stretches=4)
    calls = []
    plain = quadratic(spread_out(7, 20, 1e3), np.full(20, 5.0))

    def counted(v):
        calls.append(v)
        return plain(v)

    points = []
    last = finish(
        descend(counted, np.full(20, 99.0), Projection(feasible), DescentSettings(1e-9, 20_000)), points.append
    )
    assert last.evaluations == len(calls)
    for at in points:
        assert (at.v >= feasible.low - 1e-12).all()
        assert (at.v <= feasible.high + 1e-12).all()
        np.testing.assert_allclose(np.bincount(feasible.stretch_of, feasible.weights * at.v), feasible.falls, atol=1e-9)
    values = [at.objective for at in points]
    for number, value in enumerate(values[1:], 1):
        assert value <= max(values[max(0, number - 8) : number]) + 1e-12
    assert min(values) == pytest.approx(values[-1], rel=1e-9)


def test_it_stops_after_the_most_iterations():
    feasible = random_set(7, pieces=20, stretches=4)
    points = []
    objective = quadratic(spread_out(7, 20, 1e6), np.full(20, 5.0))
    finish(descend(objective, np.zeros(20), Projection(feasible), DescentSettings(0.0, 5)), points.append)
    assert len(points) == 5

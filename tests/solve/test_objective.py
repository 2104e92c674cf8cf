from itertools import pairwise

import numpy as np
import pytest

from bobdesk.alignment.segments import Segment
from bobdesk.solve.objective import PublishedObjective
from bobdesk.solve.profile import Profile, make_profile
from bobdesk.solve.settings import Weights
from bobdesk.solve.targets import Targets
from tests.solve.made_plans import made, straight_plan

EACH = [Weights(1, 0, 0, 0), Weights(0, 1, 0, 0), Weights(0, 0, 1e4, 0), Weights(0, 0, 0, 1e4), Weights(1, 2, 3e3, 4e3)]


@pytest.mark.parametrize("scale", [1.0, 1.11])
@pytest.mark.parametrize("weights", EACH, ids=["length", "height", "curvature", "gradient", "all"])
@pytest.mark.parametrize("seed", range(2))
def test_the_derivative_is_that_of_central_differences(seed, weights, scale):
    centreline, segments = made(seed, curves=5)
    profile = make_profile(centreline, segments)
    targets = Targets(centreline.length * 1.01, 60.0, mean_gradient=0.1)
    objective = PublishedObjective(profile, targets, weights)
    gradients = np.random.default_rng(seed).uniform(0.02, 0.2, len(segments))
    _, derivative = objective.value_and_derivative(gradients, scale)
    found = np.zeros_like(derivative)
    for piece in range(len(gradients)):
        step = np.zeros(len(gradients))
        step[piece] = 3e-6
        found[piece] = (objective.value(gradients + step, scale) - objective.value(gradients - step, scale)) / 6e-6
    assert np.abs(derivative - found).max() <= 1e-6 * np.abs(derivative).max()


def by_loops(profile, gradients, targets, weights, scale=1.0):
    """Work out J row by row, straight from the paper's sums."""
    falls = scale * (profile.falls.by_piece @ gradients)
    rows = np.column_stack([scale * profile.points, -np.concatenate([[0.0], np.cumsum(falls)])])
    length = sum(np.linalg.norm(b - a) for a, b in pairwise(rows))
    height = sum(abs(b[2] - a[2]) for a, b in pairwise(rows))
    u = np.gradient(rows, axis=0)
    v = np.gradient(u, axis=0)
    in_space = [np.linalg.norm(np.cross(a, b)) / np.linalg.norm(a) ** 3 for a, b in zip(u, v, strict=True)]
    in_plan = [abs(a[0] * b[1] - a[1] * b[0]) / np.hypot(a[0], a[1]) ** 3 for a, b in zip(u, v, strict=True)]
    curvature = np.mean(in_plan) - np.mean(in_space)
    errors = (targets.length - length, targets.drop - height, curvature, gradients.mean() - targets.mean_gradient)
    factors = (weights.length, weights.height, weights.curvature, weights.gradient)
    return sum(w * e**2 for w, e in zip(factors, errors, strict=True)), errors


@pytest.mark.parametrize("scale", [1.0, 0.8])
def test_it_is_what_the_papers_sums_say(scale):
    centreline, segments = made(3, curves=4)
    profile = make_profile(centreline, segments)
    targets = Targets(centreline.length + 2, 30.0, mean_gradient=0.09)
    gradients = np.random.default_rng(4).uniform(-0.05, 0.2, len(segments))
    weights = Weights(1.0, 2.0, 1e5, 1e3)
    objective = PublishedObjective(profile, targets, weights)
    value, errors = by_loops(profile, gradients, targets, weights, scale)
    terms = objective.terms(gradients, scale)
    assert terms.length == pytest.approx(errors[0], abs=1e-9)
    assert terms.height == pytest.approx(errors[1], abs=1e-9)
    # The root is smoothed by 1e-6 1/m, which is felt where a straight has no curvature at all.
    assert terms.curvature == pytest.approx(errors[2], abs=1e-6)
    assert terms.gradient == pytest.approx(errors[3], abs=1e-12)
    assert objective.value(gradients, scale) == pytest.approx(value, rel=1e-4)


def test_a_straight_of_even_gradient_worked_by_hand():
    # 120 m of plan at 0.05: length 120 sqrt(1.0025), drop 6, no curvature anywhere.
    segments = (Segment("straight", 0, 60), Segment("straight", 60, 120))
    profile = make_profile(straight_plan(120.0), segments)
    targets = Targets(121.0, 7.0, mean_gradient=0.08)
    objective = PublishedObjective(profile, targets, Weights(2.0, 3.0, 1e6, 100.0))
    length = 120 * np.sqrt(1.0025)
    expected = 2 * (121 - length) ** 2 + 3 * 1.0**2 + 100 * 0.03**2
    assert objective.value(np.array([0.05, 0.05])) == pytest.approx(expected, abs=1e-9)


def test_the_mean_gradient_is_drop_per_plan_where_none_is_given():
    profile = make_profile(straight_plan(120.0), (Segment("straight", 0, 120),))
    objective = PublishedObjective(profile, Targets(121.0, 6.0), Weights())
    assert objective.terms(np.array([0.08])).gradient == pytest.approx(0.03, abs=1e-12)


def test_curvature_of_a_helix_is_known():
    # A helix of radius R whose fall per metre of plan is g: K3 = 1 / (R (1 + g^2)).
    radius, g = 40.0, 0.15
    angles = np.arange(600) * (0.5 / radius)
    points = radius * np.column_stack([np.cos(angles), np.sin(angles)])
    stations = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    one = np.zeros(0)
    profile = Profile(stations, points, np.array([0.0, stations[-1]]), np.zeros(1, int), one, one.astype(bool), one)
    objective = PublishedObjective(profile, Targets(stations[-1], 10.0, mean_gradient=g), Weights())
    expected = 1 / radius - 1 / (radius * (1 + g**2))
    assert objective.terms(np.array([g])).curvature == pytest.approx(expected, rel=0.01)


def test_evaluations_are_counted():
    profile = make_profile(straight_plan(120.0), (Segment("straight", 0, 120),))
    objective = PublishedObjective(profile, Targets(121.0, 6.0), Weights())
    objective.value(np.array([0.08]))
    objective.value_and_derivative(np.array([0.08]))
    assert (objective.nfev, objective.njev) == (2, 1)

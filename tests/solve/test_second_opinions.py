from functools import cache

import numpy as np
import pytest

from bobdesk.errors import InputError
from bobdesk.progress import finish
from bobdesk.solve.objective import PublishedObjective
from bobdesk.solve.published import published
from bobdesk.solve.second_opinions import second_opinion
from bobdesk.solve.settings import PublishedSettings, SecondOpinionSettings, Weights
from bobdesk.solve.targets import KnownElevation, Targets
from bobdesk.track.centreline3d import make_centreline3d
from tests.solve.made_plans import height_at, made

WEIGHTS = Weights(1, 1, 1e4, 1e4)


@cache
def track():
    centreline, segments = made(3)
    drop = 0.09 * centreline.length
    return centreline, segments, Targets(float(np.hypot(centreline.length, drop)) + 0.4, drop)


@cache
def objective_of(method, **others):
    settings = SecondOpinionSettings(**{"weights": WEIGHTS, "max_iterations": 300} | others)
    iterates = []
    return finish(second_opinion(*track(), method, settings), iterates.append), iterates


@cache
def published_objective():
    return finish(published(*track(), PublishedSettings(weights=WEIGHTS))).objective


@pytest.mark.parametrize("method", ["lbfgsb", "slsqp", "trustconstr", "de"])
def test_each_reaches_no_higher_an_objective_than_published(method):
    solution, _ = objective_of(method, **({"max_iterations": 80} if method == "de" else {}))
    assert solution.objective <= published_objective()
    assert solution.method == method
    assert (solution.gradients >= -0.2).all()
    assert (solution.gradients <= 0.25).all()


@pytest.mark.parametrize("method", ["lbfgsb", "slsqp", "trustconstr"])
def test_exact_derivatives_come_near_the_bottom(method):
    solution, _ = objective_of(method)
    assert solution.objective < 1e-5
    assert solution.njev > 0


def test_the_objective_named_is_that_of_the_gradients():
    solution, iterates = objective_of("lbfgsb")
    objective = PublishedObjective(solution.profile, track()[2], WEIGHTS)
    assert objective.value(solution.gradients) == pytest.approx(solution.objective, abs=1e-15)
    assert [iterate.number for iterate in iterates] == list(range(len(iterates)))
    assert iterates[-1].objective == pytest.approx(solution.objective, abs=1e-15)


def test_numeric_derivatives_lead_the_same_way():
    exact, _ = objective_of("slsqp", max_iterations=1)
    numeric, _ = objective_of("slsqp", max_iterations=1, numeric_derivatives=True)
    assert numeric.njev == 0
    assert numeric.nfev > exact.nfev
    np.testing.assert_allclose(numeric.gradients, exact.gradients, atol=1e-4)


@pytest.mark.parametrize("method", ["slsqp", "trustconstr"])
def test_drop_and_known_elevations_are_held(method):
    centreline, segments, targets = track()
    known = (KnownElevation(200.0, 0.65 * targets.drop), KnownElevation(400.0, 0.3 * targets.drop))
    held = Targets(targets.length + 0.5, targets.drop, known=known)
    solution = finish(second_opinion(centreline, segments, held, method, SecondOpinionSettings(weights=WEIGHTS)))
    line = make_centreline3d(centreline, segments, solution)
    for item in known:
        assert height_at(line, item.station) == pytest.approx(item.elevation, abs=2e-6)
    assert line.elevations[-1] == pytest.approx(0, abs=2e-6)


@pytest.mark.parametrize("method", ["slsqp", "trustconstr"])
def test_an_elevation_is_held_within_its_tolerance_where_its_middle_is_out_of_reach(method):
    centreline, segments, targets = track()
    steep = 0.25 * 100.0
    known = (KnownElevation(100.0, targets.drop - steep - 2.0, 3.0),)
    held = Targets(targets.length + 3.0, targets.drop, known=known)
    solution = finish(second_opinion(centreline, segments, held, method, SecondOpinionSettings(weights=WEIGHTS)))
    line = make_centreline3d(centreline, segments, solution)
    assert abs(height_at(line, 100.0) - known[0].elevation) <= 3.0
    assert line.elevations[-1] == pytest.approx(0, abs=1e-5)


def test_differential_evolution_is_seeded():
    centreline, segments, targets = track()
    settings = SecondOpinionSettings(weights=WEIGHTS, max_iterations=3)
    runs = [finish(second_opinion(centreline, segments, targets, "de", settings)) for _ in range(2)]
    np.testing.assert_array_equal(runs[0].gradients, runs[1].gradients)
    assert runs[0].status == 1


@pytest.mark.parametrize("method", ["lbfgsb", "slsqp", "trustconstr", "de"])
def test_an_unknown_scale_is_refused(method):
    centreline, segments, targets = track()
    unknown = Targets(targets.length, targets.drop, unknown_scale=True)
    with pytest.raises(InputError, match=f"{method} cannot find an unknown scale"):
        finish(second_opinion(centreline, segments, unknown, method))

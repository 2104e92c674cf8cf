"""The band with a bounded change of gradient, beside linear programs and random profiles."""

import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import sparse
from scipy.optimize import linprog

from bobdesk.errors import TargetError
from bobdesk.progress import finish
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.envelope import between_stations, envelope, grid_of, smooth_envelope
from bobdesk.solve.targets import KnownElevation, Targets
from tests.solve.made_plans import real_line

FEW = settings(deadline=None, max_examples=40, derandomize=True)
CHANGE = 0.002


def band(targets, *, length=1500.0, change=CHANGE, **others):
    return finish(smooth_envelope(anchors_of(targets, length), targets, largest_change=change, **others))


def program(at, targets, known, change):
    """Return limits and changes of the gradient, and elevations of single stations, as a linear program's."""
    cells = np.diff(at)
    count = len(cells)
    gradients = sparse.diags([1 / cells, -1 / cells], [0, 1], shape=(count, count + 1)).tocsr()
    changes = gradients[1:] - gradients[:-1]
    most = change * 0.5 * (cells[1:] + cells[:-1])
    matrix = sparse.vstack([gradients, -gradients, changes, -changes])
    limits = np.concatenate([np.full(count, targets.max_gradient), np.full(count, -targets.min_gradient), most, most])
    bounds = np.stack([np.zeros(len(at)), np.full(len(at), np.inf)], axis=1)
    for station, low, high in known:
        bounds[np.abs(at - station).argmin()] = low, high
    return matrix, limits, bounds


@pytest.mark.parametrize(
    "known",
    [
        (),
        (KnownElevation(400.0, 100.0, 1.0), KnownElevation(903.0, 40.0)),
        (KnownElevation(700.0, 0.0), KnownElevation(1500.0, 30.0, 2.0)),
        (KnownElevation(1350.0, 0.0),),
        (KnownElevation(1303.0, 0.0, 0.5), KnownElevation(1401.0, 4.0, 1.0)),
    ],
)
def test_each_face_is_what_a_linear_program_finds(known):
    targets = Targets(1510.0, 120.0, known=known)
    found = band(targets)
    # Nothing is known of an end behind a lowest point, unless it is said.
    end = (1500.0, 0.0, np.inf if any(item.elevation == 0 for item in known) else 0.0)
    ends = [(0.0, 120.0, 120.0), end]
    held = [
        (item.station, max(0.0, item.elevation - item.tolerance), item.elevation + item.tolerance) for item in known
    ]
    matrix, limits, bounds = program(found.stations, targets, ends + held, CHANGE)
    for index in [*range(5, len(found.stations) - 1, 24), len(found.stations) - 1]:
        for sign, face in ((1, found.lowest), (-1, found.highest)):
            costs = np.zeros(len(found.stations))
            costs[index] = sign
            best = linprog(costs, matrix, limits, bounds=bounds)
            assert best.status == 0
            assert sign * best.fun == pytest.approx(face[index], abs=1e-6)


def smooth_profile(seed, change=CHANGE):
    """Return a random smooth profile that ends at its lowest point, every 0.5 m."""
    rng = np.random.default_rng(seed)
    fine = np.arange(0.0, 1500.1, 0.5)
    places = np.sort(rng.uniform(0, 1500, 25))
    turns = np.cumsum(change * rng.uniform(-1, 1, 26)[np.searchsorted(places, fine)] * 0.5)
    gradients = np.clip(0.02 + turns, 0.0, 0.2)
    steps = 0.5 * (gradients[1:] + gradients[:-1]) * 0.5
    return fine, np.concatenate([np.cumsum(steps[::-1])[::-1], [0.0]])


@FEW
@given(st.integers(0, 100_000), st.integers(0, 4), st.sampled_from([0.0, 1.0]))
def test_every_smooth_profile_lies_inside_at_any_station(seed, count, tolerance):
    fine, heights = smooth_profile(seed)
    rng = np.random.default_rng(seed + 1)
    known = tuple(
        KnownElevation(float(fine[row]), max(0.0, float(heights[row] + rng.uniform(-tolerance, tolerance))), tolerance)
        for row in sorted(set(rng.integers(10, len(fine) - 10, count).tolist()))
    )
    if heights[0] < 1:
        return
    targets = Targets(1510.0, float(heights[0]), known=known)
    found = band(targets)
    inside = between_stations(found, fine, largest_change=CHANGE)
    assert (heights >= inside.lowest - 1e-7).all()
    assert (heights <= inside.highest + 1e-7).all()


def test_it_narrows_the_band_of_the_limits_and_meets_it_where_any_change_is_allowed():
    targets = Targets(1510.0, 120.0, known=(KnownElevation(600.0, 60.0, 0.5),))
    anchors = anchors_of(targets, 1500.0)
    wide = envelope(grid_of(anchors), anchors, targets)
    tight = band(targets)
    assert (tight.lowest >= wide.lowest - 1e-9).all()
    assert (tight.highest <= wide.highest + 1e-9).all()
    assert tight.mean_width < 0.98 * wide.mean_width
    free = band(targets, change=10.0)
    np.testing.assert_allclose(free.highest, wide.highest, atol=1e-9)
    # The cone from the start meets the ground between two stations, where only the finest grid can bend.
    np.testing.assert_allclose(free.lowest, wide.lowest, atol=10 * 0.45)


def test_a_scale_moves_stations_to_true_size():
    true = band(Targets(1510.0, 120.0))
    small = band(Targets(1510.0, 120.0), length=750.0, scale=2.0)
    np.testing.assert_allclose(small.stations, true.stations)
    np.testing.assert_allclose(small.highest, true.highest)


def test_a_change_that_is_too_small_is_refused_with_its_place():
    known = (KnownElevation(500.0, 100.0), KnownElevation(520.0, 99.0), KnownElevation(540.0, 95.0))
    with pytest.raises(TargetError, match=r"change per metre meets the known elevations around 5\d\d"):
        band(Targets(1510.0, 120.0, known=known), change=0.001)


@pytest.mark.parametrize("name", ["mugello", "sa_calobra"])
def test_surveyed_elevations_lie_inside(name):
    line = real_line(name)
    gradients = -np.diff(line.elevations) / np.diff(line.stations)
    middles = 0.5 * (line.stations[1:] + line.stations[:-1])
    change = float(np.abs(np.diff(gradients) / np.diff(middles)).max()) * 1.01
    found = band(line.targets(known=3), length=float(line.stations[-1]), change=change)
    inside = between_stations(found, line.stations, largest_change=change)
    assert (line.elevations >= inside.lowest - 0.01).all()
    assert (line.elevations <= inside.highest + 0.01).all()


def test_it_is_quick_and_can_be_stopped():
    targets = Targets(1510.0, 120.0, known=(KnownElevation(400.0, 80.0), KnownElevation(900.0, 40.0, 1.0)))
    seconds = []
    for _ in range(3):
        started = time.process_time()
        band(targets)
        seconds.append(time.process_time() - started)
    assert min(seconds) < 0.5
    job = smooth_envelope(anchors_of(targets, 1500.0), targets, largest_change=CHANGE)
    assert [next(job).fraction for _ in range(3)] == sorted([0.0, 20 / 300, 40 / 300])
    job.close()

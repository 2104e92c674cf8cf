import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bobdesk.errors import TargetError
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.envelope import envelope
from bobdesk.solve.targets import KnownElevation, Targets
from tests.solve.made_plans import real_line

STATIONS = np.arange(0.0, 1001.0, 5.0)
FEW = settings(deadline=None, max_examples=60, derandomize=True)


def band(targets, *, length=1000.0, stations=STATIONS, scale=1.0):
    return envelope(stations, anchors_of(targets, length), targets, scale=scale)


def random_profile(seed):
    """Return a rough profile that ends at its lowest point, with limits that it keeps."""
    rng = np.random.default_rng(seed)
    gradients = rng.uniform(-0.06, 0.2, len(STATIONS) - 1)
    heights = np.concatenate([[0.0], np.cumsum(gradients[::-1] * 5.0)])[::-1]
    lowest = heights.min()
    return heights - lowest, gradients, int(heights.argmin())


@FEW
@given(st.integers(0, 100_000), st.integers(0, 4), st.sampled_from([0.0, 1.5]))
def test_every_feasible_profile_lies_inside(seed, count, tolerance):
    heights, gradients, lowest = random_profile(seed)
    rng = np.random.default_rng(seed + 1)
    rows = sorted(set(rng.integers(1, len(STATIONS) - 1, count).tolist()) | {lowest})
    known = tuple(
        KnownElevation(
            float(STATIONS[row]), float(max(0.0, heights[row] + rng.uniform(-tolerance, tolerance))), tolerance
        )
        for row in rows
        if 0 < row < len(STATIONS) - 1
    )
    end = KnownElevation(1000.0, float(heights[-1]))
    targets = Targets(
        1010.0, float(heights[0]), known=(*known, end),
        min_gradient=float(gradients.min()), max_gradient=float(gradients.max()),
    )  # fmt: skip
    if heights[0] <= 0 or (heights[-1] > 0 and not any(item.elevation <= item.tolerance for item in known)):
        return
    found = band(targets)
    assert (heights >= found.lowest - 1e-7).all()
    assert (heights <= found.highest + 1e-7).all()


def test_each_face_is_reached_by_a_profile_within_the_limits():
    targets = Targets(1010.0, 80.0, known=(KnownElevation(400.0, 50.0),), min_gradient=0.02, max_gradient=0.15)
    found = band(targets)
    for face in (found.lowest, found.highest):
        gradients = -np.diff(face) / 5.0
        assert gradients.min() >= 0.02 - 1e-9
        assert gradients.max() <= 0.15 + 1e-9
        assert np.interp([0, 400, 1000], STATIONS, face) == pytest.approx([80, 50, 0], abs=1e-9)


def test_two_cones_worked_by_hand():
    targets = Targets(1010.0, 80.0, min_gradient=0.02, max_gradient=0.15)
    found = band(targets)
    # From the start 80 - 0.15 s and 80 - 0.02 s, from the end 0.02 and 0.15 of what is left.
    left = 1000.0 - STATIONS
    np.testing.assert_allclose(found.lowest, np.maximum(80 - 0.15 * STATIONS, 0.02 * left), atol=1e-9)
    np.testing.assert_allclose(found.highest, np.minimum(80 - 0.02 * STATIONS, 0.15 * left), atol=1e-9)


def test_nothing_lies_below_the_lowest_point():
    assert band(Targets(1010.0, 80.0)).lowest.min() == 0


def test_a_tolerance_opens_the_band_by_itself():
    at = STATIONS.tolist().index(400.0)
    found = band(Targets(1010.0, 80.0, known=(KnownElevation(400.0, 50.0, 2.0),)))
    assert (found.lowest[at], found.highest[at]) == pytest.approx((48.0, 52.0))


def test_a_tolerance_that_reaches_below_the_lowest_point_opens_nothing_there():
    # A track that never climbs ends at 0 or above, and is higher by its least fall before.
    falling = band(Targets(1010.0, 80.0, min_gradient=0.02, known=(KnownElevation(1000.0, 2.0, 5.0),)))
    at = STATIONS.tolist().index(900.0)
    assert falling.lowest[at] == pytest.approx(2.0)


def test_a_scale_moves_stations_to_true_size():
    small = band(Targets(1010.0, 80.0), length=500.0, stations=STATIONS / 2, scale=2.0)
    true = band(Targets(1010.0, 80.0))
    np.testing.assert_allclose(small.stations, STATIONS)
    np.testing.assert_allclose(small.lowest, true.lowest)
    np.testing.assert_allclose(small.highest, true.highest)


def test_an_empty_band_is_refused_where_it_is_emptiest():
    with pytest.raises(TargetError, match="no profile within the limits meets the known elevations around"):
        band(Targets(1010.0, 80.0, known=(KnownElevation(400.0, 50.0),), max_gradient=0.05))


@pytest.mark.parametrize("known", [0, 3, 9])
@pytest.mark.parametrize("name", ["mugello", "franciacorta", "sa_calobra"])
def test_surveyed_elevations_lie_inside(name, known):
    line = real_line(name)
    targets = line.targets(known=known)
    found = envelope(line.stations, anchors_of(targets, float(line.stations[-1])), targets)
    assert (line.elevations >= found.lowest - 1e-6).all()
    assert (line.elevations <= found.highest + 1e-6).all()

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bobdesk.alignment.segments import Segment
from bobdesk.solve.length import LengthOf
from bobdesk.solve.profile import falls_between, make_profile, row_stations
from tests.solve.made_plans import made, straight_plan

THREE = (Segment("straight", 0, 40), Segment("curve", 40, 90), Segment("straight", 90, 150))


def three(**others):
    return make_profile(straight_plan(150.0), THREE, **others)


def no_edges(profile):
    return np.zeros(max(len(profile.held), 1))


def random_profile(seed, *, breaks=3, transition=8.0):
    centreline, segments = made(seed, curves=4)
    at = np.sort(np.random.default_rng(seed).uniform(20, centreline.length - 20, breaks))
    return make_profile(
        centreline, segments, breaks=tuple(at.tolist()), transition=transition, longest_piece=40.0
    )  # fmt: skip


def test_without_transitions_each_row_falls_by_its_own_gradient():
    profile = three()
    falls = profile.falls(np.array([0.1, 0.05, 0.2]), no_edges(profile))
    np.testing.assert_allclose(falls[:40], 0.1, atol=1e-12)
    np.testing.assert_allclose(falls[40:90], 0.05, atol=1e-12)
    np.testing.assert_allclose(falls[90:], 0.2, atol=1e-12)


def test_a_transition_is_a_parabola_known_by_hand():
    profile = three(transition=8.0)
    assert profile.half_transitions.tolist() == [4.0, 4.0]
    fallen = np.concatenate([[0.0], np.cumsum(profile.falls(np.array([0.1, 0.05, 0.2]), no_edges(profile)))])
    np.testing.assert_allclose(fallen[36], 3.6, atol=1e-12)
    for station in range(36, 45):
        past = station - 36
        # The gradient goes from 0.1 to 0.05 on a straight ramp of 8 m.
        assert fallen[station] == pytest.approx(3.6 + 0.1 * past - 0.05 / 8 * past**2 / 2, abs=1e-12)
    # The ramp's mean is that of the two gradients: beyond it the fall is that of the kink.
    assert fallen[44] == pytest.approx(4.0 + 4 * 0.05, abs=1e-12)
    assert fallen[-1] == pytest.approx(0.1 * 40 + 0.05 * 50 + 0.2 * 60, abs=1e-12)


def test_a_held_edge_passes_through_its_gradient_and_is_known_by_hand():
    profile = three(transition=8.0, breaks=(65.0,))
    assert profile.held.tolist() == [False, True, False]
    given_at = np.array([0.0, 0.07, 0.0])
    fallen = np.concatenate([[0.0], np.cumsum(profile.falls(np.array([0.1, 0.05, 0.1, 0.2]), given_at))])
    # From 61 to 65 the gradient goes from 0.05 to 0.07, from 65 to 69 on to 0.1.
    at_61 = 0.1 * 40 + 0.05 * 21
    assert fallen[61] == pytest.approx(at_61, abs=1e-12)
    assert fallen[65] == pytest.approx(at_61 + 4 * 0.06, abs=1e-12)
    assert fallen[63] == pytest.approx(at_61 + 2 * 0.055, abs=1e-12)
    assert fallen[69] == pytest.approx(at_61 + 4 * 0.06 + 4 * 0.085, abs=1e-12)


def test_transitions_are_shortened_to_the_shorter_piece():
    segments = (Segment("straight", 0, 100), Segment("curve", 100, 105), Segment("straight", 105, 150))
    profile = make_profile(straight_plan(150.0), segments, transition=8.0)
    np.testing.assert_allclose(profile.half_transitions, [2.5, 2.5])
    falls = profile.falls(np.array([0.1, 0.2, 0.0]), no_edges(profile))
    assert falls.sum() == pytest.approx(10 + 1.0, abs=1e-12)


def test_kinks_get_no_transition():
    profile = three(transition=8.0, breaks=(65.0,), kinks=(65.0,))
    assert profile.half_transitions.tolist() == [4.0, 0.0, 4.0]


def test_a_boundary_near_a_known_elevation_gives_way_to_it():
    np.testing.assert_allclose(three(breaks=(40.8,)).edges, [0, 40.8, 90, 150])
    np.testing.assert_allclose(three(breaks=(41.2,)).edges, [0, 40, 41.2, 90, 150])


def test_long_pieces_are_divided_evenly():
    profile = three(longest_piece=40.0)
    np.testing.assert_allclose(profile.edges, [0, 40, 65, 90, 120, 150])
    assert profile.segment_of.tolist() == [0, 1, 1, 2, 2]


def test_rows_stand_on_known_elevations():
    stations = row_stations(150.0, 1.0, [33.3, 90.05])
    for at in (0.0, 33.3, 90.05, 150.0):
        assert np.abs(stations - at).min() == 0
    steps = np.diff(stations)
    assert (steps > 0.95).all()
    assert (steps < 1.05).all()


@settings(deadline=None, max_examples=30, derandomize=True)
@given(seed=st.integers(0, 5), values=st.integers(0, 10_000), transition=st.sampled_from([0.0, 3.0, 8.0, 60.0]))
def test_transitions_conserve_the_fall_between_known_elevations(seed, values, transition):
    profile = random_profile(seed, transition=transition)
    rng = np.random.default_rng(values)
    gradients = rng.uniform(-0.2, 0.25, len(profile.piece_lengths))
    edges = np.where(profile.held, rng.uniform(-0.2, 0.25, len(profile.held)), 0.0)
    held_at = np.concatenate([[0.0], profile.edges[1:-1][profile.held], profile.edges[-1:]])
    fallen = np.concatenate([[0.0], np.cumsum(profile.falls(gradients, edges))])
    between = falls_between(profile, held_at)(gradients, edges)
    rows = np.searchsorted(profile.stations, held_at - 1e-7)
    np.testing.assert_allclose(profile.stations[rows], held_at, atol=1e-7)
    np.testing.assert_allclose(np.diff(fallen[rows]), between, atol=1e-9)
    # A change of one stretch's gradients moves no other stretch.
    other = gradients.copy()
    stretch = np.concatenate([[0], np.cumsum(profile.held)])
    other[stretch == 1] += 0.01
    moved = falls_between(profile, held_at)(other, edges) - between
    np.testing.assert_allclose(np.delete(moved, 1), 0.0, atol=1e-12)


def test_free_transitions_leave_the_fall_of_two_pieces_as_the_kink_would():
    centreline, segments = made(2, curves=4)
    smooth = make_profile(centreline, segments, transition=8.0)
    kinked = make_profile(centreline, segments)
    gradients = np.random.default_rng(1).uniform(0, 0.2, len(segments))
    falls = [profile.falls(gradients, no_edges(profile)).sum() for profile in (smooth, kinked)]
    assert falls[0] == pytest.approx(falls[1], abs=1e-10)
    assert falls[0] == pytest.approx(gradients @ smooth.piece_lengths, abs=1e-9)


@pytest.mark.parametrize("scale", [1.0, 1.7])
@pytest.mark.parametrize("transition", [0.0, 8.0, 40.0])
@pytest.mark.parametrize("seed", range(3))
def test_the_length_is_the_sum_over_all_rows_and_its_derivative_that_of_differences(seed, transition, scale):
    profile = random_profile(seed, transition=transition)
    rng = np.random.default_rng(seed + 7)
    gradients = rng.uniform(-0.2, 0.25, len(profile.piece_lengths))
    edges = np.where(profile.held, rng.uniform(-0.1, 0.2, len(profile.held)), 0.0)
    length_of = LengthOf(profile, edges, scale)
    length, derivative = length_of(gradients)
    falls = scale * profile.falls(gradients, edges)
    assert length == pytest.approx(np.hypot(scale * profile.chords, falls).sum(), abs=1e-9)
    for piece in range(len(gradients)):
        step = np.zeros(len(gradients))
        step[piece] = 1e-5
        central = (length_of(gradients + step)[0] - length_of(gradients - step)[0]) / 2e-5
        assert derivative[piece] == pytest.approx(central, rel=1e-6, abs=1e-6)

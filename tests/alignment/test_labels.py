from itertools import groupby, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bobdesk.alignment.curvature import curvature
from bobdesk.alignment.labels import Blocks, best_labels, best_labels_of_count, blocks_of, gain_by_count, otsu_threshold
from tests.alignment.made_lines import fitted, made_plan

FEW = settings(deadline=None, max_examples=60, derandomize=True)
scores_of_blocks = st.lists(
    st.tuples(*[st.floats(-20, 20, allow_nan=False)] * 3), min_size=1, max_size=6
).map(np.array)  # fmt: skip


def blocks_with(scores):
    return Blocks(np.arange(len(scores) + 1.0), scores)


def gain(scores, labels):
    return sum(row[label + 1] for row, label in zip(scores, labels, strict=True))


def runs(labels):
    return len(list(groupby(labels)))


def all_labellings(scores):
    return product((-1, 0, 1), repeat=len(scores))


@FEW
@given(scores_of_blocks, st.floats(0, 15))
def test_best_labels_are_the_best_of_all(scores, cost):
    found = best_labels(blocks_with(scores), change_cost=cost).tolist()
    best = max(gain(scores, labels) - cost * (runs(labels) - 1) for labels in all_labellings(scores))
    assert gain(scores, found) - cost * (runs(found) - 1) == pytest.approx(best, abs=1e-9)


@FEW
@given(scores_of_blocks)
def test_best_labels_of_each_count_are_the_best_of_all_of_that_count(scores):
    gains = gain_by_count(blocks_with(scores), len(scores))
    of_count = []
    for count in range(1, len(scores) + 1):
        found = best_labels_of_count(blocks_with(scores), count).tolist()
        best = max(gain(scores, labels) for labels in all_labellings(scores) if runs(labels) == count)
        assert runs(found) == count
        assert gain(scores, found) == pytest.approx(best, abs=1e-9)
        of_count.append(best)
        assert gains[count - 1] == pytest.approx(max(of_count), abs=1e-9)


def wave(seed):
    rng = np.random.default_rng(seed)
    stations = np.arange(0.0, 400.0)
    bends = sum(rng.normal() * 0.01 * np.sin(stations / rng.uniform(6, 30) + rng.uniform(0, 6)) for _ in range(4))
    return stations, bends


@pytest.mark.parametrize("seed", range(5))
def test_no_count_gains_more_than_the_free_optimum(seed):
    blocks = blocks_of(*wave(seed), 0.004)
    free = runs(best_labels(blocks, change_cost=0.0).tolist())
    gains = gain_by_count(blocks, len(blocks.scores))
    assert gains[free - 1] == pytest.approx(blocks.scores.max(axis=1).sum())
    assert gains.max() == pytest.approx(gains[free - 1])


@pytest.mark.parametrize("seed", range(5))
def test_each_more_segment_of_a_track_gains_until_all_are_found(seed):
    centreline = fitted(made_plan(seed))
    blocks = blocks_of(centreline.stations, curvature(centreline), 0.004)
    gains = gain_by_count(blocks, runs(best_labels(blocks, change_cost=4.0).tolist()))
    assert len(gains) >= 15
    assert (np.diff(gains) > 0).mean() > 0.8


def test_a_cut_stands_where_the_curvature_crosses_a_level():
    stations = np.array([0.0, 10.0, 20.0, 30.0])
    bends = np.array([0.0, 0.01, -0.01, -0.01])
    blocks = blocks_of(stations, bends, 0.005)
    np.testing.assert_allclose(blocks.edges, [0.0, 5.0, 12.5, 15.0, 17.5, 30.0])
    # Left gains (k - t) / t clipped to 1.5, as integrals of its linear interpolation.
    left = np.array([-1.0, 1.0, -1.5, -1.5])
    np.testing.assert_allclose(blocks.scores[0, 2], 0.5 * (left[0] + 0.0) * 5.0)
    np.testing.assert_allclose(blocks.scores[:, 1], 0.0)
    np.testing.assert_allclose(blocks.scores[:, 2].sum(), np.trapezoid(left, stations))


@pytest.mark.parametrize("seed", range(4))
def test_the_optimum_over_blocks_is_that_over_all_stations(seed):
    stations, bends = wave(seed)
    blocks = blocks_of(stations, bends, 0.004)
    fine = np.union1d(np.arange(0.0, 399.01, 0.5), blocks.edges)
    left = np.clip((bends - 0.004) / 0.004, -1.5, 1.5)
    right = np.clip((-bends - 0.004) / 0.004, -1.5, 1.5)
    scores = [np.zeros(len(fine) - 1)] * 3
    for state, values in ((0, right), (2, left)):
        at = np.interp(fine, stations, values)
        scores[state] = 0.5 * (at[1:] + at[:-1]) * np.diff(fine)
    everywhere = Blocks(fine, np.column_stack(scores))
    for cost in (1.0, 4.0):
        coarse_labels = best_labels(blocks, change_cost=cost).tolist()
        fine_labels = best_labels(everywhere, change_cost=cost).tolist()
        coarse = gain(blocks.scores, coarse_labels) - cost * (runs(coarse_labels) - 1)
        best = gain(everywhere.scores, fine_labels) - cost * (runs(fine_labels) - 1)
        assert coarse == pytest.approx(best, abs=0.05)


def test_otsus_threshold_parts_two_heaps():
    rng = np.random.default_rng(4)
    values = np.concatenate([rng.normal(-6, 0.3, 400), rng.normal(-3, 0.3, 300)])
    assert -5.5 < otsu_threshold(values) < -3.5


def test_otsus_threshold_is_the_largest_spread_between_the_halves():
    values = np.random.default_rng(6).gamma(2.0, 1.0, 500)
    counts, edges = np.histogram(values, 32)
    centres = 0.5 * (edges[1:] + edges[:-1])
    spreads = []
    for cut in range(1, 32):
        w, v = counts[:cut].sum(), counts[cut:].sum()
        apart = (counts[:cut] @ centres[:cut]) / w - (counts[cut:] @ centres[cut:]) / max(v, 1)
        spreads.append(w * v * apart**2)
    assert otsu_threshold(values, bins=32) == pytest.approx(centres[int(np.argmax(spreads))])

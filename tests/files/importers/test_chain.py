"""Pieces of a line, shuffled and turned about, become the line again."""

from __future__ import annotations

import itertools

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from bobdesk.files.importers.chain import joined, longest_chain
from tests.files.importers.made_files import PLAN


@settings(deadline=None, max_examples=80, derandomize=True)
@given(
    cuts=st.sets(st.integers(1, 58), max_size=12),
    order=st.randoms(use_true_random=False),
    noise=st.floats(0, 1e-3),
)
def test_pieces_in_any_order_and_direction_become_the_line(cuts, order, noise):
    edges = [0, *sorted(cuts), 59]
    paths = [PLAN[first : last + 1] + noise * order.random() for first, last in itertools.pairwise(edges)]
    paths = [path[::-1] if order.random() < 0.5 else path for path in paths]
    order.shuffle(paths)
    found = joined(paths, longest_chain(paths))
    if np.hypot(*(found[0] - PLAN[0])) > 1:
        found = found[::-1]
    assert np.abs(found - PLAN).max() <= noise + 1e-9


def _length(paths):
    line = joined(paths, longest_chain(paths))
    return np.hypot(*np.diff(line, axis=0).T).sum()


@settings(deadline=None, max_examples=60, derandomize=True)
@given(st.lists(st.tuples(st.integers(0, 4), st.integers(0, 4)), min_size=1, max_size=7, unique=True))
def test_in_any_small_network_the_longest_way_is_found(pairs):
    """Against trying every order and direction of the paths."""
    corners = np.array([[0.0, 0.0], [10.0, 1.0], [13.0, 9.0], [4.0, 17.0], [-6.0, 8.0]])
    pairs = sorted({(min(pair), max(pair)) for pair in pairs if pair[0] != pair[1]})
    if not pairs:
        return
    paths = [corners[[a, b]] for a, b in pairs]
    lengths = [float(np.hypot(*(path[1] - path[0]))) for path in paths]

    def longest(node, left):
        best = 0.0
        for index in left:
            for here, there in (pairs[index], pairs[index][::-1]):
                if here == node:
                    best = max(best, lengths[index] + longest(there, left - {index}))
        return best

    wanted = max(longest(node, frozenset(range(len(paths)))) for node in range(5))
    assert abs(_length(paths) - wanted) < 1e-9


def test_a_ring_in_pieces_is_a_ring():
    angle = np.linspace(0, 2 * np.pi, 61)
    ring = 50 * np.column_stack([np.cos(angle), np.sin(angle)])
    paths = [ring[20:41], ring[:21][::-1], ring[40:]]
    found = joined(paths, longest_chain(paths))
    assert len(found) == 61
    assert np.hypot(*(found[0] - found[-1])) < 1e-9


def test_lines_a_metre_apart_are_not_joined():
    paths = [PLAN[:30], PLAN[30:] + np.array([0.0, 1.0])]
    assert len(longest_chain(paths)) == 1


def test_a_line_drawn_twice_is_not_run_there_and_back():
    assert len(joined([PLAN, PLAN[::-1], PLAN], longest_chain([PLAN, PLAN[::-1], PLAN]))) == 60


def test_a_kreisel_drawn_as_a_ring_of_its_own_is_run_through():
    angle = np.linspace(-np.pi / 2, 1.5 * np.pi, 41)
    ring = np.column_stack([50 * np.cos(angle), 50 + 50 * np.sin(angle)])
    straight = np.array([[-100.0, 0.0], [0.0, 0.0]])
    onward = np.array([[0.0, 0.0], [120.0, 0.0]])
    found = joined([straight, ring, onward], longest_chain([straight, ring, onward]))
    assert np.hypot(*np.diff(found, axis=0).T).sum() > 220 + 310

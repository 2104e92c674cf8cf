import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bobdesk.errors import InputError
from bobdesk.plan.polyline import Polyline, edge_lengths, polyline_from_points

SQUARE = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 4.0], [0.0, 4.0]])


def test_points_that_are_apart_are_all_kept():
    polyline, kept = polyline_from_points(SQUARE)
    assert kept.tolist() == [0, 1, 2, 3]
    np.testing.assert_array_equal(polyline.vertices, SQUARE)
    np.testing.assert_array_equal(edge_lengths(polyline), [3.0, 4.0, 3.0])


def test_points_within_a_millimetre_of_the_last_kept_one_are_merged():
    points = np.array([[0, 0], [0, 0.0009], [0, 0.0011], [1, 0], [1, 0], [2, 0]], dtype=float)
    polyline, kept = polyline_from_points(points)
    assert kept.tolist() == [0, 2, 3, 5]
    np.testing.assert_array_equal(polyline.vertices, points[kept])


def test_a_slow_creep_of_points_is_thinned_but_not_lost():
    points = np.column_stack([np.arange(101) * 0.0004, np.zeros(101)])
    polyline, kept = polyline_from_points(points)
    assert kept.tolist() == list(range(0, 101, 3))
    assert edge_lengths(polyline).min() >= 0.001


def test_a_line_may_return_to_a_point():
    points = np.array([[0, 0], [1, 0], [0, 1], [0, 0]], dtype=float)
    assert polyline_from_points(points)[1].tolist() == [0, 1, 2, 3]


def test_vertices_are_a_copy_that_cannot_be_written():
    given = SQUARE.copy()
    polyline = Polyline(given)
    given[0, 0] = 9
    assert polyline.vertices[0, 0] == 0
    with pytest.raises(ValueError, match="read-only"):
        polyline.vertices[0, 0] = 1


def test_another_shape_is_refused():
    with pytest.raises(ValueError, match="shape"):
        Polyline(np.zeros((4, 3)))


@pytest.mark.parametrize(
    ("points", "words"),
    [
        (np.array([[0, 0], [1, np.nan], [2, 2]]), "point 2 .* not a finite number"),
        (np.array([[0, 0], [1, 1], [np.inf, 2]]), "point 3 .* not a finite number"),
        (np.array([[0, 0], [1, 1], [-1e8, 2]]), "beyond 100,000 km"),
        (np.array([[0, 0], [1, 1]]), "only 2 different points"),
        (np.array([[5, 5], [5, 5], [5, 5]]), "only one point"),
        (np.zeros((0, 2)), "0 different points"),
        (np.zeros((1_000_001, 2)), "1,000,001 points; .* 1,000,000"),
    ],
)
def test_what_is_no_line_is_named(points, words):
    with pytest.raises(InputError, match=words):
        polyline_from_points(points.astype(float))


@settings(deadline=None, max_examples=60, derandomize=True)
@given(st.lists(st.tuples(st.integers(0, 4000), st.integers(0, 3)), min_size=3, max_size=30))
def test_kept_points_stay_in_order_and_apart(rows):
    points = np.array(rows, dtype=float) * 5e-4
    try:
        polyline, kept = polyline_from_points(points)
    except InputError:
        kept_by_hand = [points[0]]
        for point in points[1:]:
            if np.hypot(*(point - kept_by_hand[-1])) >= 1e-3:
                kept_by_hand.append(point)
        assert len(kept_by_hand) < 3
        return
    assert kept[0] == 0
    assert (np.diff(kept) > 0).all()
    assert edge_lengths(polyline).min() >= 1e-3
    for row in set(range(len(points))) - set(kept.tolist()):
        before = kept[kept < row][-1]
        assert np.hypot(*(points[row] - points[before])) < 1e-3

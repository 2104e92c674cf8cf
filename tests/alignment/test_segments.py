import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bobdesk.alignment.segments import (
    SHORTEST,
    Segment,
    check_segments,
    flip_kind,
    keep_corrections,
    merge,
    move_boundary,
    number_curves,
    rename,
    segment_at,
    set_locked,
    split,
)
from bobdesk.errors import InputError

THREE = (Segment("straight", 0, 40), Segment("curve", 40, 100, name="C1"), Segment("straight", 100, 150))
LOCKED = set_locked(THREE, 1, locked=True)


def spans(segments):
    return [(segment.kind, segment.start, segment.end) for segment in segments]


def test_a_boundary_belongs_to_the_later_segment():
    assert [segment_at(THREE, at) for at in (-1, 0, 39.9, 40, 99, 100, 150, 999)] == [0, 0, 0, 1, 1, 2, 2, 2]


def test_split_keeps_kind_and_leaves_the_name_with_the_first_part():
    assert split(THREE, 60) == (
        THREE[0],
        Segment("curve", 40, 60, name="C1", by_hand=True),
        Segment("curve", 60, 100, by_hand=True),
        THREE[2],
    )


@pytest.mark.parametrize("station", [42.9, 97.1, 0, 150])
def test_split_leaves_no_sliver(station):
    with pytest.raises(InputError, match="shorter than 3 m"):
        split(THREE, station)


def test_merge_takes_kind_and_name_of_the_longest():
    assert merge(THREE, 0, 1) == (Segment("curve", 0, 100, name="C1", by_hand=True), THREE[2])
    assert merge(THREE, 0, 2) == (Segment("curve", 0, 150, name="C1", by_hand=True),)


@pytest.mark.parametrize(("first", "last"), [(1, 1), (2, 1), (-1, 1), (0, 3)])
def test_merge_needs_neighbours(first, last):
    with pytest.raises(InputError, match="two or more neighbouring"):
        merge(THREE, first, last)


@pytest.mark.parametrize(("to", "reached"), [(50, 50), (-20, SHORTEST), (1e9, 100 - SHORTEST)])
def test_a_boundary_stops_before_the_next_one(to, reached):
    assert spans(move_boundary(THREE, 0, to)) == [
        ("straight", 0, reached),
        ("curve", reached, 100),
        ("straight", 100, 150),
    ]


@pytest.mark.parametrize("boundary", [-1, 2])
def test_the_ends_do_not_move(boundary):
    with pytest.raises(InputError, match="the ends of the line are not boundaries"):
        move_boundary(THREE, boundary, 50)


def test_flip_rename_and_lock():
    assert flip_kind(THREE, 0)[0].kind == "curve"
    assert spans(flip_kind(flip_kind(THREE, 0), 0)) == spans(THREE)
    assert rename(THREE, 2, "  Kreisel ")[2].name == "Kreisel"
    assert set_locked(LOCKED, 1, locked=False) == THREE
    assert LOCKED[1].locked
    assert not THREE[1].locked


@pytest.mark.parametrize(
    ("edit", "verb"),
    [
        (lambda s: split(s, 60), "split"),
        (lambda s: merge(s, 0, 1), "merged"),
        (lambda s: move_boundary(s, 0, 50), "moved"),
        (lambda s: move_boundary(s, 1, 90), "moved"),
        (lambda s: flip_kind(s, 1), "changed"),
    ],
)
def test_a_locked_segment_refuses_edits(edit, verb):
    with pytest.raises(InputError, match=f"segment 2 is locked; unlock it before it is {verb}"):
        edit(LOCKED)


@pytest.mark.parametrize(
    ("segments", "words"),
    [
        ([], "no segment"),
        ([Segment("bend", 0, 150)], "segment 1 is of the kind 'bend'"),
        ([THREE[0], Segment("curve", 39, 150)], "segment 2 overlaps"),
        ([THREE[0], Segment("curve", 41, 150)], "segment 2 leaves a gap"),
        ([Segment("curve", 1, 150)], "segment 1 leaves a gap"),
        ([THREE[0], Segment("curve", 40, 40)], "segment 2 begins at 40.000 m and ends at 40.000 m"),
        ([*THREE, Segment("curve", 150, 140)], "segment 4 begins at 150.000 m and ends at 140.000 m"),
        (THREE[:2], "end at 100.000 m, but the line is 150.000 m"),
    ],
)
def test_segments_that_do_not_cover_the_line_are_named(segments, words):
    with pytest.raises(InputError, match=words):
        check_segments(segments, length=150)


def test_segments_that_cover_the_line_are_returned():
    assert check_segments(list(THREE), length=150) == THREE


def test_detecting_again_lays_locked_segments_over_what_was_found():
    detected = (Segment("straight", 0, 45), Segment("curve", 45, 90), Segment("straight", 90, 150))
    assert keep_corrections(detected, LOCKED) == (
        Segment("straight", 0, 40),
        LOCKED[1],
        Segment("straight", 100, 150),
    )


def test_what_is_left_beside_a_locked_segment_joins_a_free_neighbour_or_stays():
    lock = Segment("curve", 40, 100, locked=True)
    detected = (Segment("straight", 0, 38), Segment("curve", 38, 150))
    assert spans(keep_corrections(detected, (lock,))) == [("straight", 0, 40), ("curve", 40, 100), ("curve", 100, 150)]
    second = Segment("straight", 101, 150, locked=True)
    kept = keep_corrections(detected, (lock, second))
    assert [round(s.length) for s in kept] == [40, 60, 1, 49]


LENGTH = 300.0
stations = st.floats(-10, 310)
indices = st.integers(-1, 12)
edits = st.one_of(
    st.tuples(st.just(split), stations),
    st.tuples(st.just(merge), indices, indices),
    st.tuples(st.just(move_boundary), indices, stations),
    st.tuples(st.just(flip_kind), st.integers(0, 12)),
    st.tuples(st.just("lock"), st.integers(0, 12), st.booleans()),
    st.tuples(st.just("again"), st.lists(st.floats(0.01, 1), min_size=1, max_size=6)),
)


def detected_from(shares):
    edges = np.concatenate([[0.0], np.cumsum(shares) / np.sum(shares) * LENGTH])
    edges[-1] = LENGTH
    kinds = ["straight", "curve"]
    return tuple(Segment(kinds[i % 2], float(edges[i]), float(edges[i + 1])) for i in range(len(shares)))


def apply(segments, edit):
    action, *arguments = edit
    if action == "lock":
        return set_locked(segments, arguments[0] % len(segments), locked=arguments[1])
    if action == "again":
        return keep_corrections(detected_from(arguments[0]), segments)
    if action is flip_kind:
        return flip_kind(segments, arguments[0] % len(segments))
    return action(segments, *arguments)


@settings(deadline=None, max_examples=150, derandomize=True)
@given(st.lists(edits, max_size=25))
def test_any_sequence_of_edits_leaves_the_line_covered_and_locks_respected(sequence):
    segments = (Segment("straight", 0.0, 100.0), Segment("curve", 100.0, 200.0), Segment("straight", 200.0, LENGTH))
    for edit in sequence:
        before = tuple(spans(segments))
        locked = {(s.kind, s.start, s.end) for s in segments if s.locked}
        try:
            following = apply(segments, edit)
        except InputError:
            following = segments
        assert tuple(spans(segments)) == before
        check_segments(following, length=LENGTH)
        if edit[0] != "lock":
            assert {(s.kind, s.start, s.end) for s in following if s.locked} == locked
        segments = following


def test_detecting_again_leaves_what_was_made_by_hand_and_carries_names_over():
    named = rename(THREE, 2, "Final straight")
    moved = move_boundary(named, 0, 50)
    assert [s.by_hand for s in moved] == [True, True, False]
    detected = (Segment("straight", 0, 45), Segment("curve", 45, 98), Segment("straight", 98, 150))
    again = keep_corrections(detected, moved)
    assert spans(again) == spans(moved)
    assert again[2].name == "Final straight"
    assert keep_corrections(detected, again) == again


def test_a_sliver_beside_nothing_free_joins_the_hand_made_one_but_never_a_locked_one():
    lock, made = Segment("curve", 0, 40, locked=True), Segment("straight", 41, 150, by_hand=True)
    kept = keep_corrections((Segment("straight", 0, 150),), (lock, made))
    assert kept == (lock, Segment("straight", 40, 150, by_hand=True))


def test_curves_are_numbered_from_the_start_and_free_names_stay():
    segments = (
        Segment("curve", 0, 10),
        Segment("straight", 10, 20, name="2"),
        Segment("curve", 20, 30, name="Kreisel"),
        Segment("curve", 30, 40, name="7 Labyrinth"),
        Segment("curve", 40, 50, name="9"),
        Segment("straight", 50, 60, name="Finish"),
    )
    numbered = number_curves(segments)
    assert [s.name for s in numbered] == ["1", "", "Kreisel", "3 Labyrinth", "4", "Finish"]
    assert number_curves(numbered) == numbered

"""What keys, buttons and menus do to segments."""

import dataclasses

import pytest
from pytestqt.qtbot import QtBot

from bobdesk.alignment.segments import check_segments
from bobdesk.project import derive, edits, segment_edits
from bobdesk.project.project import Project
from bobdesk.ui.actions.segment_actions import SegmentActions
from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.alignment_now import AlignmentNow, alignment_now
from bobdesk.ui.segments.automatic_operations import AutomaticOperations, automatic_operations
from bobdesk.ui.segments.operations import SegmentOperations, operations


@pytest.fixture
def do(desk: Desk, now: AlignmentNow) -> SegmentOperations:
    return operations(desk)


@pytest.fixture
def find(desk: Desk, now: AlignmentNow) -> AutomaticOperations:
    return automatic_operations(desk)


def test_split_at_the_cursor_selects_the_new_boundary(desk, now, do, told):
    station = 0.5 * (now.segments[3].start + now.segments[3].end)
    desk.selection.station = station
    do.split()
    assert [segment.end for segment in now.segments[3:5]] == [station, pytest.approx(now.segments[4].end)]
    assert (desk.selection.boundary, desk.selection.segments) == (3, (4,))
    assert desk.session.undo_label == "Split segment"
    assert told == []


def test_what_is_not_possible_is_said(desk, now, do, find, told):
    before = desk.session.project
    do.split()
    assert "is split there" in told[-1]
    do.flip()
    assert "Select a segment first" in told[-1]
    do.delete_boundary()
    assert "Select a boundary first" in told[-1]
    desk.selection.segments = (2, 5)
    do.merge()
    assert "Only neighbours" in told[-1]
    find.detect_again()
    assert "are automatic" in told[-1]
    find.back_to_automatic()
    assert "automatic already" in told[-1]
    desk.selection.station = now.segments[4].start + 0.2
    do.split()
    assert "shorter than 3 m" in told[-1]
    assert desk.session.project is before


def test_without_a_line_every_operation_says_so(desk, told):
    do, find = operations(desk), automatic_operations(desk)
    for one in (do.split, do.merge, do.flip, do.lock, do.delete_boundary, do.number_curves, find.detect_again):
        one()
    assert len(told) == 7
    assert all("a line comes first" in sentence for sentence in told)


def test_merge_takes_the_selection_or_the_nearer_neighbour(desk, now, do):
    count = len(now.segments)
    segment = now.segments[4]
    do.select(4, station=segment.start + 0.2 * segment.length)
    do.merge()
    assert (len(now.segments), desk.selection.segments) == (count - 1, (3,))
    desk.session.undo()
    do.select(4, station=segment.start + 0.8 * segment.length)
    do.merge()
    assert now.segments[4].end > segment.end
    desk.session.undo()
    do.select(2)
    do.select(6, add=True)
    assert desk.selection.segments == (2, 3, 4, 5, 6)
    do.merge()
    assert len(now.segments) == count - 4


def test_lock_respects_and_unlocks(desk, now, do, told):
    do.select(5)
    do.lock()
    assert now.segments[5].locked
    assert not desk.session.project.segments[5].by_hand
    do.flip()
    assert "locked" in told[-1]
    desk.selection.boundary = 5
    assert do.nudge(1.0)
    assert "is locked, so this boundary stays" in told[-1]
    do.lock()
    assert not now.segments[5].locked
    assert desk.session.undo_label == "Unlock segment"


def test_nudges_in_a_row_are_one_step(desk, now, do):
    end = now.segments[2].end
    desk.selection.boundary = 2
    for _ in range(5):
        do.nudge(0.1)
    assert now.segments[2].end == pytest.approx(end + 0.5)
    desk.session.undo()
    assert desk.session.undo_label is None
    assert now.segments[2].end == end


def test_next_and_previous_walk_along_the_line(desk, now, do):
    do.select_next(1)
    do.select_next(1)
    assert desk.selection.segments == (1,)
    assert now.segments[1].start < desk.selection.station < now.segments[1].end
    do.select_next(-1)
    do.select_next(-1)
    assert desk.selection.segments == (0,)


def test_detecting_again_keeps_corrections_and_automatic_gives_them_up(desk, now, do, find, idle):
    automatic = now.segments
    do.move_boundary(2, automatic[2].end + 5.0)
    do.select(8)
    do.lock()
    find.change_settings(threshold=0.01)
    idle()
    assert now.segments[2].end == automatic[2].end + 5.0
    assert any(segment == dataclasses.replace(automatic[8], locked=True) for segment in now.segments)
    assert desk.session.project.segmentation.threshold == 0.01
    find.back_to_automatic()
    idle()
    assert desk.session.project.segments is None
    desk.session.undo()
    assert now.segments[2].end == automatic[2].end + 5.0


def test_changes_that_follow_each_other_fast_are_all_kept(desk, now, do, find, idle):
    find.change_settings(threshold=0.006)
    find.change_settings(shortest=12.0)
    find.change_settings(change_cost=7.0)
    idle()
    settings = desk.session.project.segmentation
    assert (settings.threshold, settings.shortest, settings.change_cost) == (0.006, 12.0, 7.0)


def test_settings_that_cannot_be_met_are_refused_and_nothing_is_lost(desk, now, do, find, idle, told):
    before = desk.session.project
    find.change_settings(count=900)
    idle()
    assert "cannot be told apart" in told[-1]
    assert desk.session.project is before
    assert len(now.segments) == 17


def test_a_threshold_is_previewed_before_it_is_kept(desk, now, do, find, idle):
    before = desk.session.project
    find.preview_threshold(0.03)
    idle()
    assert desk.session.project is before
    assert now.is_preview
    assert now.threshold == 0.03
    shown = now.segments
    find.change_settings(threshold=0.03)
    idle()
    assert not now.is_preview
    assert [s.end for s in now.segments] == pytest.approx([s.end for s in shown])
    desk.session.undo()
    idle()
    find.preview_threshold(0.02)
    find.drop_preview()
    idle()
    assert not now.is_preview
    assert len(now.segments) == 17


def test_numbers_and_names_survive_detecting_again(desk, now, do, find, idle):
    do.number_curves()
    assert [s.name for s in now.segments if s.kind == "curve"] == [str(n) for n in range(1, 9)]
    do.rename(3, "Kreisel")
    find.change_settings(threshold=0.0041)
    idle()
    assert sum(s.name == "Kreisel" for s in now.segments) == 1
    assert desk.session.project.segments is not None


def test_a_new_line_gives_new_segments_and_keeps_none_of_the_selection_beyond_them(desk, now, do, idle, track):
    do.select(16)
    desk.selection.boundary = 15
    desk.session.apply("Cut", lambda project: edits.set_finish(project, 200.0))
    assert not now.is_current
    idle()
    assert len(now.segments) < 10
    assert desk.selection.segments == ()
    assert desk.selection.boundary is None


def test_every_action_is_done_by_its_row(desk: Desk, now: AlignmentNow, window, qtbot: QtBot) -> None:
    rows = {row.name: row for row in SegmentActions(desk, window).table()}
    desk.selection.station = 0.5 * (now.segments[5].start + now.segments[5].end)
    for name in ("flip_kind", "lock_segment", "lock_segment", "split_segment", "delete_boundary", "number_curves"):
        assert rows[name].enabled()
        before = desk.session.project
        rows[name].do()
        assert desk.session.project is not before, name
    assert rows["split_segment"].keys == ("X",)
    desk.session.close()
    assert not rows["split_segment"].enabled()


def test_the_documents_segments_and_those_shown_agree_after_undo(desk: Desk, now: AlignmentNow) -> None:
    do = operations(desk)
    seen: list[Project] = []
    for index in (1, 4, 7):
        seen.append(desk.session.project)
        do.flip_one(index)
    for project in reversed(seen):
        desk.session.undo()
        assert desk.session.project is project
        wanted = derive.segments(project).needed()
        assert alignment_now(desk).segments == wanted
        check_segments(wanted, length=now.value.line.length)


def test_detecting_again_without_a_change_says_why(desk, now, do, find, idle, told):
    do.flip_one(3)
    before = desk.session.project
    find.detect_again()
    idle()
    assert desk.session.project is before
    assert told == [
        "Nothing changed: 1 of 17 segments are locked or made by hand and stay, and with the same settings the others"
        " are found as they are."
    ]


def test_detecting_again_with_nothing_corrected_any_more_says_so(desk, now, do, find, idle, told):
    do.set_locked(3, locked=True)
    do.set_locked(3, locked=False)
    before = now.segments
    find.detect_again()
    idle()
    assert desk.session.project.segments is None
    assert now.segments == before
    assert told == ["Nothing changed: with the same settings all 17 segments are found as they are."]


def test_detecting_again_with_a_change_says_nothing(desk, now, do, find, idle, told):
    do.select(4)
    do.select(6, add=True)
    do.merge()
    project = desk.session.project
    loose = tuple(dataclasses.replace(one, by_hand=False) for one in project.segments)
    desk.session.apply("Loose", lambda before: dataclasses.replace(before, segments=loose))
    do.set_locked(0, locked=True)
    find.detect_again()
    idle()
    assert len(now.segments) == 17
    assert told == []


def test_a_threshold_dragged_back_to_where_it_was_shows_the_document_again(desk, now, find, idle):
    find.change_settings(threshold=0.01)
    idle()
    find.preview_threshold(0.03)
    idle()
    assert now.is_preview
    find.change_settings(threshold=0.01)
    idle()
    assert not now.is_preview
    assert now.threshold == 0.01


@pytest.mark.parametrize(("by", "number"), [(-500.0, 4), (500.0, 5)])
def test_a_nudge_that_can_go_no_further_says_so(desk, now, do, told, by, number):
    do.select_boundary(3)
    do.nudge(by)
    assert told == []
    end = now.segments[3].end
    do.nudge(by / 1000)
    assert now.segments[3].end == end
    assert told == [f"The boundary can go no further: segment {number} would be shorter than 3.0 m."]


def test_keys_while_a_threshold_is_tried_act_on_the_segments_of_the_document(desk, now, do, find, idle):
    station = now.segments[9].end
    desk.selection.station = station + 0.5
    find.preview_threshold(0.03)
    idle()
    assert len(now.segments) < len(now.known.segments)
    before = {segment.end for segment in now.known.segments}
    do.delete_boundary()
    assert before - {segment.end for segment in now.segments} == {station}


def test_the_selection_stays_on_the_line_when_other_segments_come_or_go(desk, now, do, find, idle):
    do.select(13)
    chosen = now.segments[13]
    desk.session.apply("Split", lambda project: segment_edits.split_segment(project, now.segments[2].start + 10.0))
    assert [now.segments[index] for index in desk.selection.segments] == [chosen]
    do.select_boundary(8)
    boundary = now.segments[8].end
    desk.session.undo()
    assert now.segments[desk.selection.boundary].end == boundary
    assert len(desk.selection.segments) == 2
    do.select(12)
    middle = 0.5 * (now.segments[12].start + now.segments[12].end)
    find.change_settings(count=9)
    idle()
    (at,) = desk.selection.segments
    assert now.segments[at].start <= middle < now.segments[at].end


def test_settings_that_can_change_nothing_are_told_with_a_way_out(desk, now, do, find, idle, told):
    do.take(now.segments, "Open segments")
    find.change_settings(count=9)
    idle()
    assert len(now.segments) == 17
    assert told == ["Every segment is locked or made by hand, so other settings change none of them."]


def test_an_edit_while_settings_are_tried_does_not_swallow_them(desk, now, do, find, idle, told):
    find.change_settings(count=15)
    find.change_settings(threshold=0.006)
    do.select(3)
    do.lock()
    idle()
    settings = desk.session.project.segmentation
    assert (settings.count, settings.threshold) == (15, 0.006)
    assert any(segment.locked for segment in now.segments)
    assert told == []


def test_where_there_is_one_segment_nothing_is_merged_and_that_is_said(desk, now, do, find, idle, told):
    find.change_settings(count=1)
    idle()
    do.select(0, station=50.0)
    do.merge()
    do.delete_boundary()
    assert len(told) == 2
    assert all("is one segment" in sentence for sentence in told)


def test_the_same_name_again_is_no_step(desk, now, do):
    assert do.rename(1, "  ")
    assert desk.session.undo_label is None
    assert do.rename(1, " Grosser \t Kreisel ")
    assert now.segments[1].name == "Grosser Kreisel"
    label, project = desk.session.undo_label, desk.session.project
    assert do.rename(1, "Grosser Kreisel")
    assert (label, project) == ("Name segment", desk.session.project)

"""Selecting and correcting vertices with mouse and keys."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt

from bobdesk.project import edits
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.view import PlanView
from tests.ui.plan_view.made_view import CONTROL, SHIFT, Hand

LINE = [(50.0, 50.0), (150.0, 60.0), (250.0, 50.0), (350.0, 60.0)]


@pytest.fixture
def drawn(view: PlanView, desk: Desk) -> PlanView:
    desk.session.apply("Draw line", lambda before: edits.draw_line(before, LINE))
    return view


def points(desk: Desk) -> np.ndarray:
    trace = desk.session.project.trace
    assert trace is not None
    return trace.points


def test_a_drag_is_one_step_and_undo_and_redo_give_the_same_objects_back(
    drawn: PlanView, hand: Hand, desk: Desk
) -> None:
    before = desk.session.project
    hand.drag(LINE[1], [(152, 70), (154, 90), (160, 120)])
    after = desk.session.project
    assert points(desk)[1] == pytest.approx([160, 120], abs=0.6)
    assert desk.session.undo_label == "Move vertex"
    desk.session.undo()
    assert desk.session.project is before
    desk.session.redo()
    assert desk.session.project is after


def test_the_trace_follows_a_drag_before_it_is_done_and_esc_drops_it(drawn: PlanView, hand: Hand, desk: Desk) -> None:
    before = desk.session.project
    hand.drag(LINE[1], [(152, 70), (160, 120)], release=False)
    preview = drawn.tool("select").preview_points()
    assert preview is not None
    assert preview[1] == pytest.approx([160, 120], abs=0.6)
    assert drawn.tool("select").is_dragging
    drawn.grab()
    hand.key(Qt.Key.Key_Escape)
    assert drawn.tool("select").preview_points() is None
    assert desk.session.project is before


def test_an_undo_in_mid_drag_drops_the_drag(drawn: PlanView, hand: Hand, desk: Desk) -> None:
    hand.drag(LINE[3], [(352, 70), (360, 120)], release=False)
    desk.session.undo()
    drawn.grab()
    hand.drag((300, 300), [(310, 310)])
    assert desk.session.project.trace is None


def test_shift_adds_ctrl_toggles_and_all_selected_move_together(drawn: PlanView, hand: Hand, desk: Desk) -> None:
    hand.click(LINE[0])
    assert desk.selection.vertices == (0,)
    hand.click(LINE[2], held=SHIFT)
    assert desk.selection.vertices == (0, 2)
    hand.click(LINE[3], held=CONTROL)
    hand.click(LINE[0], held=CONTROL)
    assert desk.selection.vertices == (2, 3)
    hand.drag(LINE[2], [(250, 70), (250, 80)])
    assert points(desk)[[2, 3]] == pytest.approx(np.array([[250, 80], [350, 90]]), abs=0.6)
    assert points(desk)[1] == pytest.approx(LINE[1])
    assert desk.session.undo_label == "Move vertices"
    hand.click((300.0, 300.0))
    assert desk.selection.vertices == ()


def test_a_rubber_band_selects_and_adds(drawn: PlanView, hand: Hand, desk: Desk) -> None:
    hand.drag((30, 30), [(100, 100), (170, 80)])
    assert desk.selection.vertices == (0, 1)
    hand.drag((330, 40), [(370, 80)], held=SHIFT)
    assert desk.selection.vertices == (0, 1, 3)
    hand.drag((30, 30), [(70, 80)], held=CONTROL)
    assert desk.selection.vertices == (1, 3)
    assert desk.session.undo_label == "Draw line"


def test_a_ghost_in_the_middle_of_an_edge_becomes_a_vertex(drawn: PlanView, hand: Hand, desk: Desk) -> None:
    hand.move((200.0, 55.0))
    drawn.grab()
    hand.drag((200.0, 55.0), [(200, 80), (205, 100)])
    assert len(points(desk)) == 5
    assert points(desk)[2] == pytest.approx([205, 100], abs=0.6)
    assert desk.selection.vertices == (2,)
    assert desk.session.undo_label == "Insert vertex"
    desk.session.undo()
    assert len(points(desk)) == 4


def test_a_double_click_on_the_line_inserts(drawn: PlanView, hand: Hand, desk: Desk) -> None:
    hand.double_click((90.0, 54.0))
    assert len(points(desk)) == 5
    assert points(desk)[1] == pytest.approx([90, 54], abs=1)


def test_arrows_nudge_by_a_screen_pixel_and_merge(drawn: PlanView, hand: Hand, desk: Desk) -> None:
    before = desk.session.project
    hand.click(LINE[1])
    hand.key(Qt.Key.Key_Right)
    hand.key(Qt.Key.Key_Right)
    hand.key(Qt.Key.Key_Down, SHIFT)
    hand.key(Qt.Key.Key_Left, CONTROL)
    pixel = drawn.frame_now().per_screen
    assert points(desk)[1] == pytest.approx([150 + 1.9 * pixel, 60 + 10 * pixel])
    desk.session.undo()
    assert desk.session.project is before


def test_a_dense_line_is_bent_softly_and_alt_moves_one_vertex(view: PlanView, hand: Hand, desk: Desk) -> None:
    dense = [(50.0 + 1.0 * index, 100.0) for index in range(301)]
    desk.session.apply("Draw line", lambda before: edits.draw_line(before, dense))
    hand.drag((200, 100), [(200, 105), (200, 110)])
    bent = points(desk)[:, 1]
    assert bent[150] == pytest.approx(110, abs=0.6)
    assert 100 < bent[140] < 110
    assert bent[0] == 100
    assert np.abs(np.diff(bent)).max() < 1
    assert desk.session.undo_label == "Bend line"


def test_undo_leaves_no_selection_of_vertices_that_are_gone(drawn: PlanView, hand: Hand, desk: Desk) -> None:
    hand.click(LINE[3])
    desk.session.undo()
    assert desk.selection.vertices == ()

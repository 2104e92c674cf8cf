"""Drawing by clicks, following the line, tracing it, two edges: real clicks and keys."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from PySide6.QtCore import Qt

from bobdesk.project import edits
from bobdesk.ui.desk import Desk
from bobdesk.ui.notices import Notice
from bobdesk.ui.plan_view.tools.auto_trace import AutoTraceTool
from bobdesk.ui.plan_view.tools.draw import DrawTool
from bobdesk.ui.plan_view.tools.live_wire import LiveWireTool
from bobdesk.ui.plan_view.view import PlanView
from tests.ui.plan_view.made_view import RADIUS, SHIFT, Hand, on_circle

Until = Callable[[Callable[[], bool]], None]
LINE = [(50.0, 50.0), (150.0, 60.0), (250.0, 50.0)]


def points(desk: Desk) -> np.ndarray:
    trace = desk.session.project.trace
    assert trace is not None
    return trace.points


def off_circle(places: np.ndarray, radius: float = RADIUS) -> float:
    return float(np.abs(np.hypot(places[:, 0] - 200, places[:, 1] - 200) - radius).max())


def remedy(told: list[Notice], text: str) -> None:
    next(one for one in told[-1].remedies if one.text == text).do()


def draw(view: PlanView) -> DrawTool:
    view.set_tool("draw")
    tool = view.tool("draw")
    assert isinstance(tool, DrawTool)
    return tool


def wire(view: PlanView) -> LiveWireTool:
    view.set_tool("live_wire")
    tool = view.tool("live_wire")
    assert isinstance(tool, LiveWireTool)
    return tool


def test_clicks_and_enter_make_a_line_in_one_step(view: PlanView, hand: Hand, desk: Desk) -> None:
    before = desk.session.project
    draw(view)
    hand.click(*LINE)
    view.grab()
    assert desk.session.project is before
    hand.key(Qt.Key.Key_Return)
    assert points(desk) == pytest.approx(np.array(LINE), abs=0.6)
    desk.session.undo()
    assert desk.session.project is before
    desk.session.redo()
    assert len(points(desk)) == 3


def test_a_double_click_ends_and_does_not_double_its_point(view: PlanView, hand: Hand, desk: Desk) -> None:
    draw(view)
    hand.click(*LINE[:2])
    hand.double_click(LINE[2])
    assert len(points(desk)) == 3


def test_backspace_and_undo_take_the_last_click_back(view: PlanView, hand: Hand, desk: Desk) -> None:
    tool = draw(view)
    hand.click(*LINE)
    hand.key(Qt.Key.Key_Backspace)
    assert len(tool.line.points) == 2
    assert view.take_back()
    assert view.take_back()
    assert not view.take_back()
    assert desk.session.project.trace is None


def test_esc_never_destroys_what_was_placed(view: PlanView, hand: Hand, desk: Desk) -> None:
    tool = draw(view)
    hand.click(*LINE)
    hand.key(Qt.Key.Key_Escape)
    assert len(tool.line.points) == 3
    assert view.tool_name == "draw"
    hand.click((300.0, 100.0))
    assert len(tool.line.points) == 4
    hand.key(Qt.Key.Key_Escape)
    hand.key(Qt.Key.Key_Escape)
    assert view.tool_name == "select"
    assert len(points(desk)) == 4


def test_one_point_waits_until_the_tool_is_taken_again(
    view: PlanView, hand: Hand, desk: Desk, told: list[Notice]
) -> None:
    tool = draw(view)
    hand.click(LINE[0])
    view.set_tool("select")
    assert "kept" in told[-1].sentence
    draw(view)
    hand.click(LINE[1])
    hand.key(Qt.Key.Key_Return)
    assert len(points(desk)) == 2
    assert tool.line.is_empty


@pytest.mark.parametrize("end", [0, -1])
def test_a_line_is_continued_from_either_end(view: PlanView, hand: Hand, desk: Desk, end: int) -> None:
    desk.session.apply("Draw line", lambda before: edits.draw_line(before, LINE))
    draw(view)
    hand.click(LINE[end], (100.0, 300.0), (120.0, 330.0))
    hand.key(Qt.Key.Key_Return)
    assert len(points(desk)) == 5
    assert points(desk)[end] == pytest.approx([120, 330], abs=0.6)
    assert desk.session.undo_label == "Continue line"
    if end == 0:
        assert points(desk)[2:] == pytest.approx(np.array(LINE))
    else:
        assert points(desk)[:3] == pytest.approx(np.array(LINE))


def test_a_line_whose_beginning_was_undone_stands_alone(view: PlanView, hand: Hand, desk: Desk) -> None:
    desk.session.apply("Draw line", lambda before: edits.draw_line(before, LINE))
    draw(view)
    hand.click(LINE[-1], (100.0, 300.0))
    desk.session.undo()
    view.grab()
    hand.key(Qt.Key.Key_Return)
    assert points(desk) == pytest.approx(np.array([LINE[-1], (100.0, 300.0)]), abs=0.6)


def test_the_gap_of_a_ring_is_closed(view: PlanView, hand: Hand, desk: Desk) -> None:
    desk.session.apply("Draw line", lambda before: edits.draw_line(before, LINE))
    draw(view)
    hand.click(LINE[-1], (150.0, 200.0), LINE[0])
    assert points(desk)[0] == pytest.approx(points(desk)[-1])
    assert len(points(desk)) == 5


@pytest.mark.parametrize(
    ("choice", "count"), [("Replace the line", 2), ("Join to the line", 5), ("Drop the new one", 3)]
)
def test_another_line_never_replaces_silently(
    view: PlanView, hand: Hand, desk: Desk, told: list[Notice], choice: str, count: int
) -> None:
    desk.session.apply("Draw line", lambda before: edits.draw_line(before, LINE))
    before = desk.session.project
    tool = draw(view)
    hand.click((300.0, 100.0), (320.0, 200.0))
    hand.key(Qt.Key.Key_Return)
    assert desk.session.project is before
    remedy(told, choice)
    assert len(points(desk)) == count
    assert tool.line.is_empty
    if count == 5:
        assert points(desk)[3:] == pytest.approx(np.array([[300, 100], [320, 200]]), abs=0.6)


def test_the_wire_follows_and_each_click_takes_a_piece(view: PlanView, hand: Hand, desk: Desk, until: Until) -> None:
    tool = wire(view)
    hand.click(on_circle(0.0, RADIUS + 2))
    for turn in (0.15, 0.3, 0.45):
        until(lambda: tool.is_ready)
        hand.move(on_circle(turn))
        assert tool._cursor is not None
        following = tool._following(tool._cursor)
        assert following is not None
        assert off_circle(following[1:]) < 1.5
        view.grab()
        hand.click(on_circle(turn))
    hand.key(Qt.Key.Key_Return)
    until(lambda: desk.session.project.trace is not None)
    assert off_circle(points(desk)) < 0.5
    assert points(desk)[-1] == pytest.approx(on_circle(0.45), abs=5)
    length = float(np.hypot(*np.diff(points(desk), axis=0).T).sum())
    assert length == pytest.approx(2 * np.pi * RADIUS * 0.45, rel=0.02)
    assert np.hypot(*np.diff(points(desk), axis=0).T).min() > 0.2


def test_shift_and_f_switch_to_free_clicks_in_mid_line(view: PlanView, hand: Hand, desk: Desk, until: Until) -> None:
    tool = wire(view)
    hand.click(on_circle(0.0))
    until(lambda: tool.is_ready)
    hand.click(on_circle(0.1))
    hand.click((330.0, 330.0), held=SHIFT)
    hand.key(Qt.Key.Key_F)
    assert tool.is_free
    hand.click((350.0, 350.0))
    hand.key(Qt.Key.Key_F)
    hand.key(Qt.Key.Key_Return)
    until(lambda: desk.session.project.trace is not None)
    assert points(desk)[-2:] == pytest.approx(np.array([[330, 330], [350, 350]]), abs=0.6)


def test_a_piece_of_wire_is_taken_back_at_once(view: PlanView, hand: Hand, desk: Desk, until: Until) -> None:
    tool = wire(view)
    hand.click(on_circle(0.0))
    until(lambda: tool.is_ready)
    hand.click(on_circle(0.1))
    until(lambda: tool.is_ready)
    assert len(tool.line.points) > 10
    hand.key(Qt.Key.Key_Backspace)
    assert len(tool.line.points) == 1
    hand.key(Qt.Key.Key_Escape)
    assert not tool.line.is_empty
    until(lambda: not desk.runner.jobs)
    assert desk.session.project.trace is None


def test_two_clicks_trace_the_line_and_it_can_be_undone(view: PlanView, hand: Hand, desk: Desk, until: Until) -> None:
    before = desk.session.project
    view.set_tool("auto_trace")
    hand.click(on_circle(0.02), on_circle(0.4))
    view.grab()
    until(lambda: desk.session.project.trace is not None)
    assert off_circle(points(desk)) < 0.2
    assert desk.session.undo_label == "Trace line"
    tool = view.tool("auto_trace")
    assert isinstance(tool, AutoTraceTool)
    assert tool.can_look_for_loops
    desk.session.undo()
    assert desk.session.project is before


def test_a_point_on_the_way_sends_the_trace_around(view: PlanView, hand: Hand, desk: Desk, until: Until) -> None:
    view.set_tool("auto_trace")
    hand.click(on_circle(0.02))
    hand.click(on_circle(0.3), on_circle(0.6), held=SHIFT)
    assert desk.session.project.trace is None
    assert not desk.runner.jobs
    hand.click(on_circle(0.85))
    until(lambda: desk.session.project.trace is not None)
    length = float(np.hypot(*np.diff(points(desk), axis=0).T).sum())
    assert length == pytest.approx(2 * np.pi * RADIUS * 0.83, rel=0.02)


def test_esc_stops_a_trace_and_keeps_the_clicks(view: PlanView, hand: Hand, desk: Desk, until: Until) -> None:
    view.set_tool("auto_trace")
    hand.click(on_circle(0.02), on_circle(0.4))
    hand.key(Qt.Key.Key_Escape)
    until(lambda: not desk.runner.jobs)
    assert desk.session.project.trace is None
    assert view.tool_name == "auto_trace"
    hand.key(Qt.Key.Key_Return)
    until(lambda: desk.session.project.trace is not None)


def test_clicks_off_the_picture_are_told(
    view: PlanView, hand: Hand, desk: Desk, told: list[Notice], until: Until
) -> None:
    view.set_tool("auto_trace")
    hand.click((-15.0, -15.0), on_circle(0.4))
    until(lambda: bool(told))
    assert "outside the picture" in told[-1].sentence
    assert desk.session.project.trace is None


def test_two_edges_give_their_middle(view: PlanView, hand: Hand, desk: Desk, until: Until) -> None:
    view.set_tool("two_edges")
    for radius in (110.0, 130.0):
        for turn in np.linspace(0.1, 0.4, 13):
            hand.click(on_circle(float(turn), radius), held=SHIFT)
        hand.key(Qt.Key.Key_Return)
        view.grab()
    until(lambda: desk.session.project.trace is not None)
    assert off_circle(points(desk)[3:-3]) < 1.5
    assert desk.session.project.trace is not None
    assert desk.session.project.trace.line_width_px == pytest.approx(20, abs=2)


def test_taking_back_goes_from_the_second_edge_to_the_first(
    view: PlanView, hand: Hand, desk: Desk, until: Until
) -> None:
    view.set_tool("two_edges")
    hand.click((100.0, 100.0), (200.0, 100.0), held=SHIFT)
    hand.key(Qt.Key.Key_Return)
    hand.click((100.0, 120.0), held=SHIFT)
    view.take_back()
    view.take_back()
    view.take_back()
    hand.click((210.0, 100.0), held=SHIFT)
    hand.key(Qt.Key.Key_Return)
    hand.click((100.0, 120.0), (210.0, 120.0), held=SHIFT)
    hand.key(Qt.Key.Key_Return)
    until(lambda: desk.session.project.trace is not None)
    assert points(desk)[:, 1] == pytest.approx(np.full(len(points(desk)), 110.0), abs=1.0)

"""The rows of tools, view and line: names, keys, and what they do."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtWidgets import QWidget

from bobdesk.project import edits
from bobdesk.ui.actions.action import Action
from bobdesk.ui.actions.action_set import ActionSet
from bobdesk.ui.actions.line_actions import LineActions
from bobdesk.ui.actions.tool_actions import ToolActions
from bobdesk.ui.actions.view_actions import ViewActions
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.view import PlanView
from tests.ui.plan_view.made_view import Hand

LINE = [(50.0, 50.0), (150.0, 60.0), (250.0, 50.0), (350.0, 60.0)]


@pytest.fixture
def actions(view: PlanView, desk: Desk, window: QWidget) -> ActionSet:
    desk.session.apply("Draw line", lambda before: edits.draw_line(before, LINE))
    tables: tuple[tuple[Action, ...], ...] = (
        ToolActions(desk, view, window).table(),
        ViewActions(desk, view, window).table(),
        LineActions(desk, view, window).table(),
    )
    made = ActionSet([row for table in tables for row in table], desk.settings, window, view)
    made.refresh()
    return made


def test_no_two_actions_have_the_same_key_and_letters_act_on_the_canvas_alone(actions: ActionSet) -> None:
    keys = [key for row in actions.table for key in row.keys]
    assert len(keys) == len(set(keys))
    for row in actions.table:
        assert row.tip
        if any(len(key) == 1 for key in row.keys):
            assert row.scope == "canvas"


def test_every_tool_has_a_row_and_is_checked_while_in_hand(actions: ActionSet, view: PlanView) -> None:
    for name in view.tools.names:
        actions[f"tool_{name}"].trigger()
        assert view.tool_name == name
        assert actions[f"tool_{name}"].isChecked()
        assert actions[f"tool_{name}"].objectName() == f"tool_{name}"


def test_vertices_are_inserted_deleted_and_selected(actions: ActionSet, view: PlanView, hand: Hand, desk: Desk) -> None:
    def count() -> int:
        trace = desk.session.project.trace
        assert trace is not None
        return len(trace.points)

    hand.move((100.0, 56.0))
    actions["insert_vertex"].trigger()
    assert count() == 5
    assert desk.selection.vertices == (1,)
    actions["delete_selected"].trigger()
    assert count() == 4
    actions["select_all_vertices"].trigger()
    assert desk.selection.vertices == (0, 1, 2, 3)
    before = desk.session.project
    actions["delete_selected"].trigger()
    assert desk.session.project is before
    actions["delete_line"].trigger()
    assert desk.session.project.trace is None


def test_the_line_is_reversed_and_flags_go_back_to_its_ends(actions: ActionSet, desk: Desk) -> None:
    actions["reverse_line"].trigger()
    trace = desk.session.project.trace
    assert trace is not None
    assert tuple(trace.points[0]) == LINE[-1]
    desk.session.apply("x", lambda before: edits.set_start(before, 20.0))
    desk.session.apply("x", lambda before: edits.cut_final_climb(before, 100.0))
    actions.refresh()
    actions["keep_final_climb"].trigger()
    actions["whole_line"].trigger()
    assert desk.session.project.extent.start == 0
    assert desk.session.project.extent.cut_off is None


def test_layers_zoom_and_loupe(actions: ActionSet, view: PlanView) -> None:
    scale: Callable[[], float] = lambda: view.frame_now().scale  # noqa: E731
    fitted = scale()
    actions["zoom_in"].trigger()
    assert scale() > fitted
    actions["zoom_out"].trigger()
    actions["fit_selection"].trigger()
    actions["fit_all"].trigger()
    assert scale() == pytest.approx(fitted)
    actions["layer_trace"].trigger()
    assert not view.is_layer_shown("trace")
    actions["loupe"].trigger()
    assert not view.is_loupe_shown()

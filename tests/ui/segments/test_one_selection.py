"""What a clicked boundary selects, and that every operation acts on what is seen to be selected."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from bobdesk.ui.panels.segments_panel import SegmentsPanel
from bobdesk.ui.plan_view.view import PlanView
from bobdesk.ui.segments.operations import operations
from bobdesk.ui.segments.segments_table import SegmentsTable
from bobdesk.ui.strips.strip_stack import StripStack
from tests.ui.segments.test_boundaries_tool import at
from tests.ui.segments.test_strips import place


@pytest.fixture(params=["plan", "strip"])
def click_boundary(request, desk, now, shown):
    """Return what clicks a boundary on the plan, or on a strip."""
    made = shown(PlanView(desk), 1000, 800) if request.param == "plan" else shown(StripStack(desk), 1000, 330)
    if request.param == "plan":
        made.show_step("Segments")
        made.fit_all()
        made.grab()

    def click(boundary):
        end = now.segments[boundary].end
        if request.param == "plan":
            QTest.mouseClick(made.viewport(), Qt.MouseButton.LeftButton, pos=at(made, desk, now, end))
        else:
            QTest.mouseClick(made.curvature, Qt.MouseButton.LeftButton, pos=place(made.curvature, end))

    return click


@pytest.fixture
def table(desk, now, qtbot):
    made = SegmentsTable(desk)
    qtbot.addWidget(made)
    made.show()
    return made


def rows(table):
    return sorted(table._row_of(index.row()) for index in table.selectionModel().selectedRows())


def test_a_clicked_boundary_selects_both_its_segments_everywhere(desk, now, click_boundary, table):
    operations(desk).select(9, station=now.segments[9].start + 1)
    click_boundary(3)
    assert desk.selection.boundary == 3
    assert desk.selection.segments == (3, 4)
    assert desk.selection.station == now.segments[3].end
    assert rows(table) == [3, 4]


def test_lock_and_flip_act_on_both_sides_of_a_clicked_boundary(desk, now, click_boundary, table):
    do = operations(desk)
    do.select(9)
    click_boundary(3)
    do.lock()
    assert [index for index, one in enumerate(now.segments) if one.locked] == [3, 4]
    do.lock()
    before = [one.kind for one in now.segments]
    do.flip()
    assert [index for index, one in enumerate(now.segments) if one.kind != before[index]] == [3, 4]


def test_merge_takes_the_clicked_boundary_away(desk, now, click_boundary, table):
    do = operations(desk)
    do.select(9)
    end = now.segments[4].end
    click_boundary(3)
    do.merge()
    assert len(now.segments) == 16
    assert now.segments[3].end == end
    assert desk.selection.boundary is None
    assert rows(table) == [3]


def test_split_on_a_clicked_boundary_says_where_to_click(desk, now, click_boundary, told):
    before = desk.session.project
    click_boundary(3)
    operations(desk).split()
    assert "There is a boundary here already" in told[-1]
    assert desk.session.project is before


def test_other_segments_deselect_the_boundary(desk, now, click_boundary, table):
    click_boundary(3)
    table.selectRow(11)
    assert desk.selection.segments == (11,)
    assert desk.selection.boundary is None
    click_boundary(3)
    operations(desk).select_next(1)
    assert desk.selection.segments == (5,)
    assert desk.selection.boundary is None


def test_the_cursor_goes_with_a_nudged_boundary(desk, now, click_boundary):
    click_boundary(3)
    operations(desk).nudge(0.5)
    assert desk.selection.station == now.segments[3].end


def test_a_split_leaves_the_later_half_and_the_new_boundary_selected(desk, now, table):
    desk.selection.station = 0.5 * (now.segments[3].start + now.segments[3].end)
    operations(desk).split()
    assert (desk.selection.segments, desk.selection.boundary) == ((4,), 3)
    before = [one.kind for one in now.segments]
    operations(desk).flip()
    assert [index for index, one in enumerate(now.segments) if one.kind != before[index]] == [4]


def test_the_panel_says_what_is_selected(desk, now, window, qtbot):
    from bobdesk.ui.actions.action_set import ActionSet
    from bobdesk.ui.actions.segment_actions import SegmentActions

    panel = SegmentsPanel(desk, ActionSet(SegmentActions(desk, window).table(), desk.settings, window, window))
    qtbot.addWidget(panel)
    operations(desk).select_boundary(3)
    assert panel._at.text().startswith("Boundary at ")
    assert panel._at.text().endswith("between segments 4 and 5")
    operations(desk).select_nothing()
    operations(desk).select(2)
    assert "segment 3" in panel._at.text()

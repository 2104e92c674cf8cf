"""Boundaries on the plan, by mouse and keys; plan, strips and table never disagree."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest

from bobdesk.project import derive
from bobdesk.ui.plan_view.held_picture import HeldPicture
from bobdesk.ui.plan_view.line_on_plan import LineOnPlan
from bobdesk.ui.plan_view.view import PlanView
from bobdesk.ui.segments.automatic_operations import automatic_operations
from bobdesk.ui.segments.operations import operations
from bobdesk.ui.segments.segments_table import SegmentsTable
from bobdesk.ui.strips.strip_stack import StripStack
from bobdesk.ui.theme import colours
from tests.ui.segments.test_strips import move


@pytest.fixture
def view(desk, now, shown):
    made = shown(PlanView(desk), 1000, 800)
    made.show_step("Segments")
    made.fit_all()
    made.grab()
    return made


def at(view, desk, now, station):
    line = LineOnPlan(now).on_screen(desk.session.project, view.frame_now())
    x, y = line.at(np.array([station]))[0]
    return QPoint(round(x), round(y))


def drag(view, start, end, modifier=Qt.KeyboardModifier.NoModifier, drop=True):
    port = view.viewport()
    QTest.mousePress(port, Qt.MouseButton.LeftButton, modifier, start)
    for part in (0.3, 0.7, 1.0):
        between = QPointF(start) + part * (QPointF(end) - QPointF(start))
        move(port, between.toPoint(), Qt.MouseButton.LeftButton, modifier)
    if drop:
        QTest.mouseRelease(port, Qt.MouseButton.LeftButton, modifier, end)


def test_the_step_takes_the_tool_and_shows_the_segments(view):
    assert view.tool_name == "boundaries"
    assert view.is_layer_shown("segments")
    view.show_step("Centreline")
    assert view.tool_name == "select"
    assert not view.is_layer_shown("segments")


def test_a_boundary_is_dragged_along_the_line(desk, now, view):
    before, end = desk.session.project, now.segments[3].end
    alt = Qt.KeyboardModifier.AltModifier
    drag(view, at(view, desk, now, end), at(view, desk, now, end + 12), alt, drop=False)
    assert desk.session.project is before
    assert now.segments[3].end == pytest.approx(end + 12, abs=1.5)
    view.grab()
    QTest.mouseRelease(view.viewport(), Qt.MouseButton.LeftButton, alt, at(view, desk, now, end + 12))
    assert desk.session.undo_label == "Move boundary"
    desk.session.undo()
    assert desk.session.project is before


def test_escape_puts_it_back(desk, now, view):
    end = now.segments[3].end
    drag(view, at(view, desk, now, end), at(view, desk, now, end + 12), drop=False)
    QTest.keyClick(view, Qt.Key.Key_Escape)
    assert now.segments[3].end == end
    assert view.tool_name == "boundaries"
    QTest.mouseRelease(view.viewport(), Qt.MouseButton.LeftButton, pos=at(view, desk, now, end + 12))
    assert desk.session.undo_label is None


def test_clicks_select_segments_and_a_double_click_splits(desk, now, view):
    middle = [0.5 * (segment.start + segment.end) for segment in now.segments]
    QTest.mouseClick(view.viewport(), Qt.MouseButton.LeftButton, pos=at(view, desk, now, middle[2]))
    assert desk.selection.segments == (2,)
    assert desk.selection.station == pytest.approx(middle[2], abs=1.5)
    shift = Qt.KeyboardModifier.ShiftModifier
    QTest.mouseClick(view.viewport(), Qt.MouseButton.LeftButton, shift, at(view, desk, now, middle[4]))
    assert desk.selection.segments == (2, 3, 4)
    QTest.mouseDClick(view.viewport(), Qt.MouseButton.LeftButton, pos=at(view, desk, now, middle[0]))
    assert len(now.segments) == 18
    assert now.segments[0].end == pytest.approx(middle[0], abs=1.5)


def test_arrows_move_the_boundary_towards_where_they_point(desk, now, view):
    end = now.segments[0].end
    QTest.mouseClick(view.viewport(), Qt.MouseButton.LeftButton, pos=at(view, desk, now, end))
    assert desk.selection.boundary == 0
    x = at(view, desk, now, end + 20).x() - at(view, desk, now, end - 20).x()
    QTest.keyClick(view, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
    moved = now.segments[0].end - end
    assert moved * x > 0
    assert abs(moved) == pytest.approx(10 * view.frame_now().per_screen, rel=1e-6)
    QTest.keyClick(view, Qt.Key.Key_Left, Qt.KeyboardModifier.ShiftModifier)
    assert now.segments[0].end == pytest.approx(end)


def test_delete_merges_at_the_selected_boundary(desk, now, view):
    desk.selection.boundary = 4
    assert view.tool_in_hand().delete()
    assert len(now.segments) == 16


def test_the_selected_segments_are_brought_into_view(desk, now, view):
    whole = view.frame_now().scale
    operations(desk).select(6)
    view.fit_selection()
    assert view.frame_now().scale > 2 * whole
    segment = now.segments[6]
    assert view.viewport().rect().contains(at(view, desk, now, 0.5 * (segment.start + segment.end)))


def looks(desk, now, view, stack, table):
    """What plan, strips and table show of each segment: its kind by pixels and by words, and its ends by words."""
    view.viewport().repaint()
    plan, strips = view.viewport().grab().toImage(), stack.elevation.grab().toImage()
    of = colours()
    found = []
    for row, segment in enumerate(now.segments):
        station = segment.start + 0.37 * segment.length
        near = []
        for share in (0.3, 0.4, 0.5, 0.6, 0.7):
            place = at(view, desk, now, segment.start + share * segment.length)
            near += [plan.pixelColor(place + QPoint(dx, dy)).name() for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
        on_plan = "curve" if near.count(of.curve) > near.count(of.straight) else "straight"
        on = stack.elevation.geometry_now()
        pixel = strips.pixelColor(QPoint(round(on.x(station)) + 1, round(on.area.bottom()) - 4)).name()
        on_strip = "straight" if pixel == of.base else "curve"
        model = table.segments
        in_table = model.index(row, model.column("kind")).data(), model.index(row, model.column("to")).data()
        found.append((on_plan, on_strip, *in_table))
    return found


def test_plan_strips_and_table_never_disagree_after_any_operation(desk, now, view, qtbot, idle):
    stack, table = StripStack(desk), SegmentsTable(desk)
    for widget in (stack, table):
        qtbot.addWidget(widget)
        widget.resize(1200, 400)
        widget.show()
    do, find = operations(desk), automatic_operations(desk)

    def agree():
        idle()
        desk.selection.clear()
        segments = derive.segments(desk.session.project).needed()
        assert table.model().rowCount() == len(segments)
        number = desk.quantities.length
        wanted = [(one.kind, one.kind, one.kind, number(one.end, unit=False)) for one in segments]
        assert looks(desk, now, view, stack, table) == wanted

    agree()
    for act in (
        lambda: do.flip_one(4),
        lambda: (do.select(6, station=now.segments[6].start + 10), do.split()),
        lambda: do.flip_one(7),
        lambda: (do.select(2), do.select(3, add=True), do.merge()),
        lambda: do.move_boundary(5, now.segments[5].end - 3),
        lambda: (do.select(1), do.lock()),
        lambda: find.change_settings(count=11),
        find.detect_again,
        lambda: find.change_settings(threshold=0.02, count=None),
        find.back_to_automatic,
        desk.session.undo,
        desk.session.undo,
        desk.session.undo,
        desk.session.redo,
    ):
        act()
        agree()


def test_an_undo_in_mid_drag_lets_go_of_the_boundary(desk, now, view, idle):
    ends = [segment.end for segment in now.segments[:-1]]
    desk.selection.station = 0.5 * (ends[1] + ends[2])
    operations(desk).split()
    idle()
    start = at(view, desk, now, now.segments[4].end)
    drag(view, start, start + QPoint(12, 9), drop=False)
    desk.session.undo()
    before = desk.session.project
    idle()
    move(view.viewport(), start + QPoint(20, 15), Qt.MouseButton.LeftButton)
    view.grab()
    QTest.mouseRelease(view.viewport(), Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, start)
    assert desk.session.project is before
    assert desk.session.redo_label is not None


def pixels(view):
    image = view.viewport().grab().toImage().convertToFormat(QImage.Format.Format_RGB32)
    return np.array(image.constBits()).reshape(image.height(), image.width(), 4)[:, :, :3].astype(int)


@pytest.mark.parametrize("names", ["", "A very long name of a curve"])
def test_what_is_kept_as_a_picture_in_a_drag_is_what_would_be_drawn(desk, now, view, monkeypatch, idle, names):
    do = operations(desk)
    for index, segment in enumerate(now.segments):
        if segment.kind == "curve" and names:
            do.rename(index, names)
    do.set_locked(9, locked=True)
    idle()
    for _ in range(3):
        view.grab()
    start = now.segments[6].end
    alt = Qt.KeyboardModifier.AltModifier
    drag(view, at(view, desk, now, start), at(view, desk, now, start - 15), alt, drop=False)
    by_picture = pixels(view)
    layer = view.layers["segments"]
    assert layer._rest is not None
    monkeypatch.setattr(layer, "_changed", lambda _segments: frozenset())
    monkeypatch.setattr(layer, "_all", HeldPicture())
    drawn = pixels(view)
    # Where two edges meet, blending in two steps rounds otherwise than blending in one.
    assert np.abs(by_picture - drawn).max() <= 6
    QTest.mouseRelease(view.viewport(), Qt.MouseButton.LeftButton, alt, at(view, desk, now, start - 15))

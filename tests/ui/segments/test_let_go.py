"""A drag on a strip or on the plan ends with its ground: Esc, another step, undo, the keyboard elsewhere."""

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from tests.ui.segments.test_boundaries_tool import at
from tests.ui.segments.test_strips import move, place

LEFT = Qt.MouseButton.LeftButton
CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def window(whole_window, until):
    whole_window.go_to("Segments")
    until(lambda: not whole_window.desk.runner.jobs)
    whole_window.view.fit_all()
    return whole_window


@pytest.fixture
def strips(window):
    return window.layout_of_window.strips_dock.widget()


def key(key, modifiers=Qt.KeyboardModifier.NoModifier):
    QTest.keyClick(QApplication.focusWidget(), key, modifiers)


def go_elsewhere(window):
    window.panels._shown["Segments"].automatic.shortest.setFocus()


ENDS = {
    "escape": lambda window: key(Qt.Key.Key_Escape),
    "another step": lambda window: key(Qt.Key.Key_5, CTRL),
    "a step without strips": lambda window: key(Qt.Key.Key_3, CTRL),
    "undo": lambda window: key(Qt.Key.Key_Z, CTRL),
    "the keyboard elsewhere": go_elsewhere,
    "another edit": lambda window: window.desk.session.apply(
        "Note", lambda project: project.__class__(**{**vars(project), "notes": "x"})
    ),
}


def held_drag(widget, start, end):
    QTest.mousePress(widget, LEFT, pos=start)
    for part in (0.4, 1.0):
        move(widget, (QPointF(start) + part * (QPointF(end) - QPointF(start))).toPoint(), LEFT)


def go_on_and_release(widget, at):
    move(widget, at + QPoint(7, 0), LEFT)
    QTest.mouseRelease(widget, LEFT, pos=at + QPoint(7, 0))


def begin(window, strips):
    """Have something to undo, and return the segments now."""
    strips._operations.flip_one(6)
    return strips._now.segments


@pytest.mark.parametrize("end", ENDS)
def test_a_boundary_on_a_strip(window, strips, end, until):
    before = begin(window, strips)
    strip = strips.curvature
    start, target = place(strip, before[4].end), place(strip, before[4].end) + QPoint(25, 0)
    held_drag(strip, start, target)
    assert strips._now.is_preview
    ENDS[end](window)
    assert not strips._now.is_preview
    project = window.desk.session.project
    go_on_and_release(strip, target)
    assert window.desk.session.project is project
    assert window.desk.session.undo_label != "Move boundary"
    until(lambda: not window.desk.runner.jobs)


@pytest.mark.parametrize("end", ENDS)
def test_the_threshold_on_a_strip(window, strips, end, until):
    begin(window, strips)
    strip = strips.curvature
    on = strip.geometry_now()
    start = QPoint(round(on.x(12.0)), round(on.y(strips._now.threshold)))
    target = start - QPoint(0, 14)
    held_drag(strip, start, target)
    assert strips._now.is_trying_threshold
    ENDS[end](window)
    assert not strips._now.is_trying_threshold
    project = window.desk.session.project
    go_on_and_release(strip, target)
    until(lambda: not window.desk.runner.jobs)
    assert window.desk.session.project is project


@pytest.mark.parametrize("end", ENDS)
def test_a_boundary_on_the_plan(window, strips, end, until):
    before = begin(window, strips)
    view, now = window.view, strips._now
    view.setFocus()
    start = at(view, window.desk, now, before[4].end)
    target = at(view, window.desk, now, before[4].end + 20)
    held_drag(view.viewport(), start, target)
    assert now.is_preview
    ENDS[end](window)
    assert not now.is_preview
    project = window.desk.session.project
    go_on_and_release(view.viewport(), target)
    assert window.desk.session.project is project
    until(lambda: not window.desk.runner.jobs)


@pytest.mark.parametrize("end", [end for end in ENDS if end != "the keyboard elsewhere"])
def test_a_vertex_on_the_plan(window, end, until):
    session, view = window.desk.session, window.view
    session.apply("Note", lambda project: project.__class__(**{**vars(project), "notes": "y"}))
    window.go_to("Centreline")
    view.set_tool("select")
    until(lambda: not window.desk.runner.jobs)
    view.setFocus()
    points = session.project.trace.points
    view.show_place(*points[40].tolist())
    view.zoom_by(8.0)
    frame = view.frame_now()
    start = frame.point(tuple(points[40].tolist())).toPoint()
    held_drag(view.viewport(), start, start + QPoint(30, 20))
    ENDS["another step" if end == "a step without strips" else end](window)
    project = session.project
    go_on_and_release(view.viewport(), start + QPoint(30, 20))
    assert session.project is project
    until(lambda: not window.desk.runner.jobs)


def test_a_pan_that_is_let_go_of_stays_where_it_is(window, strips):
    strips.axis.show(100.0, 400.0)
    strip = strips.gradient
    start = place(strip, 250.0)
    held_drag(strip, start, start + QPoint(40, 0))
    low = strips.axis.low
    assert low < 100.0
    key(Qt.Key.Key_5, CTRL)
    assert strips.axis.low == low


def test_escape_again_and_again_leaves_the_tool_of_the_step_in_hand(window):
    view = window.view
    view.setFocus()
    for _ in range(3):
        key(Qt.Key.Key_Escape)
        assert view.tool_name == "boundaries"
    view.set_tool("measure")
    key(Qt.Key.Key_Escape)
    key(Qt.Key.Key_Escape)
    assert view.tool_name == "boundaries"
    window.go_to("Centreline")
    view.set_tool("measure")
    view.setFocus()
    key(Qt.Key.Key_Escape)
    key(Qt.Key.Key_Escape)
    assert view.tool_name == "select"


def test_a_threshold_dragged_to_the_ground_is_the_same_on_strip_and_in_the_panel(window, strips, until):
    strip = strips.curvature
    on = strip.geometry_now()
    start = QPoint(round(on.x(30.0)), round(on.y(strips._now.threshold)))
    QTest.mousePress(strip, LEFT, Qt.KeyboardModifier.NoModifier, start)
    for y in (20, 60, 100):
        move(strip, start + QPoint(0, y))
    QTest.mouseRelease(strip, LEFT, Qt.KeyboardModifier.NoModifier, start + QPoint(0, 100))
    until(lambda: window.desk.session.project.segmentation.threshold is not None and not window.desk.runner.jobs)
    threshold = window.desk.session.project.segmentation.threshold
    assert window.panels._shown["Segments"].automatic.threshold.value() == threshold
    assert strip.levels["threshold"].label.startswith(f"threshold {threshold:.4f} 1/m")

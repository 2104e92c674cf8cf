"""Looking at the plan: fit, zoom, pan in every tool, layers, loupe, painting."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication, QMenu
from pytestqt.qtbot import QtBot

from bobdesk.plan.control_points import ControlPoint, KnownDistance
from bobdesk.project import edits
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.furniture import round_length
from bobdesk.ui.plan_view.view import PlanView
from tests.project.made_projects import coordinates_project, ready_project
from tests.ui.plan_view.made_view import LEFT, MIDDLE, NONE, Hand, on_circle


def shown(view: PlanView) -> tuple[float, float, float]:
    frame = view.frame_now()
    return frame.scale, frame.left, frame.top


def test_a_new_document_is_shown_whole_once_and_pixel_centres_lie_at_whole_numbers(view: PlanView) -> None:
    frame = view.frame_now()
    assert frame.scale == pytest.approx(0.9 * 800 / 400)
    middle = frame.point((199.5, 199.5))
    assert (middle.x(), middle.y()) == (pytest.approx(400, abs=1), pytest.approx(400, abs=1))


def test_an_edit_keeps_the_zoom(view: PlanView, desk: Desk) -> None:
    view.zoom_by(2.0)
    before = shown(view)
    desk.session.apply("Draw", lambda project: edits.draw_line(project, [[10, 10], [50, 60], [90, 80]]))
    assert shown(view) == before


def test_the_wheel_zooms_at_the_cursor_and_nothing_creeps(view: PlanView, hand: Hand) -> None:
    place = on_circle(0.1)
    at = view.frame_now().point(place)
    for notches in (1, 1, 1, 1, -1, -1, 1, -1, -1, -1):
        hand.wheel(place, notches)
        now = view.frame_now().point(place)
        assert abs(now.x() - at.x()) <= 1.01
        assert abs(now.y() - at.y()) <= 1.01
    assert view.frame_now().scale == pytest.approx(1.8)


def test_zoom_has_limits(view: PlanView) -> None:
    view.zoom_by(1e9)
    assert view.frame_now().scale <= 64
    view.zoom_by(1e-12)
    assert view.frame_now().scale >= 0.2
    view.zoom_to_pixels()
    assert view.frame_now().scale * view.devicePixelRatioF() == pytest.approx(1.0)


@pytest.mark.parametrize("name", ["select", "draw", "live_wire", "auto_trace", "two_edges", "set_start", "measure"])
def test_middle_drag_pans_in_every_tool_also_in_mid_work(view: PlanView, hand: Hand, name: str) -> None:
    view.set_tool(name)
    if name != "select":
        hand.click(on_circle(0.0))
    before = view.frame_now().point((0.0, 0.0))
    hand.drag((100, 100), [(110, 105), (150, 130)], button=MIDDLE)
    after = view.frame_now().point((0.0, 0.0))
    assert after.x() - before.x() == pytest.approx(50 * 1.8, abs=1.5)
    assert after.y() - before.y() == pytest.approx(30 * 1.8, abs=1.5)
    view.tool(name).reset()


def test_space_and_drag_pans_while_drawing_and_places_nothing(view: PlanView, hand: Hand, desk: Desk) -> None:
    view.set_tool("draw")
    hand.click(on_circle(0.0), on_circle(0.1))
    before = view.frame_now().point((0.0, 0.0))
    QApplication.sendEvent(view, QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_Space, NONE))
    hand.drag((100, 100), [(140, 100)])
    QApplication.sendEvent(view, QKeyEvent(QEvent.Type.KeyRelease, Qt.Key.Key_Space, NONE))
    assert view.frame_now().point((0.0, 0.0)).x() - before.x() == pytest.approx(72, abs=1.5)
    hand.click(on_circle(0.2))
    hand.key(Qt.Key.Key_Return)
    trace = desk.session.project.trace
    assert trace is not None
    assert len(trace.points) == 3


def test_show_place_and_fit_selection(view: PlanView, desk: Desk) -> None:
    view.show_place(100.0, 50.0)
    middle = view.frame_now().point((100.0, 50.0))
    assert (middle.x(), middle.y()) == (pytest.approx(400, abs=1), pytest.approx(400, abs=1))
    desk.session.apply("Draw", lambda project: edits.draw_line(project, [[10, 10], [50, 60], [390, 380]]))
    desk.selection.vertices = (0, 1)
    view.fit_selection()
    assert view.frame_now().scale > 3
    desk.selection.vertices = ()
    view.fit_selection()
    assert view.frame_now().scale < 3


def test_the_mouse_is_told_in_plan_units(view: PlanView, hand: Hand, qtbot: QtBot) -> None:
    with qtbot.waitSignal(view.pointer_moved) as got:
        hand.move((120.0, 80.0))
    assert got.args is not None
    assert got.args[0] == (pytest.approx(120, abs=0.5), pytest.approx(80, abs=0.5))
    with qtbot.waitSignal(view.pointer_moved) as got:
        QApplication.sendEvent(view.viewport(), QEvent(QEvent.Type.Leave))
    assert got.args == [None]


def test_coordinates_are_shown_with_north_up(view: PlanView, desk: Desk) -> None:
    project = coordinates_project()
    desk.session.open(project, None)
    assert project.source is not None
    points = project.source.polyline.vertices
    frame = view.frame_now()
    highest, lowest = points[points[:, 1].argmax()], points[points[:, 1].argmin()]
    assert frame.point(tuple(highest)).y() < frame.point(tuple(lowest)).y()
    there = view.pointer_at(frame.point(tuple(highest)))
    assert there.plan == pytest.approx(tuple(highest))
    for layer in ("segments", "stations"):
        view.set_layer_shown(layer, True)
    view.grab()


def test_layers_are_remembered(view: PlanView, desk: Desk) -> None:
    assert view.is_layer_shown("trace")
    view.set_layer_shown("trace", False)
    assert not view.is_layer_shown("trace")
    assert not PlanView(desk).is_layer_shown("trace")


def test_all_layers_paint_at_every_zoom(view: PlanView, desk: Desk, hand: Hand, until) -> None:  # type: ignore[no-untyped-def]
    ready = ready_project()
    desk.session.apply("x", lambda before: edits.draw_line(before, [on_circle(t) for t in np.linspace(0, 0.9, 60)]))
    for index, place in enumerate([(10, 10), (390, 20), (200, 380)]):
        point = ControlPoint(place[0], place[1], 0.5 * place[0] + index, -0.5 * place[1], str(index + 1))
        desk.session.apply("x", lambda before, point=point: edits.add_control_point(before, point))
    desk.session.apply("x", lambda before: edits.add_known_distance(before, KnownDistance((20, 20), (220, 20), 100.0)))
    desk.session.apply("x", lambda before: edits.add_check_distance(before, KnownDistance((20, 40), (220, 60), 101.0)))
    desk.session.apply("x", lambda before: edits.set_start(before, 30.0))
    desk.session.apply("x", lambda before: edits.cut_final_climb(before, 500.0))
    desk.session.apply("x", lambda before: edits.say_which_line(before, "left edge", 2.0))
    desk.selection.vertices, desk.selection.segments, desk.selection.station = (3, 4), (0,), 40.0
    for layer in ("segments", "stations", "centreline"):
        view.set_layer_shown(layer, True)
    view.grab()
    until(lambda: not desk.runner.jobs)
    for factor in (0.2, 5.0, 8.0, 4.0):
        view.zoom_by(factor)
        view.grab()
    assert ready.trace is not None


def test_the_loupe_helps_while_points_are_placed_and_steps_aside(view: PlanView, hand: Hand) -> None:
    loupe = view._loupe
    hand.move((200, 200))
    assert not loupe.isVisible()
    view.set_tool("draw")
    hand.move((200, 200))
    assert loupe.isVisible()
    right = loupe.x()
    hand.move((380, 30))
    assert loupe.x() < right
    view.grab()
    view.show_loupe(False)
    assert not loupe.isVisible()


def test_esc_puts_the_tool_down_and_the_context_menu_is_the_windows(view: PlanView, hand: Hand) -> None:
    view.set_tool("measure")
    hand.key(Qt.Key.Key_Escape)
    assert view.tool_name == "select"
    made: list[QMenu] = []

    def maker() -> QMenu:
        made.append(QMenu(view))
        return made[-1]

    view.context_menu_maker = maker
    at = QPointF(view.viewport().rect().center()).toPoint()
    from PySide6.QtGui import QContextMenuEvent

    event = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, at, view.mapToGlobal(at))
    QApplication.sendEvent(view.viewport(), event)
    assert len(made) == 1
    made[0].close()
    assert LEFT != MIDDLE


def test_round_lengths() -> None:
    assert [round_length(value) for value in (1.0, 1.9, 2.0, 7.0, 30.0, 0.04)] == [1, 1, 2, 5, 20, pytest.approx(0.02)]


def test_an_empty_view_paints_without_scipy_and_shapely() -> None:
    code = (
        "import sys;from PySide6.QtWidgets import QApplication;a=QApplication([]);"
        "from pathlib import Path;import tempfile;"
        "from bobdesk.ui.desk import Desk;from bobdesk.ui.session import Session;"
        "from bobdesk.ui.selection import Selection;from bobdesk.ui.runner import Runner;"
        "from bobdesk.ui.plan_picture import PlanPicture;from bobdesk.ui.notices import Notices;"
        "from bobdesk.ui.settings import Settings;from bobdesk.ui.quantities import Quantities;"
        "from bobdesk.ui.plan_view.view import PlanView;"
        "s=Settings(Path(tempfile.mkdtemp())/'s.ini');e=Session();r=Runner();"
        "v=PlanView(Desk(e,Selection(),PlanPicture(e,r),r,Notices(),s,Quantities(s)));v.show();v.grab();"
        "print(sorted({'scipy','shapely','pyqtgraph'}&set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60)
    assert done.stdout.strip() == "[]", done.stderr
    assert Project().picture is None

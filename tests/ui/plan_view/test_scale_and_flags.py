"""Control points, known distances, measuring, flags: clicks, drags and small forms."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from bobdesk.plan.control_points import ControlPoint
from bobdesk.project import edits
from bobdesk.ui.desk import Desk
from bobdesk.ui.notices import Notice
from bobdesk.ui.plan_view.popup import Popup
from bobdesk.ui.plan_view.view import PlanView
from tests.project.made_projects import coordinates_project
from tests.ui.plan_view.made_view import Hand

LINE = [(50.0, 50.0), (150.0, 50.0), (350.0, 50.0)]


def popup(view: PlanView) -> Popup:
    found = [one for one in view.viewport().findChildren(Popup) if one.isVisible()]
    assert len(found) == 1
    return found[0]


def type_in(view: PlanView, *values: str) -> None:
    form = popup(view)
    for box, value in zip(form.boxes, values, strict=True):
        box.setFocus()
        box.selectAll()
        QTest.keyClicks(box, value)
    QTest.keyClick(form.boxes[-1], Qt.Key.Key_Return)


def test_a_click_and_two_numbers_make_a_control_point(view: PlanView, hand: Hand, desk: Desk) -> None:
    before = desk.session.project
    view.set_tool("calibrate")
    hand.click((100.0, 80.0))
    view.grab()
    type_in(view, "12.5", "-7")
    (point,) = desk.session.project.control_points
    assert (point.x_px, point.y_px) == (pytest.approx(100, abs=0.6), pytest.approx(80, abs=0.6))
    assert (point.x_m, point.y_m, point.name) == (12.5, -7.0, "1")
    assert desk.selection.control_point == 0
    desk.session.undo()
    assert desk.session.project is before
    assert desk.selection.control_point is None


def test_esc_drops_the_form_and_places_nothing(view: PlanView, hand: Hand, desk: Desk) -> None:
    view.set_tool("calibrate")
    hand.click((100.0, 80.0))
    QTest.keyClick(popup(view).boxes[0], Qt.Key.Key_Escape)
    assert desk.session.project.control_points == ()
    assert view.tool_name == "calibrate"


def test_control_points_are_dragged_nudged_and_deleted(view: PlanView, hand: Hand, desk: Desk) -> None:
    desk.session.apply("x", lambda before: edits.add_control_point(before, ControlPoint(100, 80, 0, 0, "A")))
    view.set_tool("calibrate")
    hand.drag((102, 80), [(110, 90), (122, 100)])
    point = desk.session.project.control_points[0]
    assert (point.x_px, point.y_px) == (pytest.approx(120, abs=0.6), pytest.approx(100, abs=0.6))
    assert desk.session.undo_label == "Move control point"
    hand.key(Qt.Key.Key_Right)
    assert desk.session.project.control_points[0].x_px == pytest.approx(point.x_px + view.frame_now().per_screen)
    assert view.tool_in_hand().delete()
    assert desk.session.project.control_points == ()
    assert not view.tool_in_hand().delete()


def test_two_clicks_and_a_length_make_the_scale(view: PlanView, hand: Hand, desk: Desk) -> None:
    from bobdesk.project import derive

    view.set_tool("known_distance")
    hand.click((50.0, 300.0), (250.0, 300.0))
    view.grab()
    type_in(view, "100")
    (known,) = desk.session.project.known_distances
    assert known.length_m == 100
    assert derive.calibration(desk.session.project).needed().metres_per_pixel == pytest.approx(0.5, rel=0.01)
    hand.drag((250, 300), [(200, 300), (150, 300)])
    assert desk.session.project.known_distances[0].end_px[0] == pytest.approx(150, abs=0.6)
    assert desk.session.undo_label == "Move end of distance"


def test_a_length_of_nothing_is_refused_and_the_form_stays(view: PlanView, hand: Hand, desk: Desk) -> None:
    refused: list[str] = []
    desk.session.refused.connect(refused.append)
    view.set_tool("known_distance")
    hand.click((50.0, 300.0), (250.0, 300.0))
    type_in(view, "0")
    assert len(refused) == 1
    assert popup(view).isVisible()
    assert view.take_back()
    assert desk.session.project.known_distances == ()


def test_measuring_says_lengths_and_stores_nothing_unless_told(
    view: PlanView, hand: Hand, desk: Desk, told: list[Notice]
) -> None:
    before = desk.session.project
    view.set_tool("measure")
    hand.click((50.0, 300.0), (150.0, 300.0), (150.0, 350.0))
    assert "90.0°" in view.sentence or "89." in view.sentence or "90." in view.sentence
    assert "150" in view.sentence or "149." in view.sentence
    view.grab()
    hand.key(Qt.Key.Key_Return)
    assert desk.session.project is before
    next(one for one in told[-1].remedies if "check" in one.text).do()
    type_in(view, "25")
    assert desk.session.project.check_distances[0].length_m == 25
    hand.key(Qt.Key.Key_Escape)
    assert view.tool_name == "measure"


def test_flags_snap_to_the_line_and_are_dragged(view: PlanView, hand: Hand, desk: Desk) -> None:
    desk.session.apply("Draw line", lambda before: edits.draw_line(before, LINE))
    drawn = desk.session.project
    view.set_tool("set_start")
    hand.click((100.0, 55.0))
    assert desk.session.project.extent.start == pytest.approx(50, abs=1)
    view.set_tool("set_finish")
    hand.drag((350, 50), [(300, 60), (250, 70)])
    assert desk.session.project.extent.finish == pytest.approx(200, abs=1)
    hand.drag((100, 50), [(110, 50), (130, 50)])
    assert desk.session.project.extent.start == pytest.approx(80, abs=1)
    view.set_tool("cut")
    hand.move((210.0, 50.0))
    view.grab()
    hand.click((210.0, 50.0))
    assert desk.session.project.extent.cut_off == pytest.approx(160, abs=1)
    for _ in range(4):
        desk.session.undo()
    assert desk.session.project is drawn


def test_a_finish_before_the_start_is_refused(view: PlanView, hand: Hand, desk: Desk) -> None:
    refused: list[str] = []
    desk.session.refused.connect(refused.append)
    desk.session.apply("Draw line", lambda before: edits.draw_line(before, LINE))
    view.set_tool("set_start")
    hand.click((200.0, 50.0))
    view.set_tool("set_finish")
    hand.click((100.0, 50.0))
    assert refused
    assert desk.session.project.extent.finish is None


def test_without_a_line_a_flag_is_told(view: PlanView, hand: Hand, told: list[Notice]) -> None:
    view.set_tool("set_start")
    hand.click((100.0, 50.0))
    assert "no line yet" in told[-1].sentence


def test_coordinates_take_flags_and_measures(view: PlanView, hand: Hand, desk: Desk) -> None:
    desk.session.open(coordinates_project(), None)
    source = desk.session.project.source
    assert source is not None
    place = tuple(source.polyline.vertices[len(source.polyline.vertices) // 3])
    view.set_tool("set_start")
    hand.click((float(place[0]), float(place[1])))
    assert desk.session.project.extent.start > 0
    view.set_tool("measure")
    hand.click((float(place[0]), float(place[1])), (float(place[0]) + 50, float(place[1])))
    assert " m" in view.sentence
    assert "px" not in view.sentence

"""Known elevations on the elevation strip, by real mouse events, beside the table that shows the same numbers."""

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from bobdesk.project import edits
from bobdesk.ui.panels.solve_panel import SolvePanel
from bobdesk.ui.solve.result_strips import ResultStrips
from bobdesk.ui.strips.strip_stack import StripStack
from tests.ui.segments.test_strips import drag, move


@pytest.fixture
def table(desk, opened, qtbot, idle):
    panel = SolvePanel(desk)
    qtbot.addWidget(panel)
    panel.resize(430, 1200)
    panel.show()
    idle()
    return panel.known.table


@pytest.fixture
def strip(desk, opened, table, solving, qtbot, idle):
    stack = StripStack(desk)
    ResultStrips(desk, stack)
    qtbot.addWidget(stack)
    stack.resize(1000, 330)
    stack.show()
    qtbot.waitExposed(stack)
    solving.run()
    idle()
    return stack.elevation


def numbers(table):
    model = table.model()
    return [
        tuple(float(model.data(model.index(row, column)).replace(",", "")) for column in range(3))
        for row in range(model.rowCount())
    ]


def at(strip, station, elevation):
    on = strip.geometry_now()
    return QPoint(round(on.x(station)), round(on.y(elevation)))


def menu_texts(strip, point):
    menu = strip.window().menu_at(strip.mapToGlobal(point))
    return menu, {action.text().split(":")[0]: action for action in menu.actions() if action.text()}


def test_a_diamond_is_dragged_in_one_step_and_the_table_follows(desk, strip, table, idle):
    before = desk.session.project.known_elevations[0]
    start = at(strip, before.station, before.elevation)
    end = start + QPoint(60, -15)
    drag(strip, start, end)
    known = desk.session.project.known_elevations[0]
    station, elevation = strip.place_at(end)
    assert known.station == pytest.approx(station, abs=0.01)
    assert known.elevation == pytest.approx(elevation, abs=0.01)
    assert known.tolerance == before.tolerance
    assert numbers(table) == [pytest.approx((known.station, known.elevation, known.tolerance), abs=0.005)]
    assert strip.marks["known"].stations.tolist() == [pytest.approx(known.station)]
    assert desk.session.undo_label == "Drag known elevation"
    desk.session.undo()
    assert desk.session.project.known_elevations == (before,)
    assert numbers(table) == [pytest.approx((before.station, before.elevation, before.tolerance), abs=0.005)]
    assert strip.marks["known"].stations.tolist() == [pytest.approx(before.station)]
    idle()


def test_escape_puts_a_diamond_back(desk, strip, idle):
    before = desk.session.project.known_elevations
    start = at(strip, before[0].station, before[0].elevation)
    drag(strip, start, start + QPoint(-80, 20), drop=False)
    assert strip.marks["known"].stations[0] != pytest.approx(before[0].station, abs=1)
    QTest.keyClick(strip.window(), Qt.Key.Key_Escape)
    assert strip.marks["known"].stations[0] == pytest.approx(before[0].station)
    QTest.mouseRelease(strip, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, start + QPoint(-80, 20))
    assert desk.session.project.known_elevations is before
    idle()


def test_a_diamond_stays_on_the_line_and_above_its_lowest_point(desk, strip, idle):
    known = desk.session.project.known_elevations[0]
    drag(strip, at(strip, known.station, known.elevation), QPoint(strip.width() - 1, strip.height() + 200))
    known = desk.session.project.known_elevations[0]
    assert known.station == pytest.approx(strip.axis.length, abs=0.01)
    assert known.elevation >= 0
    idle()


def test_a_click_moves_nothing(desk, strip, idle):
    before = desk.session.project
    known = before.known_elevations[0]
    QTest.mouseClick(strip, Qt.MouseButton.LeftButton, pos=at(strip, known.station, known.elevation) + QPoint(3, 2))
    assert desk.session.project.known_elevations is before.known_elevations


def test_an_edit_in_mid_drag_lets_go(desk, strip, idle):
    known = desk.session.project.known_elevations[0]
    start = at(strip, known.station, known.elevation)
    drag(strip, start, start + QPoint(40, 10), drop=False)
    desk.session.apply("Remove", lambda project: edits.remove_known_elevation(project, 0))
    move(strip, start + QPoint(60, 10), Qt.MouseButton.LeftButton)
    QTest.mouseRelease(strip, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, start + QPoint(60, 10))
    assert desk.session.project.known_elevations == ()
    assert desk.session.undo_label == "Remove"
    assert "known" not in strip.marks
    idle()


def test_the_menu_adds_one_where_it_was_opened_and_removes_it(desk, strip, table, idle):
    before = desk.session.project.known_elevations
    point = at(strip, 0.25 * strip.axis.length, 50.0)
    menu, actions = menu_texts(strip, point)
    actions["Add known elevation here"].trigger()
    menu.deleteLater()
    added = desk.session.project.known_elevations
    assert len(added) == len(before) + 1
    new = next(known for known in added if known not in before)
    station, elevation = strip.place_at(point)
    assert (new.station, new.elevation) == pytest.approx((station, elevation), abs=0.01)
    assert len(numbers(table)) == len(added)
    menu, actions = menu_texts(strip, at(strip, new.station, new.elevation))
    assert "Add known elevation here" not in actions
    actions["Remove this known elevation"].trigger()
    menu.deleteLater()
    assert desk.session.project.known_elevations == before
    desk.session.undo()
    assert desk.session.project.known_elevations == added
    idle()

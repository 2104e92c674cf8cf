from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import QApplication, QFileDialog, QLineEdit, QPushButton

from bobdesk.plan.control_points import KnownDistance
from bobdesk.plan.qgis_points import parse_qgis_points
from bobdesk.project import derive, edits
from bobdesk.project.project import Project
from bobdesk.ui.panels.scale_panel import ScalePanel
from bobdesk.ui.questions import Questions
from tests.project.made_projects import coordinates_project
from tests.ui.panels.cells import checked, shown, typed

USED, NAME, PX_X, PX_Y, X, Y, RESIDUAL_PX, RESIDUAL_M = range(8)


@pytest.fixture
def panel(desk, qtbot):
    panel = ScalePanel(desk)
    qtbot.addWidget(panel)
    panel.resize(440, 900)
    panel.show()
    return panel


@pytest.mark.parametrize(
    ("column", "text", "field", "value"),
    [
        (NAME, "house", "name", "house"),
        (PX_X, "130.5", "x_px", 130.5),
        (PX_Y, "-3.25", "y_px", -3.25),
        (X, "1,000.5", "x_m", 1000.5),
        (Y, "−7", "y_m", -7.0),
    ],
)
def test_every_cell_of_a_control_point_is_edited_and_undone(desk, opened, panel, column, text, field, value):
    assert typed(panel.points.model, 1, column, text)
    assert getattr(desk.session.project.control_points[1], field) == value
    desk.session.undo()
    assert desk.session.project is opened


def test_leaving_a_cell_as_it_is_makes_no_step(desk, opened, panel):
    model = panel.points.model
    for column in range(model.columnCount()):
        index = model.index(2, column)
        if model.flags(index) & Qt.ItemFlag.ItemIsEditable:
            assert model.setData(index, model.data(index, Qt.ItemDataRole.EditRole))
    assert desk.session.undo_label is None


@pytest.mark.parametrize("text", ["abc", "", "1e12", "nan"])
def test_what_is_no_position_is_told_and_changes_nothing(desk, opened, panel, told, text):
    assert not typed(panel.points.model, 0, PX_X, text)
    assert desk.session.project is opened
    assert len(told) == 1


def test_german_numbers(desk, opened, panel, german):
    model = panel.points.model
    assert shown(model, 3, PX_X) == "169,9"
    assert typed(model, 3, X, "9,25")
    assert desk.session.project.control_points[3].x_m == 9.25


def test_feet(desk, opened, panel):
    desk.settings.length_unit = "ft"
    model = panel.points.model
    assert model.headerData(X, Qt.Orientation.Horizontal) == "X ft"
    assert typed(model, 1, X, "100")
    assert desk.session.project.control_points[1].x_m == pytest.approx(30.48)


def test_the_worst_point_is_named_marked_and_switched_off(desk, opened, panel):
    model = panel.points.model
    assert panel.points.worst_box.isVisible()
    assert "Point 4" in panel.points.worst_box.sentence
    assert isinstance(model.data(model.index(3, NAME), Qt.ItemDataRole.DecorationRole), QIcon)
    links = panel.points.worst_box.links
    places = []
    panel.place_wanted.connect(lambda x, y: places.append((x, y)))
    links[1].click()
    assert places == [(169.9, 1510.4)]
    assert desk.selection.control_point == 3
    before = derive.calibration_fit(desk.session.project).value.rms_m
    links[0].click()
    assert not desk.session.project.control_points[3].used
    assert derive.calibration_fit(desk.session.project).value.rms_m < before
    assert panel.points.worst_box.sentence == ""
    assert shown(model, 3, RESIDUAL_M) != "–"
    desk.session.undo()
    assert desk.session.project is opened


def test_a_check_box_switches_a_point_off_and_on(desk, opened, panel):
    assert checked(panel.points.model, 0, USED, False)
    assert not desk.session.project.control_points[0].used
    assert checked(panel.points.model, 0, USED, True)
    assert desk.session.project.control_points[0].used


def test_at_the_minimum_no_error_is_made_up(desk, opened, panel):
    for row in (2, 3):
        checked(panel.points.model, row, USED, False)
    assert checked(panel.distances.model, 0, 0, False)
    assert "no error estimate possible" in panel.fit.rms.text()
    assert shown(panel.points.model, 0, RESIDUAL_M) == "–"


def test_selection_goes_both_ways(desk, opened, panel):
    panel.points.table.selectRow(2)
    assert desk.selection.control_point == 2
    desk.selection.control_point = 0
    assert [index.row() for index in panel.points.table.selectionModel().selectedRows()] == [0]
    desk.selection.control_point = None
    assert panel.points.table.selectionModel().selectedRows() == []


def test_removing_the_selected_point_and_undoing_it(desk, opened, panel):
    assert not panel.points.remove_button.isEnabled()
    panel.points.table.selectRow(1)
    panel.points.remove_button.click()
    assert [point.name for point in desk.session.project.control_points] == ["1", "3", "4"]
    assert panel.points.model.rowCount() == 3
    assert not panel.points.remove_button.isEnabled()
    desk.session.undo()
    assert desk.session.project is opened
    assert panel.points.model.rowCount() == 4


def test_points_go_to_qgis_and_come_back(desk, opened, panel, tmp_path, monkeypatch, told):
    path = tmp_path / "plan.points"
    monkeypatch.setattr(Questions, "file_to_save", lambda *_args: path)
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_args: (str(path), ""))
    panel.points.save_button.click()
    points = desk.session.project.control_points
    assert len(parse_qgis_points(path.read_text(), name="plan").points) == 4
    desk.session.apply("Away", lambda project: edits.set_control_points(project, ()))
    panel.points.load_button.click()
    for one, other in zip(points, desk.session.project.control_points, strict=True):
        assert (one.x_m, one.y_m, one.used) == (other.x_m, other.y_m, other.used)
        assert (one.x_px, one.y_px) == pytest.approx((other.x_px, other.y_px), abs=1e-9)
    assert desk.session.project.calibration.way == "points"


@pytest.mark.parametrize("content", [b"", b"mapX,mapY,sourceX,sourceY,enable\n", b"\x00\xff", None])
def test_a_file_without_points_is_refused_in_a_sentence(desk, opened, panel, tmp_path, told, content):
    path = tmp_path / "bad.points"
    if content is not None:
        path.write_bytes(content)
    assert not panel.points._actions.load(path)
    assert desk.session.project is opened
    assert len(told) == 1
    assert "bad.points" in told[0]


def test_a_file_that_cannot_be_written_is_told(desk, opened, panel, told):
    assert not panel.points._actions.save(Path("/proc/nowhere/plan.points"))
    assert len(told) == 1


@pytest.mark.parametrize(
    ("column", "text", "field", "value"),
    [
        (1, "bar", "name", "bar"),
        (3, "201.5", "length_m", 201.5),
        (5, "1.5 / 2", "start_px", (1.5, 2.0)),
        (6, "30; 40", "end_px", (30.0, 40.0)),
    ],
)
def test_every_cell_of_a_known_distance(desk, opened, panel, column, text, field, value):
    assert typed(panel.distances.model, 0, column, text)
    assert getattr(desk.session.project.known_distances[0], field) == value
    desk.session.undo()
    assert desk.session.project is opened


@pytest.mark.parametrize(("column", "text"), [(3, "-1"), (3, "0"), (3, "x"), (5, "1"), (5, "1/2/3")])
def test_what_is_no_distance(desk, opened, panel, told, column, text):
    assert not typed(panel.distances.model, 0, column, text)
    assert desk.session.project is opened
    assert len(told) == 1


def test_check_distances(desk, opened, panel):
    model = panel.checks.model
    assert model.rowCount() == 1
    assert typed(model, 0, 2, "60")
    check = derive.distance_checks(desk.session.project)[0]
    assert shown(model, 0, 3) == desk.quantities.length(check.difference_m, 2, unit=False)
    panel.checks.table.selectRow(0)
    panel.checks.remove_button.click()
    assert desk.session.project.check_distances == ()
    desk.session.undo()
    desk.session.undo()
    assert desk.session.project is opened


def test_ways(desk, opened, panel, told):
    chooser = panel.way.chooser

    def choose(way):
        chooser.setCurrentIndex(chooser.findData(way))
        chooser.activated.emit(chooser.currentIndex())

    now = derive.calibration(opened).value.metres_per_pixel
    choose("scale")
    assert desk.session.project.calibration.metres_per_pixel == now
    assert panel.way.number.isVisible()
    panel.way.number.setFocus()
    panel.way.number.setText("0.25")
    panel.way.number.setModified(True)
    panel.way.number.editingFinished.emit()
    assert desk.session.project.calibration.metres_per_pixel == 0.25
    panel.way.number.setText("-1")
    panel.way.number.setModified(True)
    panel.way.number.editingFinished.emit()
    assert desk.session.project.calibration.metres_per_pixel == 0.25
    assert len(told) == 1
    choose("drawing scale")
    assert "must be given" in panel.way.sentence.text()
    choose("unknown")
    assert not derive.scale_is_known(desk.session.project)
    assert chooser.findData("world") == -1
    for _ in range(4):
        desk.session.undo()
    assert desk.session.project is opened


def test_the_length_that_follows_and_what_it_is_worth(desk, opened, panel, idle):
    idle()
    assert "±" in panel.fit.length.text()
    assert panel.fit.worth.isVisible()
    assert "%" in panel.fit.worth.text()


def test_coordinates_need_no_scale(desk, panel):
    desk.session.open(coordinates_project(), None)
    assert panel.way.isVisible()
    assert not panel.points.isVisible()
    assert panel.way.chooser.count() == 2


def test_nothing_open_says_what_to_do(desk, panel):
    assert "plan comes first" in panel.state.text()
    desk.session.open(Project(), None)
    assert panel.state.isVisible()


def test_buttons_want_tools(desk, opened, panel):
    tools = []
    panel.tool_wanted.connect(tools.append)
    panel.distances.add_button.click()
    panel.checks.add_button.click()
    assert tools == ["known_distance", "measure"]


def test_every_control_has_a_name_and_a_tip(desk, opened, panel):
    for button in panel.findChildren(QPushButton):
        assert button.accessibleName() or not button.isVisible()
    assert panel.points.table.accessibleName()
    model = panel.points.model
    for column in range(model.columnCount()):
        assert model.headerData(column, Qt.Orientation.Horizontal, Qt.ItemDataRole.ToolTipRole)


def test_a_known_distance_alone_gives_the_scale(desk, opened, panel):
    desk.session.apply("Away", lambda project: edits.set_control_points(project, ()))
    desk.session.apply(
        "Add", lambda project: edits.add_known_distance(project, KnownDistance((0, 0), (100, 0), 50.0, "one"))
    )
    assert panel.distances.model.rowCount() == len(desk.session.project.known_distances)
    assert panel.fit.isVisible()


def test_a_wrong_distance_is_named_and_switched_off(desk, opened, panel):
    checked(panel.points.model, 3, USED, False)
    typed(panel.distances.model, 0, 3, "60")
    assert "Distance bar" in panel.distances.worst_box.sentence
    assert panel.points.worst_box.sentence == ""
    panel.distances.worst_box.links[0].click()
    assert not desk.session.project.known_distances[0].used


def test_a_cell_is_edited_with_mouse_and_keys(desk, opened, panel, qtbot, until):
    table = panel.points.table
    panel.activateWindow()
    index = panel.points.model.index(1, PX_X)
    where = table.visualRect(index).center()
    qtbot.mouseClick(table.viewport(), Qt.MouseButton.LeftButton, pos=where)
    qtbot.mouseDClick(table.viewport(), Qt.MouseButton.LeftButton, pos=where)
    editor = table.viewport().findChild(QLineEdit)
    assert editor.text() == "932.1"
    editor.selectAll()
    qtbot.keyClicks(editor, "940.5")
    qtbot.keyClick(editor, Qt.Key.Key_Return)
    until(lambda: desk.session.project.control_points[1].x_px == 940.5)


def test_the_tab_key_goes_from_the_top_to_the_bottom(desk, opened, panel, qtbot):
    panel.activateWindow()
    panel.way.chooser.setFocus()
    seen = []
    for _ in range(30):
        focus = QApplication.focusWidget()
        seen.append(focus.mapTo(panel.widget(), focus.rect().topLeft()).y())
        qtbot.keyClick(focus, Qt.Key.Key_Tab)
        if QApplication.focusWidget() is panel.way.chooser or QApplication.focusWidget() is focus:
            break
    assert len(seen) > 8
    assert seen == sorted(seen)

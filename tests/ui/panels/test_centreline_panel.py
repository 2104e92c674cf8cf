import sys
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox

from bobdesk.alignment.curvature import curvature
from bobdesk.plan.trace_vertices import drawn_trace
from bobdesk.project import derive, edits
from bobdesk.project.project import Project
from bobdesk.ui.derived import centreline_later
from bobdesk.ui.panels.centreline_panel import CentrelinePanel
from tests.project.made_projects import bends, coordinates_project
from tests.ui.panels.cells import shown, typed

NUMBER, PX_X, PX_Y, M_X, M_Y, SURE = range(6)


@pytest.fixture
def panel(desk, qtbot):
    panel = CentrelinePanel(desk)
    qtbot.addWidget(panel)
    panel.resize(440, 900)
    panel.show()
    return panel


@pytest.mark.parametrize(("column", "axis"), [(PX_X, 0), (PX_Y, 1)])
def test_a_vertex_is_moved_in_its_cell_and_undone(desk, opened, panel, column, axis):
    assert typed(panel.vertices.model, 7, column, "123.25")
    moved = desk.session.project.trace.points
    assert moved[7, axis] == 123.25
    assert moved[7, 1 - axis] == opened.trace.points[7, 1 - axis]
    assert (np.delete(moved, 7, axis=0) == np.delete(opened.trace.points, 7, axis=0)).all()
    assert shown(panel.vertices.model, 7, SURE) == "100 %"
    desk.session.undo()
    assert desk.session.project is opened


@pytest.mark.parametrize(("column", "axis"), [(M_X, 0), (M_Y, 1)])
def test_a_vertex_is_moved_on_the_ground(desk, opened, panel, column, axis):
    before = derive.calibration(opened).value.to_metres(opened.trace.points)
    assert typed(panel.vertices.model, 7, column, "-5.5")
    after = derive.calibration(opened).value.to_metres(desk.session.project.trace.points)
    assert after[7, axis] == pytest.approx(-5.5, abs=1e-9)
    assert after[7, 1 - axis] == pytest.approx(before[7, 1 - axis], abs=1e-9)


def test_a_german_types_a_comma(desk, opened, panel, german):
    assert typed(panel.vertices.model, 0, PX_X, "12,5")
    assert desk.session.project.trace.points[0, 0] == 12.5


@pytest.mark.parametrize("text", ["", "here", "1e9"])
def test_what_is_no_place_is_told(desk, opened, panel, told, text):
    assert not typed(panel.vertices.model, 0, PX_X, text)
    assert desk.session.project is opened
    assert len(told) == 1


def test_selection_goes_both_ways(desk, opened, panel):
    panel.vertices.table.selectRow(4)
    assert desk.selection.vertices == (4,)
    desk.selection.vertices = (1, 2, 3, 9)
    rows = {index.row() for index in panel.vertices.table.selectionModel().selectedRows()}
    assert rows == {1, 2, 3, 9}
    desk.selection.clear()
    assert not panel.vertices.table.selectionModel().hasSelection()


def test_selected_vertices_are_deleted_by_key_and_come_back(desk, opened, panel):
    desk.selection.vertices = (1, 2, 3, 9)
    panel.activateWindow()
    panel.vertices.table.setFocus()
    QTest.keyClick(panel.vertices.table, Qt.Key.Key_Delete)
    assert len(desk.session.project.trace.points) == len(opened.trace.points) - 4
    assert desk.selection.vertices == ()
    assert panel.vertices.model.rowCount() == len(opened.trace.points) - 4
    desk.session.undo()
    assert desk.session.project is opened


def test_twenty_thousand_vertices(desk, opened, panel):
    line = bends(20_000, size=4000.0)
    desk.session.apply("Draw", lambda project: replace(project, trace=drawn_trace(line)))
    model = panel.vertices.model
    assert model.rowCount() == 20_000
    desk.selection.vertices = range(20_000)
    assert len(panel.vertices.table.selectionModel().selection().toList()) == 1
    assert shown(model, 19_999, PX_X) == desk.quantities.number(float(line[-1, 0]), 2)
    panel.vertices.table.selectRow(19_999)
    assert desk.selection.vertices == (19_999,)


def test_coordinates_are_shown_in_metres_and_not_edited(desk, panel, told):
    project = coordinates_project()
    desk.session.open(project, None)
    model, table = panel.vertices.model, panel.vertices.table
    assert table.isColumnHidden(PX_X)
    assert not table.isColumnHidden(M_X)
    assert shown(model, 3, M_X) == desk.quantities.number(project.source.polyline.vertices[3, 0], 2)
    assert not typed(model, 3, M_X, "5")
    assert desk.session.project is project
    assert len(told) == 1


def test_extent_in_metres_along_the_line(desk, opened, panel):
    per_pixel = derive.calibration(opened).value.metres_per_pixel
    extent = panel.extent
    extent.start.setValue(10.0)
    assert desk.session.project.extent.start == pytest.approx(10.0 / per_pixel)
    extent.finish.setValue(100.0)
    assert desk.session.project.extent.finish == pytest.approx(100.0 / per_pixel)
    extent.finish.setValue(extent.finish.maximum())
    assert desk.session.project.extent.finish is None
    extent.is_cut.click()
    assert desk.session.project.extent.cut_off == derive.digitised_length(opened)
    extent.cut.setValue(80.0)
    assert desk.session.project.extent.cut_off == pytest.approx(80.0 / per_pixel)
    extent.is_cut.click()
    assert desk.session.project.extent.cut_off is None
    while desk.session.undo_label is not None:
        desk.session.undo()
    assert desk.session.project is opened
    assert extent.start.value() == 0.0


def test_a_start_behind_the_finish_is_refused_and_the_old_one_shown(desk, opened, panel, told):
    panel.extent.finish.setValue(50.0)
    before = desk.session.project
    panel.extent.start.setValue(60.0)
    assert desk.session.project is before
    assert panel.extent.start.value() == 0.0
    assert len(told) == 1


def test_steps_of_a_spin_box_are_one_step_of_undo(desk, opened, panel):
    for _ in range(5):
        panel.smoothing.wavelength.stepUp()
    assert desk.session.project.fit.wavelength == opened.fit.wavelength + 5
    desk.session.undo()
    assert desk.session.project is opened
    assert panel.smoothing.wavelength.value() == opened.fit.wavelength


def test_spacing(desk, opened, panel):
    panel.smoothing.spacing.setValue(0.5)
    assert desk.session.project.fit.spacing == 0.5
    desk.settings.length_unit = "ft"
    assert panel.smoothing.spacing.value() == pytest.approx(1.64, abs=0.005)
    assert desk.session.project.fit.spacing == 0.5


def test_the_curvature_follows_the_slider_before_anything_is_changed(desk, opened, panel, until):
    smoothing, strip = panel.smoothing, panel.smoothing.strip
    until(lambda: strip.curve is not None and strip.is_up_to_date)
    found = derive.centreline(opened).value
    assert np.array_equal(strip.curve[1], curvature(found))
    smoothing.slider.setSliderDown(True)
    smoothing.slider.setValue(80)
    until(lambda: strip.is_up_to_date)
    assert desk.session.project is opened
    draft = derive.centreline(replace(opened, fit=replace(opened.fit, wavelength=40.0))).value
    assert np.array_equal(strip.curve[1], curvature(draft))
    assert smoothing.wavelength.value() == 40.0
    smoothing.slider.setSliderDown(False)
    assert desk.session.project.fit.wavelength == 40.0
    until(lambda: strip.is_up_to_date and not desk.runner.jobs)
    assert np.array_equal(strip.curve[1], curvature(draft))
    desk.session.undo()
    assert desk.session.project is opened


def test_plan_length_and_what_it_is_uncertain_by(desk, opened, panel, until):
    until(lambda: "±" in panel.smoothing.length.text())
    assert "scale" in panel.smoothing.parts.text()
    desk.session.apply("Unknown", edits.find_the_scale)
    until(lambda: "factor f" in panel.smoothing.length.text())


def test_warnings_show_their_place_until_it_is_mended(desk, opened, panel):
    x, y = opened.trace.points[25]
    sentence = f"The picture hardly shows the line over 20 px around {x:.0f},{y:.0f}."
    trace = replace(opened.trace, warnings=(sentence,))
    desk.session.apply("Trace", lambda project: replace(project, trace=trace))
    box = panel.origin.warnings[0]
    assert box.sentence == sentence
    places = []
    panel.place_wanted.connect(lambda *place: places.append(place))
    box.links[0].click()
    assert places == [(round(x), round(y))]
    desk.session.apply("Move", lambda project: edits.move_vertices(project, range(20, 30), trace.points[20:30]))
    assert box.sentence == ""


def test_doubtful_places_one_after_the_other(desk, opened, panel):
    panel.origin.doubt_button.click()
    assert desk.selection.vertices == (2, 3, 4, 5)
    panel.origin.doubt_button.click()
    assert desk.selection.vertices == tuple(range(20, 30))
    panel.origin.doubt_button.click()
    assert desk.selection.vertices == (2, 3, 4, 5)


def test_reverse(desk, opened, panel):
    panel.origin.reverse_button.click()
    assert (desk.session.project.trace.points == opened.trace.points[::-1]).all()


def test_buttons_want_tools(desk, opened, panel):
    tools = []
    panel.tool_wanted.connect(tools.append)
    for button in (*panel.origin.tool_buttons, panel.origin.select_button):
        button.click()
    assert tools == ["auto trace", "live wire", "draw", "two edges", "select"]


def test_nothing_open_and_no_line_yet(desk, panel):
    assert "plan comes first" in panel.state.text()
    project = edits.open_picture(Project(), replace(coordinates_picture(), name="x.png"))
    desk.session.open(project, None)
    assert "no line yet" in panel.state.text()
    assert not panel.vertices.isVisible()


def coordinates_picture():
    from bobdesk.project.project import Picture

    return Picture(b"\x89PNG not really", "plan.png", size_px=(900, 900))


def test_every_control_has_a_name(desk, opened, panel):
    for control in (*panel.findChildren(QAbstractButton), *panel.findChildren(QAbstractSpinBox)):
        if not control.objectName().startswith("qt_") and control.isVisible():
            assert control.accessibleName() or control.text(), control


def test_heavy_libraries_wait_until_they_are_needed():
    import subprocess

    code = (
        "import sys\n"
        "import bobdesk.ui.panels.plan_panel, bobdesk.ui.panels.scale_panel, bobdesk.ui.panels.centreline_panel\n"
        "print([name for name in ('scipy', 'shapely', 'pyqtgraph') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_a_panel_that_comes_late_shows_the_length_at_once(desk, opened, qtbot, idle, until):
    centreline_later(desk)
    idle()
    panel = CentrelinePanel(desk)
    qtbot.addWidget(panel)
    until(lambda: "±" in panel.smoothing.length.text())

"""What the data leave open, in the window: band, profiles, advice and error budget."""

import threading
import time

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication

from bobdesk.cli.main import run as command
from bobdesk.files.project_file import save_project
from bobdesk.project import derive, edits
from bobdesk.ui.panels.solve_panel import SolvePanel
from bobdesk.ui.solve.open_data import open_data_of
from bobdesk.ui.solve.open_strips import OpenStrips
from bobdesk.ui.solve.result_strips import ResultStrips
from bobdesk.ui.strips.profile_strips import LIKELY, POSSIBLE
from bobdesk.ui.strips.strip_stack import StripStack
from tests.ui.answers import Answers


@pytest.fixture(autouse=True)
def coarse(monkeypatch):
    """Grids of 30 cells: what is drawn at random takes a second."""
    from bobdesk.project import derive_open
    from bobdesk.solve import next_elevation

    monkeypatch.setattr(derive_open, "_MOST_CELLS", 30)
    monkeypatch.setattr(next_elevation, "_MOST_CELLS", 30)
    monkeypatch.setattr(next_elevation, "_PROFILES", 100)


@pytest.fixture
def stack(desk, opened, qtbot, idle):
    made = StripStack(desk)
    qtbot.addWidget(made)
    ResultStrips(desk, made)
    OpenStrips(desk, made)
    made.resize(700, 420)
    made.show()
    idle()
    return made


@pytest.fixture
def panel(desk, opened, qtbot, idle):
    made = SolvePanel(desk)
    qtbot.addWidget(made)
    made.budget._questions = Answers(desk.settings, made)
    made.resize(430, 1200)
    made.show()
    idle()
    return made


def at(band, station):
    return tuple(float(np.interp(station, band.stations, edge)) for edge in (band.low, band.high))


def test_the_band_follows_targets_before_any_run(desk, stack, idle):
    band = stack.elevation.bands[POSSIBLE]
    length = derive.centreline(desk.session.project).needed().length
    assert band.stations[-1] == pytest.approx(length)
    known = desk.session.project.known_elevations[0]
    low, high = at(band, known.station)
    assert (low, high) == pytest.approx((known.elevation - 0.5, known.elevation + 0.5))
    desk.session.apply("Drop", lambda project: edits.set_drop(project, project.targets.drop + 7))
    idle()
    assert stack.elevation.bands[POSSIBLE].high[0] == pytest.approx(band.high[0] + 7)
    desk.session.apply("Limits", lambda project: edits.set_limits(project, 0.0, 0.12))
    idle()
    narrow = stack.elevation.bands[POSSIBLE]
    assert np.ptp(at(narrow, length / 4)) < np.ptp(at(band, length / 4))
    desk.session.apply("Impossible", lambda project: edits.set_limits(project, 0.0, 0.05))
    idle()
    assert POSSIBLE not in stack.elevation.bands
    desk.session.undo()
    idle()
    assert POSSIBLE in stack.elevation.bands


def test_a_bounded_change_narrows_the_band(desk, stack, idle):
    length = stack.elevation.bands[POSSIBLE].stations[-1]
    before = np.ptp(at(stack.elevation.bands[POSSIBLE], length / 4))
    desk.session.apply("Change", lambda project: edits.set_gradient_change(project, 0.001))
    idle()
    assert np.ptp(at(stack.elevation.bands[POSSIBLE], length / 4)) < 0.8 * before


def test_a_band_that_is_worked_out_stops_for_the_next_edit(desk, stack, idle, until, monkeypatch):
    from bobdesk.progress import Progress
    from bobdesk.project import derive_open

    closed, begun = threading.Event(), threading.Event()
    real = derive_open.open_band

    def endless(_project):
        try:
            while True:
                begun.set()
                time.sleep(0.001)
                yield Progress(0.5, "the band")
        finally:
            closed.set()

    monkeypatch.setattr(derive_open, "open_band", endless)
    desk.session.apply("Drop", lambda project: edits.set_drop(project, 60.0))
    until(begun.is_set)
    monkeypatch.setattr(derive_open, "open_band", real)
    desk.session.apply("Drop", lambda project: edits.set_drop(project, 61.0))
    idle()
    assert closed.is_set()
    assert stack.elevation.bands[POSSIBLE].high[0] == pytest.approx(61.0)


@pytest.mark.parametrize("change", [None, 0.001])
def test_profiles_at_random_never_leave_the_band(desk, stack, idle, change):
    desk.session.apply("Change", lambda project: edits.set_gradient_change(project, change))
    found = open_data_of(desk)
    assert found.profiles is None
    found.show("profiles", True)
    idle()
    band, profiles = found.band, found.profiles
    assert len(profiles.elevations) == 200
    low, high = (np.interp(profiles.shares, band.shares, edge) for edge in (band.lowest, band.highest))
    assert (profiles.elevations >= low - 1e-9).all()
    assert (profiles.elevations <= high + 1e-9).all()
    bundle = stack.elevation.bundles["drawn"]
    assert 10 <= len(bundle.values) < 200
    inner, outer = stack.elevation.bands["inner"], stack.elevation.bands["outer"]
    assert (outer.low <= inner.low + 1e-12).all()
    assert (inner.high <= outer.high + 1e-12).all()
    # Gradients without a bound jump from limit to limit: no line of them could be followed.
    assert ("drawn" in stack.gradient.bundles) == (change is not None)
    assert "outer" in stack.gradient.bands
    again = profiles.elevations
    found.show("profiles", False)
    assert not stack.elevation.bundles
    assert "inner" not in stack.gradient.bands
    found.show("profiles", True)
    idle()
    np.testing.assert_array_equal(found.profiles.elevations, again)


def test_what_is_shown_is_chosen_in_a_menu_and_remembered(desk, stack, idle):
    (text, fill) = stack._menus[0]
    assert text == "What the data leave open"
    from PySide6.QtWidgets import QMenu

    menu = QMenu(stack)
    fill(menu)
    actions = menu.actions()
    assert [action.isChecked() for action in actions] == [True, False, False]
    actions[0].trigger()
    idle()
    assert POSSIBLE not in stack.elevation.bands
    assert not open_data_of(desk).is_shown("band")
    actions[0].trigger()
    idle()
    assert POSSIBLE in stack.elevation.bands


def test_the_cursor_reads_the_band(desk, stack, idle):
    desk.selection.station = 0.0
    drop = desk.session.project.targets.drop
    assert f"possible {drop:.1f} to {drop:.1f} m" in stack.elevation.readout(0.0)


def test_where_to_measure_next_and_one_click_to_put_it_there(desk, panel, stack, idle, qtbot):
    advice = panel.advice
    assert advice.add_button.isHidden()
    advice.ask_button.click()
    idle()
    found = open_data_of(desk).advice
    assert f"At {found.station:,.0f} m" in advice.sentence.text()
    before = desk.session.project
    advice.add_button.click()
    # Nothing is known until it is typed.
    assert desk.session.project is before
    row = len(before.known_elevations)
    model = panel.known.model
    assert model.rowCount() == row + 1
    assert model.index(row, 1).data() == "type it"
    assert model.setData(model.index(row, 1), "30.5")
    new = max(desk.session.project.known_elevations, key=lambda known: known.elevation == 30.5)
    assert new.station == round(found.station, 2)
    assert model.rowCount() == row + 1
    assert desk.session.undo_label == "Add known elevation"
    desk.session.undo()
    assert desk.session.project.known_elevations == before.known_elevations
    advice.ask_button.click()
    idle()
    assert open_data_of(desk).advice is None
    assert advice.sentence.isHidden()


def test_a_row_that_waits_can_be_moved_and_taken_away(desk, panel, idle, told):
    part = panel.known
    part.begin(100.0)
    row = len(desk.session.project.known_elevations)
    assert part.model.setData(part.model.index(row, 0), "120")
    assert part.model.index(row, 0).data() == "120.00"
    assert not part.model.setData(part.model.index(row, 1), "high")
    part.table.selectRow(row)
    part.remove_button.click()
    assert part.model.rowCount() == row
    assert desk.session.project.known_elevations == desk.session.project.known_elevations


def type_into(qtbot, field, text):
    field.setFocus()
    field.selectAll()
    qtbot.keyClicks(field, text)
    qtbot.keyClick(field, Qt.Key.Key_Return)


def test_the_largest_change_is_typed_in_per_cent_in_ten_metres(desk, panel, qtbot, idle, told):
    type_into(qtbot, panel.targets.change, "2")
    assert desk.session.project.limits.gradient_change == pytest.approx(0.002)
    limits = desk.session.project.limits
    type_into(qtbot, panel.targets.highest, "22")
    assert desk.session.project.limits.gradient_change == limits.gradient_change
    type_into(qtbot, panel.targets.change, "-1")
    assert "change in 10 m" in told[-1]
    assert desk.session.project.limits.gradient_change == pytest.approx(0.002)
    desk.session.undo()
    desk.session.undo()
    assert desk.session.project.limits.gradient_change is None
    idle()


def test_the_change_leaves_a_result_up_to_date(desk, opened, solving, idle):
    from bobdesk.project.derive_runs import why_out_of_date

    solving.run()
    idle()
    desk.session.apply("Change", lambda project: edits.set_gradient_change(project, 0.002))
    assert why_out_of_date(desk.session.project, desk.session.project.run) is None
    idle()


def test_the_budget_is_the_commands_byte_for_byte(desk, panel, stack, idle, tmp_path):
    assert panel.budget.content("budget") is None
    panel.budget.fold.set_open(True)
    idle()
    path, table, band = (tmp_path / name for name in ("p.bobdesk", "b.csv", "s.csv"))
    save_project(desk.session.project, path)
    arguments = ["reconstruct", path, "-o", tmp_path / "l.csv", "--error-budget", table, "--error-band", band]
    assert command([str(one) for one in arguments]) == 0
    panel.budget.save("budget", tmp_path / "mine.csv")
    panel.budget.save("band", tmp_path / "my-band.csv")
    assert (tmp_path / "mine.csv").read_bytes() == table.read_bytes()
    assert (tmp_path / "my-band.csv").read_bytes() == band.read_bytes()
    panel.budget.copy_button.click()
    text = QGuiApplication.clipboard().text()
    assert text == table.read_text().replace(",", "\t")
    assert panel.budget.sentence.text() == open_data_of(desk).budget.sentence
    model = panel.budget.model
    assert model.index(model.rowCount() - 1, 0).data() == "all together"


def test_the_error_band_lies_about_the_result(desk, panel, stack, solving, idle):
    solving.run()
    idle()
    panel.budget.fold.set_open(True)
    panel.budget.in_strips.click()
    idle()
    band, curve = stack.elevation.bands[LIKELY], stack.elevation.curves["run"]
    middle = 0.5 * (band.low + band.high)
    np.testing.assert_allclose(np.interp(curve.stations, band.stations, middle), curve.values, atol=1e-6)
    assert LIKELY in stack.gradient.bands
    desk.selection.station = 300.0
    assert "±" in stack.elevation.readout(300.0)
    panel.budget.in_strips.click()
    assert LIKELY not in stack.elevation.bands


def test_what_is_not_known_of_the_scale_is_said_and_can_be_given(desk, panel, qtbot, idle, told):
    number = edits.scale_by_number(desk.session.project, 0.5)
    desk.session.apply("Scale", lambda _project: number)
    panel.budget.fold.set_open(True)
    idle()
    assert "How exact the plan's scale may be is not known" in panel.budget.sentence.text()
    type_into(qtbot, panel.budget.plan_error, "0.3")
    assert desk.session.project.plan_error == pytest.approx(0.003)
    idle()
    assert "not known" not in panel.budget.sentence.text()
    calibration = next(share for share in open_data_of(desk).budget.shares if share.source == "calibration")
    assert calibration.scale == pytest.approx(1.96 * 0.003)
    type_into(qtbot, panel.budget.plan_error, "90")
    assert "error of the plan" in told[-1]
    desk.session.undo()
    assert desk.session.project.plan_error is None
    idle()


def test_why_there_is_no_budget(desk, panel, idle):
    from dataclasses import replace

    desk.session.apply("Method", lambda project: edits.set_solver(project, replace(project.solver, method="published")))
    panel.budget.fold.set_open(True)
    idle()
    assert panel.budget.sentence.text() == "The error budget goes with the recommended method alone."
    assert not panel.budget.save_button.isEnabled()
    desk.session.undo()
    desk.session.apply("Drop", lambda project: edits.set_drop(project, None))
    idle()
    assert "must be given" in panel.budget.sentence.text()


def test_another_document_forgets_what_was_open(desk, panel, stack, idle):
    from bobdesk.project.project import Project

    panel.known.begin(100.0)
    desk.session.open(Project(), None)
    idle()
    assert panel.known.model.rowCount() == 0
    assert POSSIBLE not in stack.elevation.bands


def test_what_the_user_stops_says_so_and_begins_again_with_the_next_change(desk, panel, idle, until):
    panel.advice.ask_button.click()
    until(lambda: any(job.title.startswith("Finding where") for job in desk.runner.jobs))
    for job in desk.runner.jobs:
        job.stop()
    idle()
    assert panel.advice.sentence.text().startswith("Stopped")
    desk.session.apply("Drop", lambda project: edits.set_drop(project, project.targets.drop + 1))
    idle()
    assert open_data_of(desk).advice is not None

"""Compare methods: rows as they come, stop, sort, copy, save, take over."""

import csv
import io

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication

from bobdesk.project import derive, edits
from bobdesk.project.derive_runs import run_line, why_out_of_date
from bobdesk.project.run_edits import take_over_run
from bobdesk.solve.targets import KnownElevation
from bobdesk.ui.studies import methods_window
from bobdesk.ui.studies.methods_window import MethodsWindow

QUICK = {"pgd": "Projected gradient (recommended)", "published": "As published", "slsqp": "SLSQP"}


@pytest.fixture
def quick(monkeypatch):
    """Leave the slow methods out."""
    monkeypatch.setattr(methods_window, "method_titles", lambda: dict(QUICK))


@pytest.fixture
def methods(qtbot, desk, opened, quick, answering):
    made = MethodsWindow(desk)
    qtbot.addWidget(made)
    answering(made)
    made.open()
    yield made
    made.stop()
    qtbot.waitUntil(lambda: not made.is_running, timeout=60_000)


@pytest.fixture
def compared(methods, until):
    methods.bar.main_button.click()
    until(lambda: not methods.is_running)
    return methods


def test_every_method_is_a_row_with_a_curve_of_its_own_colour(compared):
    assert [result.row.method for result in compared.results] == list(QUICK)
    assert compared.table.model().rowCount() == 3
    assert [series.name for series in compared.chart.chart.series] == list(QUICK.values())
    assert len({series.number for series in compared.chart.chart.series}) == 3
    drop = compared.results[0].row.off.drop
    assert abs(drop) < 1e-6
    assert not compared.hint.isVisible()


def test_a_row_says_whether_its_line_meets_the_targets(methods, desk, opened, until):
    desk.session.apply("Known", lambda project: edits.add_known_elevation(project, KnownElevation(60.0, 1.0)))
    drop = desk.session.project.targets.drop
    desk.session.apply("Move", lambda project: edits.change_known_elevation(project, 0, KnownElevation(60.0, drop)))
    methods.compare()
    until(lambda: not methods.is_running)
    rows = {result.row.method: row for row, result in enumerate(methods.model.rows)}
    said = {key: methods.model.index(row, 1).data() for key, row in rows.items()}
    assert said["pgd"] == said["slsqp"] == "✓ met"
    assert said["published"].startswith("! ")
    assert "known elevation at 60 m missed by" in said["published"]
    assert methods.note.isVisible()
    assert methods.note.text().endswith("it does not show what is missed of them by As published.")
    desk.settings.length_unit = "ft"
    assert "known elevation at 197 ft missed by" in methods.model.index(rows["published"], 1).data()


def test_the_saved_table_is_the_one_that_the_command_writes(compared, opened, tmp_path):
    from bobdesk.files.exporters.study_tables import methods_table
    from bobdesk.progress import finish
    from bobdesk.solve.run import METHODS
    from bobdesk.track.method_comparison import compare_methods

    compared.questions.save_path = tmp_path / "m.csv"
    compared.save_button.click()
    inputs = derive.run_inputs(opened).needed()
    rows = finish(
        compare_methods(
            derive.centreline(opened).needed(),
            inputs.segments,
            inputs.targets,
            opened.solver,
            clock=lambda: 0.0,
            methods=[method for method in METHODS if method.key in QUICK],
        )
    )

    def without_seconds(table: bytes) -> list[dict[str, str]]:
        found = list(csv.DictReader(io.StringIO(table.decode())))
        return [{name: value for name, value in row.items() if name != "seconds"} for row in found]

    assert without_seconds((tmp_path / "m.csv").read_bytes()) == without_seconds(methods_table(rows))


def test_a_row_becomes_a_run_that_is_up_to_date_and_undo_takes_it_back(compared, desk, opened):
    compared.table.choose(2)
    line = compared.table.chosen.row.line
    compared.take_button.click()
    now = desk.session.project
    assert now.run.name == "SLSQP"
    assert now.solver.method == "slsqp"
    assert why_out_of_date(now, now.run) is None
    assert run_line(now.run).elevations == pytest.approx(line.elevations, abs=1e-9)
    assert len(now.run.history) == now.run.nit + 1
    compared.take_button.click()
    assert desk.session.project.run.name == "SLSQP 2"
    desk.session.undo()
    desk.session.undo()
    assert desk.session.project is opened


def test_a_run_of_the_projects_own_method_changes_no_setting(compared, desk, opened):
    compared.table.choose(0)
    compared.take_button.click()
    assert desk.session.project.solver is opened.solver
    assert take_over_run(opened, desk.session.project.run).solver is opened.solver


def test_an_edit_after_the_comparison_is_said(compared, desk):
    assert not compared.changed_note.isVisible()
    desk.session.apply("Drop", lambda project: edits.set_drop(project, 0.9 * project.targets.drop))
    assert compared.changed_note.isVisible()
    desk.session.undo()
    assert not compared.changed_note.isVisible()
    desk.session.apply("Rename", lambda project: edits.name_project(project, "other"))
    assert not compared.changed_note.isVisible()


def test_sorting_keeps_the_selection_and_copying_takes_the_order(compared):
    compared.table.choose(1)
    chosen = compared.table.chosen
    compared.table.sortByColumn(7, Qt.SortOrder.DescendingOrder)
    shown = [result.row.evaluations for result in compared.model.rows]
    assert shown == sorted(shown, reverse=True)
    assert compared.table.chosen is chosen
    compared.copy_button.click()
    lines = QGuiApplication.clipboard().text().splitlines()
    assert [line.split("\t")[0] for line in lines[1:]] == [QUICK[result.row.method] for result in compared.model.rows]


def test_stop_keeps_the_rows_that_are_finished(qtbot, desk, opened, monkeypatch, until):
    titles = {"pgd": "Projected gradient", "de": "Differential evolution", "slsqp": "SLSQP"}
    monkeypatch.setattr(methods_window, "method_titles", lambda: dict(titles))
    desk.session.open(edits.set_spacing(opened, 0.5), None)
    made = MethodsWindow(desk)
    qtbot.addWidget(made)
    made.open()
    made.compare()
    until(lambda: len(made.results) == 1)
    made.bar.stop_button.click()
    until(lambda: not made.is_running)
    assert [result.row.method for result in made.results] == ["pgd"]
    assert "2" in made.bar.said.text()
    assert made.copy_button.isEnabled()


def test_closing_at_work_asks(methods, until):
    methods.compare()
    methods.close()
    assert methods.questions.asked == ["stop"]
    assert methods.isVisible()
    assert methods.is_running
    methods.questions.stop_answer = True
    methods.close()
    assert not methods.isVisible()
    until(lambda: not methods.is_running)


def test_another_document_takes_the_rows_away(compared, desk):
    desk.session.close()
    assert compared.results == ()
    assert not compared.bar.main_button.isEnabled()
    assert compared.hint.isVisible()


def test_a_method_that_cannot_do_it_is_a_row_that_says_why(methods, desk, until):
    desk.session.apply("Scale", edits.find_the_scale)
    methods.compare()
    until(lambda: not methods.is_running)
    failed = {result.row.method: result.row for result in methods.results}["slsqp"]
    assert "cannot find an unknown scale" in failed.message
    assert failed.found is None
    row = [result.row.method for result in methods.model.rows].index("slsqp")
    methods.table.choose(row)
    assert not methods.take_button.isEnabled()
    methods.table.sortByColumn(2, Qt.SortOrder.DescendingOrder)
    assert methods.model.rows[-1].row.method == "slsqp"

"""What people do in a hurry while runs are at work, in the whole window."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest

from bobdesk.project import edits
from bobdesk.project.derive_runs import why_out_of_date
from bobdesk.solve.settings import SolverSettings
from bobdesk.ui.panels.solve_panel import SolvePanel
from bobdesk.ui.shown_result import shown_result_of
from bobdesk.ui.solving import solving_of
from tests.project.made_projects import ready_project

SLOW = SolverSettings(method="published", rate=1e-12, threshold=1e-300)


@pytest.fixture
def desk_of(whole_window):
    whole_window.go_to("Solve")
    return whole_window.desk


@pytest.fixture
def at_work(desk_of, until):
    """A run that takes its time, beside the sample's own."""
    desk_of.session.apply("Slow", lambda project: edits.set_solver(project, SLOW))
    solving = solving_of(desk_of)
    solving.run()
    until(lambda: solving.record is not None and solving.record.count > 20)
    return solving


@pytest.fixture
def quiet(desk_of, until):
    return lambda: until(lambda: not desk_of.runner.jobs)


def test_the_shown_run_is_deleted_while_another_works(desk_of, at_work, quiet):
    desk_of.session.apply("Delete run", lambda project: edits.remove_run(project, 0))
    assert desk_of.session.project.runs == ()
    at_work.stop()
    quiet()
    assert [run.name for run in desk_of.session.project.runs] == ["Run 2"]
    assert desk_of.session.project.chosen_run == 0
    desk_of.session.undo()
    desk_of.session.undo()
    assert [run.name for run in desk_of.session.project.runs] == ["Run 1"]
    quiet()


def test_a_result_is_undone_while_another_run_works(whole_window, desk_of, quiet, until):
    solving = solving_of(desk_of)
    solving.run()
    quiet()
    assert len(desk_of.session.project.runs) == 2
    desk_of.session.apply("Slow", lambda project: edits.set_solver(project, SLOW))
    solving.run()
    until(lambda: solving.record is not None and solving.record.count > 20)
    desk_of.session.undo()
    desk_of.session.undo()
    assert len(desk_of.session.project.runs) == 1
    solving.stop()
    quiet()
    runs = desk_of.session.project.runs
    assert [run.name for run in runs] == ["Run 1", "Run 3"]
    assert desk_of.session.project.run is runs[1]
    assert "solver" in why_out_of_date(desk_of.session.project, runs[1])


def test_f5_twice_queues_and_escape_from_it_drops(whole_window, desk_of, at_work, quiet):
    panel = whole_window.findChild(SolvePanel)
    QTest.keyClick(whole_window, Qt.Key.Key_F5)
    QTest.keyClick(whole_window, Qt.Key.Key_F5)
    assert at_work.waiting == 2
    assert "2 waiting" in panel.run.progress.text()
    panel.run.drop_button.click()
    assert at_work.waiting == 0
    QTest.keyClick(whole_window, Qt.Key.Key_F5, Qt.KeyboardModifier.ShiftModifier)
    quiet()
    assert len(desk_of.session.project.runs) == 2
    assert not solving_of(desk_of).is_running


def test_a_run_goes_on_after_a_rest_in_which_the_project_was_edited(desk_of, at_work, quiet, until):
    at_work.pause()
    drop = desk_of.session.project.targets.drop
    desk_of.session.apply("Drop", lambda project: edits.set_drop(project, drop + 5))
    desk_of.session.apply("Known", lambda project: edits.set_known_elevations(project, ()))
    count = at_work.record.count
    at_work.resume()
    until(lambda: at_work.record.count > count)
    at_work.stop()
    quiet()
    run = desk_of.session.project.run
    assert run.inputs.targets.drop == drop
    assert desk_of.session.project.targets.drop == drop + 5
    assert "targets, limits or known elevations" in why_out_of_date(desk_of.session.project, run)


def test_another_document_while_a_run_rests_and_others_wait(whole_window, desk_of, at_work, quiet):
    at_work.run()
    at_work.pause()
    desk_of.notices.error("Something of the old document.")
    desk_of.session.open(ready_project(), None)
    quiet()
    assert not at_work.is_running
    assert at_work.waiting == 0
    assert desk_of.session.project.runs == ()
    assert "Something of the old document." not in [notice.sentence for notice in whole_window.notice_bar.shown]
    at_work.run()
    quiet()
    assert [run.name for run in desk_of.session.project.runs] == ["Run 1"]


def test_a_baseline_that_is_deleted_is_none_and_comes_back_with_undo(whole_window, desk_of, quiet):
    panel, shown = whole_window.findChild(SolvePanel), shown_result_of(desk_of)
    solving_of(desk_of).run()
    quiet()
    first = desk_of.session.project.runs[0]
    shown.set_baseline(first)
    quiet()
    assert panel.runs.note.isVisible()
    desk_of.session.apply("Delete run", lambda project: edits.remove_run(project, 0))
    quiet()
    assert shown.baseline is None
    assert not panel.runs.note.isVisible()
    desk_of.session.undo()
    desk_of.session.apply("Rename", lambda project: edits.name_run(project, 0, "Other name"))
    quiet()
    assert shown.baseline.name == "Other name"
    assert "Other name" in panel.runs.note.text()


def test_scrubbing_ends_with_another_result_and_with_undo(whole_window, desk_of, quiet):
    part, shown = whole_window.findChild(SolvePanel).convergence, shown_result_of(desk_of)
    quiet()
    part.plot.chosen.emit(3)
    assert shown.scrubbed is not None
    desk_of.session.apply("Rename", lambda project: edits.name_run(project, 0, "Renamed"))
    assert shown.scrubbed is not None, "the same run under another name"
    solving_of(desk_of).run()
    quiet()
    assert shown.scrubbed is None
    part.plot.chosen.emit(5)
    assert shown.scrubbed is not None
    desk_of.session.undo()
    quiet()
    assert shown.scrubbed is None
    assert part.plot.cursor_number is None


def test_the_view_in_space_follows_all_of_it(whole_window, desk_of, quiet, until):
    whole_window.views.show_in_space(True)
    quiet()
    solving = solving_of(desk_of)
    desk_of.session.apply("Slow", lambda project: edits.set_solver(project, SLOW))
    solving.run()
    until(lambda: solving.record is not None and solving.record.count > 200)
    whole_window.grab()
    desk_of.session.apply("Delete run", lambda project: edits.remove_run(project, 0))
    solving.drop_all()
    quiet()
    assert desk_of.session.project.run is None
    whole_window.grab()
    desk_of.session.undo()
    quiet()
    whole_window.grab()
    desk_of.session.close()
    quiet()
    whole_window.grab()


def test_a_run_at_work_has_the_colour_that_it_keeps(desk_of, at_work, quiet, until):
    shown = shown_result_of(desk_of)
    until(lambda: shown.is_live)
    live = shown.colour
    assert live != shown.colour_of(desk_of.session.project.runs[0])
    at_work.stop()
    quiet()
    assert shown.colour_of(desk_of.session.project.run) == live


def test_a_run_that_is_stopped_counts_all_its_iterates(desk_of, at_work, quiet):
    at_work.stop()
    quiet()
    run = desk_of.session.project.run
    assert run.nit == at_work.record_of(run).count - 1
    assert f"after {run.nit:,} iterations" in run.message


def test_copying_without_runs_copies_the_targets(whole_window, desk_of, quiet):
    desk_of.session.apply("Delete run", lambda project: edits.remove_run(project, 0))
    quiet()
    whole_window.findChild(SolvePanel).runs.copy()
    lines = QGuiApplication.clipboard().text().splitlines()
    assert [line.split("\t")[0] for line in lines] == ["Run", "Targets", "Actual track"]

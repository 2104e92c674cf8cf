import threading
import time

import pytest
from PySide6.QtCore import QObject

from bobdesk.project import edits
from bobdesk.project.derive_runs import iterate_line, run_line, why_out_of_date
from bobdesk.solve.objective import PublishedObjective
from bobdesk.solve.settings import SolverSettings
from bobdesk.ui.desk import Desk
from bobdesk.ui.notices import Notices
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.runner import Runner
from bobdesk.ui.selection import Selection
from bobdesk.ui.session import Session
from bobdesk.ui.settings import Settings
from bobdesk.ui.solving import solving_of
from tests.project.made_projects import ready_project


def test_a_run_is_one_undoable_edit(desk, opened, solving, idle):
    solving.run()
    idle()
    run = desk.session.project.run
    assert run.name == "Run 1"
    assert desk.session.undo_label == "Solve, Run 1"
    desk.session.undo()
    assert desk.session.project.runs == ()


def test_every_iterate_is_counted(desk, opened, solving, idle):
    records = []
    solving.advanced.connect(lambda: records.append(solving.record))
    solving.run()
    idle()
    assert records[-1].count == desk.session.project.run.nit + 1
    assert solving.record_of(desk.session.project.run) is records[-1]


def test_the_project_can_be_edited_meanwhile_and_the_result_is_then_out_of_date(desk, endless, solving, until, idle):
    solving.run()
    until(lambda: solving.record is not None and solving.record.count > 10)
    desk.session.apply("Drop", lambda project: edits.set_drop(project, 70.0))
    solving.stop()
    idle()
    project = desk.session.project
    assert project.targets.drop == 70.0
    assert project.run.inputs.targets.drop != 70.0
    assert why_out_of_date(project, project.run) is not None


def test_pause_and_stop_act_within_a_tenth_of_a_second(desk, endless, solving, until):
    solving.run()
    until(lambda: solving.record.count > 100)
    solving.pause()
    began = time.perf_counter()
    time.sleep(0.02)
    count = solving.record.count
    time.sleep(0.1)
    assert solving.record.count == count
    assert time.perf_counter() - began < 0.2
    solving.resume()
    until(lambda: solving.record.count > count)
    began = time.perf_counter()
    solving.stop()
    until(lambda: not solving.is_running)
    assert time.perf_counter() - began < 0.1 + 0.1, "stopped, drawn and kept"
    assert desk.session.project.run.message.startswith("Stopped by hand")


@pytest.fixture
def evaluations(monkeypatch):
    """How often the published objective has been evaluated; each takes a while, as on a long track."""
    counted = []

    def slow(evaluate):
        def counting(self, *values, **others):
            counted.append(1)
            time.sleep(0.002)
            return evaluate(self, *values, **others)

        return counting

    for name in ("value", "value_and_derivative"):
        monkeypatch.setattr(PublishedObjective, name, slow(getattr(PublishedObjective, name)))
    return counted


@pytest.mark.parametrize("method", ["slsqp", "lbfgsb", "trustconstr", "de"])
def test_methods_of_scipy_rest_and_stop_at_their_next_evaluation(desk, opened, solving, until, evaluations, method):
    desk.session.apply("Method", lambda project: edits.set_solver(project, SolverSettings(method=method)))
    solving.run()
    until(lambda: len(evaluations) > 5)
    solving.pause()
    time.sleep(0.02)
    count = len(evaluations)
    time.sleep(0.05)
    assert len(evaluations) == count, "it rests, in the middle of a generation too"
    solving.resume()
    until(lambda: len(evaluations) > count)
    count = len(evaluations)
    solving.stop()
    until(lambda: not solving.is_running)
    assert len(evaluations) <= count + 2 + 2, "the one under way, and those of the iterate that it led to"
    run = desk.session.project.run
    assert run.message.startswith("Stopped by hand")
    assert run.objective == min(run.history[:, 2])


@pytest.mark.parametrize("method", ["slsqp", "lbfgsb", "trustconstr", "de"])
def test_iterates_of_scipys_methods_are_shown_as_they_come(desk, opened, solving, until, evaluations, method):
    desk.session.apply("Method", lambda project: edits.set_solver(project, SolverSettings(method=method)))
    counts = []
    solving.advanced.connect(lambda: counts.append(solving.record.count))
    solving.run()
    until(lambda: len(set(counts)) > 2)
    assert solving.is_running
    solving.stop()
    until(lambda: not solving.is_running)


def test_closing_while_a_method_of_scipy_rests_is_clean(desk, opened, solving, until, evaluations):
    desk.session.apply("Method", lambda project: edits.set_solver(project, SolverSettings(method="de")))
    solving.run()
    until(lambda: len(evaluations) > 5)
    solving.pause()
    desk.runner.close()
    assert not [thread for thread in threading.enumerate() if thread.name == "a method at work"]


def test_single_steps(desk, endless, solving, until):
    solving.step()
    until(lambda: solving.is_paused)
    assert solving.record.count == 1
    for count in (2, 3, 4):
        solving.step()
        until(lambda count=count: solving.record.count == count and solving.is_paused)
    solving.stop()
    until(lambda: not solving.is_running)
    assert len(desk.session.project.run.history) in (4, 5)


def test_runs_wait_for_each_other(desk, opened, solving, idle):
    solving.run()
    desk.session.apply("Drop", lambda project: edits.set_drop(project, project.targets.drop + 1))
    solving.run()
    solving.run()
    assert solving.waiting == 2
    idle()
    runs = desk.session.project.runs
    assert [run.name for run in runs] == ["Run 1", "Run 2", "Run 3"]
    assert runs[1].inputs.targets.drop == runs[0].inputs.targets.drop + 1
    assert runs[1].gradients.tolist() == runs[2].gradients.tolist()


def test_waiting_runs_can_be_dropped(desk, endless, solving, until):
    solving.run()
    solving.run()
    solving.drop_waiting()
    until(lambda: solving.record is not None and solving.record.count > 1)
    solving.stop()
    until(lambda: not solving.is_running)
    assert len(desk.session.project.runs) == 1


def test_another_document_ends_all_runs_and_keeps_none(desk, endless, solving, until, idle):
    solving.run()
    solving.run()
    until(lambda: solving.record.count > 10)
    desk.session.open(ready_project(), None)
    idle()
    assert desk.session.project.runs == ()
    assert not solving.is_running


def test_what_cannot_be_solved_is_said(desk, opened, solving, idle, told):
    desk.session.apply("Length", lambda project: edits.set_length(project, None))
    solving.run()
    idle()
    assert any("length" in sentence for sentence in told)
    assert desk.session.project.runs == ()


def test_closing_during_a_run_is_clean_fifty_times(qapp, tmp_path):
    project = edits.set_solver(ready_project(), SolverSettings(method="published", rate=1e-12, threshold=1e-300))
    for number in range(50):
        owner = QObject()
        session, runner, settings = Session(owner), Runner(owner), Settings(tmp_path / "s.ini", owner)
        desk = Desk(session, Selection(owner), None, runner, Notices(owner), settings, Quantities(settings, owner))
        session.open(project, None)
        solving = solving_of(desk)
        solving.run()
        if number % 3 == 1:
            qapp.processEvents()
        if number % 5 == 2:
            solving.pause()
        time.sleep(0.002 * (number % 4))
        runner.close()
        assert not runner.jobs
        owner.deleteLater()
        qapp.processEvents()


@pytest.mark.parametrize("method", ["pgd", "published", "slsqp", "de"])
def test_lines_of_kept_iterates_can_be_drawn(desk, opened, solving, idle, method):
    desk.session.apply("Method", lambda project: edits.set_solver(project, SolverSettings(method=method)))
    solving.run()
    idle()
    run = desk.session.project.run
    rows = solving.record_of(run).rows()
    kept = run.iterates
    assert len(kept.table) <= 200
    assert kept.numbers[0] == 0
    assert kept.numbers[-1] == rows[-1, 0]
    for row in (0, len(kept.table) // 2, len(kept.table) - 1):
        line = iterate_line(run, row)
        assert line.slope_lengths[-1] == pytest.approx(rows[int(kept.numbers[row]), 3], rel=1e-6)
    assert iterate_line(run, len(kept.table) - 1).elevations == pytest.approx(run_line(run).elevations, abs=1e-9)

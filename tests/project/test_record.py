import numpy as np
import pytest

from bobdesk.errors import InputError
from bobdesk.progress import finish
from bobdesk.project import edits
from bobdesk.project.new_run import new_run
from bobdesk.project.record import MOST_KEPT, IterateRecord, record_of
from bobdesk.solve.iterates import Iterate
from bobdesk.solve.run import METHODS, SolverMethod
from bobdesk.solve.settings import SolverSettings
from tests.project.made_projects import ready_project


def iterate(number, objective, *, stage="published", length=100.0):
    return Iterate(number, stage, np.full(3, 0.1), objective, length, 10.0, 0.1, 0.1)


def clock():
    return 0.0


def test_every_iterate_is_counted_and_an_even_choice_is_kept_whole():
    record = record_of([iterate(number, 1.0 / (number + 1)) for number in range(5000)])
    assert record.count == len(record.rows()) == 5000
    assert record.rows(4990)[:, 0].tolist() == list(range(4990, 5000))
    numbers = [one.number for one in record.kept]
    assert len(numbers) <= MOST_KEPT
    assert numbers[0] == 0
    assert numbers[-1] == 4999
    assert max(np.diff(numbers)) <= 5000 / (MOST_KEPT / 4)


def test_the_best_is_the_lowest_objective_and_never_a_figure_that_is_no_number():
    record = record_of([iterate(0, 3.0), iterate(1, 1.0), iterate(2, float("nan")), iterate(3, 2.0)])
    assert record.best.number == 1


def test_where_a_length_is_met_the_nearest_to_it_is_the_best():
    record = record_of(
        [
            iterate(0, 0.0, stage="smoothest profile", length=99.0),
            iterate(1, 0.5, stage="length", length=100.5),
            iterate(2, 0.9, stage="length", length=100.0),
            iterate(3, 0.1, stage="length", length=100.3),
        ],
        length=100.0,
    )
    assert record.best.number == 2


def failing_at(count):
    def solve(centreline, segments, targets, settings):
        own = METHODS[0].solve(centreline, segments, targets, settings)
        for _ in range(count):
            yield next(own)
        raise ZeroDivisionError("a made fault")

    return (SolverMethod("pgd", "made to fail", solve),)


def test_a_solver_that_fails_keeps_its_best_iterate_and_says_why():
    run = finish(new_run(ready_project(), name="1", clock=clock, methods=failing_at(5)))
    assert run.status == 1
    assert "ZeroDivisionError: a made fault" in run.message
    assert "after 4 iterations" in run.message
    assert len(run.history) == 5
    assert run.figures.drop == pytest.approx(ready_project().targets.drop, abs=1e-3)


def test_a_solver_that_fails_at_once_is_told_in_a_sentence():
    with pytest.raises(InputError, match="before its first iterate"):
        finish(new_run(ready_project(), name="1", clock=clock, methods=failing_at(0)))


@pytest.mark.parametrize("method", ["pgd", "published", "slsqp"])
def test_a_run_that_is_stopped_ends_with_its_best_iterate(method):
    project = edits.set_solver(ready_project(), SolverSettings(method=method))
    record = IterateRecord(project.targets.length)
    run = finish(new_run(project, name="1", clock=clock, record=record, enough=lambda: record.count == 2))
    assert record.count == len(run.history) == 2
    assert run.message == "Stopped by hand after 1 iteration; the best so far is kept."
    assert run.nit == run.history[-1, 0] == 1
    assert run.gradients.tolist() == record.best.gradients.tolist()


@pytest.mark.parametrize("method", ["pgd", "published"])
def test_the_history_ends_at_the_reported_figures(method):
    project = edits.set_solver(ready_project(), SolverSettings(method=method))
    record = IterateRecord(project.targets.length)
    run = finish(new_run(project, name="1", clock=clock, record=record))
    assert record.count == run.nit + 1
    assert run.history[-1, 2] == run.objective
    assert run.history[-1, 3] == pytest.approx(run.figures.length, abs=1e-4)


def test_a_run_that_is_out_of_date_is_begun_where_it_ended():
    published = edits.set_solver(ready_project(), SolverSettings(method="published"))
    first = finish(new_run(published, name="1", clock=clock))
    kept = edits.keep_run(published, first)
    again = finish(new_run(kept, name="2", clock=clock))
    assert again.gradients.tolist() == first.gradients.tolist(), "made anew from the beginning while nothing changed"
    longer = edits.set_length(kept, kept.targets.length + 0.01)
    warm = finish(new_run(longer, name="3", clock=clock))
    cold = finish(new_run(edits.set_length(published, kept.targets.length + 0.01), name="4", clock=clock))
    assert warm.nit < cold.nit

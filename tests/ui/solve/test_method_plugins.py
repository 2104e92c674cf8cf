"""Solvers of other packages in the panel and in a run; one that cannot be used is told of; faults end in a sentence."""

import sys
from contextlib import closing
from dataclasses import replace

import pytest

from bobdesk.files import plugins
from bobdesk.project import edits
from bobdesk.solve.run import solve
from bobdesk.solve.settings import SolverSettings

_MODULE = """
from dataclasses import replace
from bobdesk.solve.run import METHODS, SolverMethod
from bobdesk.solve.settings import SolverSettings

def coasting(centreline, segments, targets, settings):
    solution = yield from METHODS[0].solve(centreline, segments, targets, SolverSettings())
    return replace(solution, message="Coasted.")

def crashing(centreline, segments, targets, settings):
    for number, iterate in enumerate(METHODS[1].solve(centreline, segments, targets, settings)):
        if number == 5:
            raise ZeroDivisionError("the ice is gone")
        yield iterate

coast = SolverMethod("coast", "Coasting downhill", coasting)
crash = SolverMethod("crash", "Crashing", crashing)
"""
_ENTRIES = """
[bobdesk.solvers]
coast = coasting_plugin:coast
crash = coasting_plugin:crash
gone = no_such_module_at_all:solver
"""


@pytest.fixture
def _installed(tmp_path, monkeypatch):
    site = tmp_path / "site"
    about = site / "coasting_plugin-1.0.dist-info"
    about.mkdir(parents=True)
    (site / "coasting_plugin.py").write_text(_MODULE)
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: coasting-plugin\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text(_ENTRIES)
    monkeypatch.syspath_prepend(str(site))
    plugins._loaded.cache_clear()
    yield
    plugins._loaded.cache_clear()
    sys.modules.pop("coasting_plugin", None)


def choose(panel, text):
    index = panel.method.method.findText(text)
    assert index >= 0
    panel.method.method.setCurrentIndex(index)
    panel.method.method.activated.emit(index)


def labels(panel):
    from PySide6.QtWidgets import QLabel

    return [label.text().replace("\u200b", "") for label in panel.method.findChildren(QLabel) if label.isVisible()]


@pytest.mark.usefixtures("_installed")
def test_a_method_of_a_plugin_can_be_chosen_and_runs(desk, panel, solving, idle):
    choose(panel, "Coasting downhill")
    assert desk.session.project.solver.method == "coast"
    solving.run()
    idle()
    assert desk.session.project.run.message == "Coasted."
    assert desk.session.project.run.inputs.settings.method == "coast"


@pytest.mark.usefixtures("_installed")
def test_one_that_cannot_be_used_is_told_of(panel, idle):
    found = [text for text in labels(panel) if "no_such_module_at_all" in text]
    assert len(found) == 1
    assert found[0].startswith("! The plug-in gone (no_such_module_at_all:solver) cannot be used: ModuleNotFoundError")
    assert panel.widget().minimumSizeHint().width() <= 430


def test_without_plugins_nothing_is_told(panel):
    assert not [text for text in labels(panel) if text.startswith("!")]


def test_a_project_with_a_method_that_is_not_here_says_so(desk, panel, told, solving, idle):
    gone = replace(desk.session.project.solver, method="coast")
    desk.session.apply("Method", lambda project: edits.set_solver(project, gone))
    assert panel.method.method.currentIndex() == -1
    assert [text for text in labels(panel) if "“coast” comes with a plug-in that is not here" in text]
    solving.run()
    idle()
    assert any("there is no method 'coast'" in sentence.lower() for sentence in told)
    choose(panel, "As published")
    assert not [text for text in labels(panel) if "“coast”" in text]
    idle()


@pytest.mark.usefixtures("_installed")
def test_a_fault_in_a_plugin_is_one_sentence_and_keeps_the_best_iterate(desk, panel, solving, idle, told):
    choose(panel, "Crashing")
    slow = replace(desk.session.project.solver, rate=1e-12, threshold=1e-300)
    desk.session.apply("Slow", lambda project: edits.set_solver(project, slow))
    solving.run()
    idle()
    run = desk.session.project.run
    assert run is not None
    assert "ZeroDivisionError: the ice is gone" in run.message
    assert "the best so far is kept" in run.message
    assert len(run.history) == 5
    assert run.message in panel.run.progress.text()


@pytest.mark.parametrize("method", ["pgd", "published", "slsqp"])
def test_a_fault_in_a_solver_ends_the_run_with_a_sentence_and_keeps_the_best_iterate(
    desk, panel, solving, idle, monkeypatch, method
):
    settings = SolverSettings(method=method, rate=1e-12, threshold=1e-300)
    desk.session.apply("Method", lambda project: edits.set_solver(project, settings))

    def broken(*values, **others):
        with closing(solve(*values, **others)) as job:
            for _ in range(7):
                yield next(job)
            raise FloatingPointError("made on purpose")

    monkeypatch.setattr("bobdesk.project.new_run.solve", broken)
    solving.run()
    idle()
    run = desk.session.project.run
    assert run.message.startswith("The solver failed (FloatingPointError: made on purpose) after 6 iterations")
    assert len(run.history) == 7
    assert panel.convergence.plot.data.count == 7
    assert run.message in panel.run.progress.text()
    assert desk.session.undo_label == "Solve, Run 1"

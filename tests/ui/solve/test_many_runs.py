import time
from dataclasses import replace

import pytest

from bobdesk.files.project_file import save_project
from bobdesk.progress import finish
from bobdesk.project import edits
from bobdesk.project.kept_iterates import FIRST_GRADIENT
from bobdesk.project.new_run import new_run
from bobdesk.solve.settings import SolverSettings
from bobdesk.ui.panels.export_panel import ExportPanel
from bobdesk.ui.panels.solve_panel import SolvePanel
from tests.project.made_projects import ready_project

PICTURE = b"\x89PNG not really"


def other_gradients(kept, factor):
    table = kept.table.copy()
    table[:, FIRST_GRADIENT:] *= factor
    return replace(kept, table=table)


@pytest.fixture(scope="module")
def fifty():
    """A project with fifty runs, half of them with a history as long as it may be."""
    project = ready_project(PICTURE)
    slow = edits.set_solver(project, SolverSettings(method="published", rate=1e-12, threshold=1e-300))
    count = [0]

    def enough():
        count[0] += 1
        return count[0] >= 2500

    long = finish(new_run(slow, name="long", clock=time.perf_counter, enough=enough))
    short = finish(new_run(project, name="short", clock=time.perf_counter))
    for number in range(50):
        # Fresh arrays: every run is one of its own, in the file too.
        run = long if number % 2 else short
        own = replace(
            run, name=f"Run {number + 1}", history=run.history + 0.0, gradients=run.gradients + 1e-9 * number,
            layout=replace(run.layout),
            iterates=other_gradients(run.iterates, 1 + 1e-9 * number),
        )  # fmt: skip
        project = edits.keep_run(project, own)
    return project


def test_the_file_stays_small(fifty, tmp_path):
    save_project(fifty, tmp_path / "fifty.bobdesk")
    assert (tmp_path / "fifty.bobdesk").stat().st_size - len(PICTURE) < 20e6


def test_the_panels_stay_quick(fifty, desk, qtbot, idle):
    desk.session.open(fifty, None)
    panel, export = SolvePanel(desk), ExportPanel(desk)
    for one in (panel, export):
        qtbot.addWidget(one)
        one.resize(430, 900)
        one.show()
    idle()
    took = []
    for row in range(0, 50, 5):
        began = time.process_time()
        panel.runs.table.selectRow(row)
        qtbot.waitUntil(lambda row=row: desk.session.project.chosen_run == row)
        took.append(time.process_time() - began)
        idle()
    assert sorted(took)[len(took) // 2] < 0.1, "seconds of the processor to show another run"
    began = time.process_time()
    desk.session.apply("Drop", lambda project: edits.set_drop(project, 61.0))
    assert time.process_time() - began < 0.15
    idle()

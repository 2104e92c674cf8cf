"""An iterate that is looked at is left behind with the step Solve: other steps show, and write, the result."""

import pytest

from bobdesk.ui.panels.solve_panel import SolvePanel
from bobdesk.ui.shown_result import shown_result_of


@pytest.fixture
def scrubbed(whole_window, until):
    """The window in its step Solve, with an iterate on the strips."""
    whole_window.go_to("Solve")
    shown = shown_result_of(whole_window.desk)
    until(lambda: not whole_window.desk.runner.jobs and shown.line is not None)
    panel = whole_window.findChild(SolvePanel)
    panel.convergence.plot.chosen.emit(5)
    assert shown.scrubbed is not None
    assert "shown" in whole_window.layout_of_window.strips_dock.widget().gradient.curves
    return shown


@pytest.mark.parametrize("step", ["Export", "Segments", "Plan"])
def test_another_step_shows_the_result_again(whole_window, scrubbed, step, until):
    plot = whole_window.findChild(SolvePanel).convergence.plot
    whole_window.go_to(step)
    assert scrubbed.scrubbed is None
    assert scrubbed.line is scrubbed.line_of_run(scrubbed.run)
    assert "shown" not in whole_window.layout_of_window.strips_dock.widget().gradient.curves
    whole_window.go_to("Solve")
    assert plot.cursor_number is None
    last = f"{scrubbed.run.nit:,}"
    assert whole_window.findChild(SolvePanel).convergence.reading.text().startswith(f"Iterate {last} of {last}:")
    until(lambda: not whole_window.desk.runner.jobs)


def test_it_stays_while_one_stays(whole_window, scrubbed, until):
    row = scrubbed.scrubbed
    whole_window.go_to("Solve")
    whole_window.actions_by_name["in_space"].trigger()
    assert scrubbed.scrubbed == row
    until(lambda: not whole_window.desk.runner.jobs)

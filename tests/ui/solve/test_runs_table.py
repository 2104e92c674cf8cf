"""The list of runs: differences to a baseline say that they are, deviations are told, keys delete and copy."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest

from bobdesk.project import edits
from bobdesk.project.project import ActualTrack
from bobdesk.track.figures import deviations
from bobdesk.ui.panels.solve_panel import SolvePanel

ACROSS, TIP = Qt.Orientation.Horizontal, Qt.ItemDataRole.ToolTipRole
NUMBERS = range(2, 11)


@pytest.fixture
def panel(desk, opened, solving, shown, idle):
    """Two runs with drops 2 m apart, and an actual track."""
    made = shown(SolvePanel(desk), 430, 1200)
    desk.session.apply("Mean", lambda project: edits.set_mean_gradient(project, 0.09))
    for drop in (60.0, 62.0):
        desk.session.apply("Drop", lambda project, drop=drop: edits.set_drop(project, drop))
        solving.run()
        idle()
    points = np.column_stack([np.linspace(0, 700, 50), np.zeros(50), np.linspace(59, 0, 50)])
    desk.session.apply("Compare", lambda project: edits.compare_with(project, ActualTrack("a.csv", points)))
    idle()
    return made


def cell(panel, row, column, role=Qt.ItemDataRole.DisplayRole):
    model = panel.runs.model
    return model.data(model.index(row, column), role)


def heading(panel, column, role=Qt.ItemDataRole.DisplayRole):
    return panel.runs.model.headerData(column, ACROSS, role)


def choose_baseline(panel, idle):
    panel.runs.table.selectRow(0)
    panel.runs.baseline_button.click()
    idle()


def test_beside_a_baseline_every_number_of_the_other_rows_is_a_difference_with_a_sign(desk, panel, idle):
    first, second = desk.session.project.runs
    before = [cell(panel, 0, column) for column in NUMBERS]
    choose_baseline(panel, idle)
    assert [cell(panel, 0, column) for column in NUMBERS] == before, "the baseline stays as it is"
    assert cell(panel, 1, 3) == "+2.00"
    assert cell(panel, 1, 9).lstrip("+−").replace(",", "") == str(abs(second.nit - first.nit))
    assert all(cell(panel, 1, column)[0] in "+−" for column in NUMBERS)
    assert cell(panel, 2, 3) == "+2.00", "the targets in force"
    assert cell(panel, 2, 5)[:3] in ("≤ +", "≤ −")
    assert cell(panel, 3, 3) == "−1.00", "the actual track"
    assert [cell(panel, row, 9) for row in (2, 3)] == ["", ""]
    panel.runs.baseline_button.click()
    assert cell(panel, 1, 3) == "62.00"
    assert cell(panel, 3, 3) == "59.00"


def test_headings_notes_and_tips_say_what_is_a_difference(panel, idle):
    plain = [heading(panel, column) for column in range(13)]
    choose_baseline(panel, idle)
    assert [heading(panel, column) for column in range(13)] == [
        f"Δ {text}" if column in NUMBERS else text for column, text in enumerate(plain)
    ]
    assert "difference to Run 1" in heading(panel, 3, TIP)
    assert "difference" not in heading(panel, 1, TIP)
    assert cell(panel, 1, 3, TIP).splitlines()[1] == "Run 2: 62.00 m"
    assert cell(panel, 1, 3, TIP).splitlines()[-1] == "+2.00 m from Run 1"
    assert " from Run 1" not in cell(panel, 0, 3, TIP)
    assert "all rows but that of Run 1" in panel.runs.note.text()
    panel.runs.baseline_button.click()
    assert [heading(panel, column) for column in range(13)] == plain
    assert not panel.runs.note.isVisible()


def test_differences_in_degrees_are_those_of_the_degrees_that_are_shown(desk, panel, idle):
    desk.settings.gradient_unit = "degrees"
    shown = [float(cell(panel, row, 5)) for row in (0, 1)]
    choose_baseline(panel, idle)
    assert float(cell(panel, 1, 5).replace("−", "-")) == pytest.approx(shown[1] - shown[0], abs=0.011)
    limit = float(cell(panel, 2, 5).removeprefix("≤ ").replace("−", "-"))
    assert limit == pytest.approx(np.degrees(np.arctan(0.25)) - shown[0], abs=0.011)


def test_the_copied_table_says_which_columns_are_differences(desk, panel, idle, qtbot):
    choose_baseline(panel, idle)
    panel.runs.table.setFocus()
    QTest.keyClick(panel.runs.table, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    head, first, second, *_ = (line.split("\t") for line in QGuiApplication.clipboard().text().splitlines())
    assert head[1:10] == [heading(panel, column).removeprefix("Δ ") + ", difference to Run 1" for column in NUMBERS]
    assert [head[0], *head[10:]] == ["Run", "Method", "End"]
    assert (first[0], second[0]) == ("Run 1 (baseline, as it is)", "Run 2")
    panel.runs.baseline_button.click()
    QTest.keyClick(panel.runs.table, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    head, first, *_ = (line.split("\t") for line in QGuiApplication.clipboard().text().splitlines())
    assert head[1:3] == ["Length m", "Drop m"]
    assert first[0] == "Run 1"


def test_how_far_a_run_is_off_its_targets_is_told_in_percent(desk, panel, idle):
    unit = desk.quantities
    for row, run in enumerate(desk.session.project.runs):
        off = deviations(run.figures, run.inputs.targets)
        panel.runs.table.selectRow(row)
        for column, value in ((2, off.length), (3, off.drop), (4, off.mean_gradient)):
            text = unit.number(value, 3)
            text = text if text.startswith("−") else f"+{text}"
            assert f"{text} % from its target, " in cell(panel, row, column, TIP)
            assert f" {text} %" in panel.runs.off.text()
        assert panel.runs.off.text().startswith(f"{run.name} is off its targets by: length ")
        assert "target" not in cell(panel, row, 5, TIP)
    assert abs(off.mean_gradient) > 1, "the mean of the fixture is another one than drop by length"
    desk.session.apply("Mean", lambda project: edits.set_mean_gradient(project, 0.09, "segments"))
    assert "from its target" not in cell(panel, 0, 4, TIP), "the cell shows another mean than the run's target"
    idle()


def test_tips_of_targets_and_actual_track_are_their_own(panel):
    assert cell(panel, 2, 3, TIP).splitlines() == ["Height difference", "Targets: 62.00 m"]
    assert cell(panel, 3, 3, TIP).splitlines() == ["Height difference", "Actual track: 59.00 m"]
    assert cell(panel, 3, 8, TIP) == "Factor from the plan to true size"


def test_delete_takes_the_selected_run_away_and_undo_brings_it_back(desk, panel, idle, qtbot):
    table, before = panel.runs.table, desk.session.project.runs
    row = table.visualRect(panel.runs.model.index(0, 1)).center()
    qtbot.mouseClick(table.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(row.x(), row.y()))
    assert desk.session.project.chosen_run == 0
    QTest.keyClick(table, Qt.Key.Key_Delete)
    assert desk.session.project.runs == before[1:]
    assert desk.session.undo_label == "Delete run"
    desk.session.undo()
    assert desk.session.project.runs == before
    idle()


def test_delete_takes_no_run_away_where_none_is_selected(desk, panel, idle):
    panel.runs.table.setFocus()
    panel.runs.table.selectRow(2)
    QTest.keyClick(panel.runs.table, Qt.Key.Key_Delete)
    assert len(desk.session.project.runs) == 2
    idle()


def test_deleting_the_baseline_ends_the_differences(desk, panel, idle):
    choose_baseline(panel, idle)
    panel.runs.delete_button.click()
    idle()
    assert heading(panel, 3) == "Drop m"
    assert not panel.runs.note.isVisible()
    assert cell(panel, 0, 3) == "62.00"

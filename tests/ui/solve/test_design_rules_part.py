"""Design rules in the window."""

import json

import pandas as pd
import pytest

from bobdesk.files.project_file import load_project, save_project
from bobdesk.project import edits
from bobdesk.track.design_rules import Rule
from bobdesk.track.sled import Sled
from bobdesk.ui.panels.export_panel import ExportPanel
from bobdesk.ui.solve.usual_rules import usual_rules
from bobdesk.ui.strips.strip_stack import StripStack
from tests.ui.answers import Answers


@pytest.fixture
def solved(desk, opened, solving, idle):
    solving.run()
    idle()


@pytest.fixture
def part(desk, opened, qtbot, idle):
    made = ExportPanel(desk)
    qtbot.addWidget(made)
    made._questions = Answers(desk.settings, made)
    made._reports._questions = made._questions
    made.rules._questions = made._questions
    made.resize(430, 1400)
    made.show()
    idle()
    made.rules.panel_for_test = made
    return made.rules


def row_of(part, name):
    return next(row for row, rule in enumerate(part._rules) if rule.name == name)


def cell(part, name, column):
    return part.model.index(row_of(part, name), column)


def test_without_a_result_it_says_so(part):
    assert part.summary.text() == "There is no result yet to judge: solve first."
    assert part.model.rowCount() == len(usual_rules())
    assert not part.findings_button.isEnabled()


def test_an_empty_list_says_how_the_rules_come_back(solved, part, desk, idle):
    desk.session.apply("Load", lambda project: edits.set_rules(project, ()))
    idle()
    assert part.summary.text().startswith(
        "There are no rules in the list. Usual rules brings back those that come with"
    )
    assert not part.detail.isVisible()
    assert not part.save_button.isEnabled()
    assert not part.findings_button.isEnabled()
    part.reset_button.click()
    idle()
    assert part.model.rowCount() == len(usual_rules())
    assert part.detail.isVisible()
    assert part.save_button.isEnabled()
    assert part.findings_button.isEnabled()


def test_rules_of_which_none_is_ticked_say_so(solved, part, desk, idle):
    rule = Rule("mine", "speed", None, 1.0, is_used=False)
    desk.session.apply("Load", lambda project: edits.set_rules(project, (rule,)))
    idle()
    assert part.summary.text() == "No rule in the list is ticked: nothing is judged."
    assert not part.findings_button.isEnabled()


def test_rules_are_judged_and_say_their_source(solved, part):
    verdicts = [part.finding(row).verdict for row in range(part.model.rowCount())]
    assert "second hand" in part.summary.text()
    assert f"{verdicts.count('kept')} kept, {verdicts.count('broken')} broken" in part.summary.text()
    part.table.selectRow(row_of(part, "mean gradient, first 250 m"))
    assert part.detail.text().startswith("Not judged: it has no limit yet.")
    assert "Source: No figure is known" in part.detail.text()
    assert cell(part, "race length (bobsleigh, from 1993)", 2).data().startswith("! ")


def test_every_cell_can_be_changed_and_undone(solved, part, desk, idle, told):
    name = "largest gradient, Cesana"
    assert part.model.setData(cell(part, name, 4), "2.5")
    idle()
    assert desk.session.project.rules[row_of(part, name)].highest == pytest.approx(0.025)
    found = part.finding(row_of(part, name))
    assert found.verdict == "broken"
    assert found.stretches
    assert part.model.setData(cell(part, name, 4), "")
    idle()
    assert part.finding(row_of(part, name)).why == "it has no limit yet"
    assert not part.model.setData(cell(part, name, 4), "steep")
    assert part.model.setData(cell(part, name, 6), "100")
    assert part.model.setData(cell(part, name, 8), "a book")
    assert not part.model.setData(cell(part, name, 7), "50")
    assert "stretch" in told[-1]
    assert part.model.setData(cell(part, name, 1), "mine")
    for _ in range(5):
        desk.session.undo()
    assert desk.session.project.rules is None
    assert not part.reset_button.isEnabled()
    idle()


def test_a_rule_that_is_not_used_is_not_judged(solved, part, desk, idle):
    from PySide6.QtCore import Qt

    index = cell(part, "design speed", 0)
    part.model.setData(index, Qt.CheckState.Unchecked.value, Qt.ItemDataRole.CheckStateRole)
    idle()
    assert part.finding(index.row()) is None
    assert cell(part, "design speed", 2).data() == ""


def test_add_remove_and_the_usual_ones_again(solved, part, desk, idle):
    count = part.model.rowCount()
    part._on_add("speed")
    assert desk.session.project.rules[-1].name == "Speed"
    assert part.model.rowCount() == count + 1
    part.table.selectRow(count)
    part.remove_button.click()
    assert part.model.rowCount() == count
    part.reset_button.click()
    assert desk.session.project.rules is None
    idle()


def test_a_click_selects_the_stretch_and_the_next_one(solved, part, desk, idle, qtbot):
    stack = StripStack(desk)
    qtbot.addWidget(stack)
    rule = Rule("g", "gradient", None, 0.085)
    desk.session.apply("Rules", lambda project: edits.set_rules(project, [rule, Rule("l", "length", None, 1.0)]))
    idle()
    found = part.finding(0)
    assert len(found.stretches) > 1
    part.table.selectRow(0)
    part._on_clicked()
    assert desk.selection.stretch == pytest.approx(found.stretches[0], abs=1.5)
    assert stack.elevation.selected_range == desk.selection.stretch
    part._on_clicked()
    assert desk.selection.stretch == pytest.approx(found.stretches[1], abs=1.5)
    part.table.selectRow(1)
    part._on_clicked()
    assert desk.selection.stretch[0] == pytest.approx(0)
    stack.clear_range()
    assert desk.selection.stretch is None


def test_another_sled_is_another_finding(solved, part, desk, idle, told):
    before = part.finding(row_of(part, "design speed")).value
    field = part.sled.fields["start_speed"]
    field.entered.emit(30.0)
    idle()
    assert desk.session.project.sled.start_speed == 30.0
    assert part.finding(row_of(part, "design speed")).value > before
    field.entered.emit(-1.0)
    assert "start speed" in told[-1]
    assert desk.session.project.sled.start_speed == 30.0
    desk.session.undo()
    assert desk.session.project.sled == Sled()
    idle()


def test_rules_and_findings_go_through_files(solved, part, desk, idle, tmp_path, told):
    path = tmp_path / "rules.json"
    part._questions.save_path = path
    part.save_button.click()
    assert len(json.loads(path.read_text())["rules"]) == part.model.rowCount()
    desk.session.apply("Rules", lambda project: edits.set_rules(project, []))
    part.take(path)
    assert desk.session.project.rules == usual_rules()
    idle()
    part._questions.save_path = tmp_path / "f.csv"
    part.findings_button.click()
    assert len(pd.read_csv(tmp_path / "f.csv")) == part.model.rowCount()
    bad = tmp_path / "bad.json"
    bad.write_text("{")
    part.take(bad)
    assert "these are no design rules" in told[-1]


def test_they_are_kept_in_the_project(solved, part, desk, idle, tmp_path):
    part.model.setData(cell(part, "design speed", 4), "120")
    part.sled.fields["mass"].entered.emit(390.0)
    desk.session.apply("Error", lambda project: edits.set_plan_error(project, 0.002))
    desk.session.apply("Change", lambda project: edits.set_gradient_change(project, 0.003))
    idle()
    path = tmp_path / "p.bobdesk"
    save_project(desk.session.project, path)
    again = load_project(path)
    assert again.rules == desk.session.project.rules
    assert again.sled.mass == 390.0
    assert again.plan_error == 0.002
    assert again.limits.gradient_change == 0.003


def test_the_report_holds_budget_and_rules(solved, part, desk, idle, tmp_path):
    path = tmp_path / "r.html"
    part._questions.save_path = path
    part.panel_for_test.html_button.click()
    idle()
    text = path.read_text()
    assert "Error budget, 95 %" in text
    assert "left open" in text
    assert "With 95 % the plan length is" in text
    assert "Russian luge rules (FIL), second hand" in text
    assert "not judged: it has no limit yet" in text
    desk.session.apply("Drop", lambda project: edits.set_drop(project, project.targets.drop + 1))
    part.panel_for_test.html_button.click()
    idle()
    text = path.read_text()
    assert "No error budget: the result is out of date." in text
    part._questions.save_path = tmp_path / "r.pdf"
    part.panel_for_test.pdf_button.click()
    idle()
    assert (tmp_path / "r.pdf").read_bytes().startswith(b"%PDF")

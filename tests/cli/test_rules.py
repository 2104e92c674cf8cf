"""`bobdesk rules`."""

import json

import pandas as pd

from bobdesk.files.project_file import save_project
from bobdesk.project import edits
from bobdesk.track.design_rules import Rule
from bobdesk.track.sled import Sled
from tests.cli.calls import TARGETS
from tests.project.made_projects import ready_project, solved_run


def test_a_line_is_judged_by_the_usual_rules_with_their_sources(call):
    line, table = call.path("line.csv"), call.path("f.csv")
    call("reconstruct", call.plan, *TARGETS, "-o", line)
    said = call("rules", line, "-o", table)
    assert said.status == 0, said.err
    rows = pd.read_csv(table)
    assert len(rows) == 11
    assert rows.source.notna().all()
    counts = rows.verdict.value_counts()
    assert f"{counts['kept']} rules kept, {counts['broken']} broken, {counts['not judged']} not judged" in said.out
    assert "race length, men (luge): broken, 703" in said.out
    assert "second hand" in said.out
    assert "not judged, it has no limit yet" in said.out


def test_rules_of_a_file_and_another_sled(call):
    rules = call.path("own.json")
    rules.write_text(json.dumps({"rules": [{"rule": "slow", "unit": "km/h", "max": 60}]}))
    fast, slow, table = Sled(), ("--start-speed", 1, "--drag-area", 9), call.path("f.csv")
    assert fast.drag_area < 9
    call("rules", call.plan, "--rules", rules, "-o", table)
    free = float(pd.read_csv(table).value[0])
    call("rules", call.plan, "--rules", rules, "-o", table, *slow)
    assert float(pd.read_csv(table).value[0]) < free


def test_a_project_brings_its_own_rules_and_sled(call):
    project = ready_project()
    project = edits.keep_run(project, solved_run(project))
    project = edits.set_rules(project, [Rule("mine", "speed", None, 1.0, source="me")])
    project = edits.set_sled(project, Sled(start_speed=33.0))
    path = call.path("p.bobdesk")
    save_project(project, path)
    said = call("rules", path)
    assert said.status == 0, said.err
    assert "mine: broken" in said.out
    assert "1 broken" in said.out
    speed = float(said.out.split("broken, ")[1].split(" km/h")[0])
    assert speed >= 3.6 * 33.0


def project_with(call, *rules):
    project = ready_project()
    project = edits.set_rules(edits.keep_run(project, solved_run(project)), rules)
    path = call.path("p.bobdesk")
    save_project(project, path)
    return path


def test_an_empty_list_of_a_project_says_how_the_rules_come_back(call):
    path, table = project_with(call), call.path("f.csv")
    said = call("rules", path, "-o", table)
    assert said.status == 0, said.err
    assert f"there are no rules in the list of {path}; Usual rules in step 6, Export, brings them back" in said.out
    assert "kept" not in said.out
    assert table.read_text().startswith("rule,")
    usual = said.out.split("--rules ")[1].split(" judges")[0]
    assert len(call("rules", path, "--rules", usual).out.splitlines()) == 12


def test_rules_of_which_none_is_used_say_so(call):
    path = project_with(call, Rule("mine", "speed", None, 1.0, is_used=False))
    assert f"no rule in the list of {path} is ticked" in call("rules", path).out
    own = call.path("own.json")
    own.write_text(json.dumps({"rules": [{"rule": "slow", "unit": "km/h", "max": 60, "used": False}]}))
    assert f'every rule in {own} has "used": false' in call("rules", path, "--rules", own).out


def test_an_empty_file_of_rules_says_what_there_is_without_it(call):
    own = call.path("own.json")
    own.write_text('{"rules": []}')
    said = call("rules", call.plan, "--rules", own)
    assert said.out == f"nothing is judged: there are no rules in {own}; without --rules BobDesk's are taken\n"
    assert "without --rules the project's are taken" in call("rules", project_with(call), "--rules", own).out


def test_one_rule_is_counted_as_one(call):
    path = project_with(call, Rule("mine", "speed", None, 999.0))
    assert "1 rule kept, 0 broken, 0 not judged\n" in call("rules", path).out


def test_refusals(call):
    bad = call.path("bad.json")
    bad.write_text("{}")
    assert "design rules" in call.refused("rules", call.plan, "--rules", bad, status=3)
    assert "mass" in call.refused("rules", call.plan, "--mass", "-1", status=2)
    flat = call.path("flat.csv")
    flat.write_text("x_m,y_m\n0,0\n10,0\n20,0\n30,0\n")
    assert "elevations" in call.refused("rules", flat, status=3)
    call.refused("rules", call.plan, "-o", call.plan, status=2)

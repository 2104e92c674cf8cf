"""A project as PLAN gives what the window gives, and the command line goes before what it says."""

from __future__ import annotations

import json
import zipfile
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from bobdesk.files.exporters.tables import line_table, segments_table
from bobdesk.files.importers.formats import FORMATS, format_of, read_line
from bobdesk.files.project_file import is_project, save_project
from bobdesk.project import derive, edits
from bobdesk.project.derive_runs import run_line
from bobdesk.project.project import Project
from bobdesk.solve.targets import KnownElevation
from tests.project.made_projects import coordinates_project, full_project, ready_project, solved_run


@cache
def decided_project() -> Project:
    """Return a project in which nothing is as it would be without the user."""
    project = edits.flip_segment(ready_project(), 1)
    project = edits.set_spacing(edits.set_smoothing(project, 18.0), 2.0)
    project = edits.set_limits(project, -0.1, 0.22)
    project = edits.set_start(project, 60.0)
    length = derive.centreline(project).needed().length
    project = edits.set_drop(edits.set_length(project, round(1.0052 * length, 2)), round(0.09 * length, 2))
    project = edits.set_known_elevations(project, [KnownElevation(length / 2, 0.05 * length, 0.5)])
    return edits.set_solver(project, replace(project.solver, pgd=replace(project.solver.pgd, transition=4.0)))


def saved(project: Project, path: Path) -> Path:
    save_project(project, path)
    return path


def test_reconstruct_gives_the_line_that_the_window_gives(call):
    project = decided_project()
    plan = saved(project, call.path("p.bobdesk"))
    said = call("reconstruct", plan, "-o", call.path("l.csv"), "--report", call.path("r.json"))
    assert said.status == 0, said
    assert f"its own {len(project.segments)} segments are used" in said.err
    assert call.path("l.csv").read_bytes() == line_table(run_line(solved_run(project)))
    report = json.loads(call.path("r.json").read_text("utf-8"))
    assert report["targets"]["length_m"] == project.targets.length
    assert report["targets"]["min_gradient"] == -0.1
    assert report["targets"]["known"][0]["station"] == derive.targets(project).needed().known[0].station


def test_segment_and_check_take_what_the_project_says(call):
    project = decided_project()
    plan = saved(project, call.path("p.bobdesk"))
    assert call("segment", plan, "-o", call.path("s.csv")).status == 0
    line, segments = derive.centreline(project).needed(), derive.segments(project).needed()
    assert call.path("s.csv").read_bytes() == segments_table(line, segments)
    assert "can all be met" in call("check", plan).out
    assert call("segment", plan, "-o", call.path("s.csv"), "--count", "3").status == 0
    assert len(pd.read_csv(call.path("s.csv"))) == 3


def test_the_command_line_goes_before_the_project(call):
    plan = saved(decided_project(), call.path("p.bobdesk"))
    own = decided_project().targets
    arguments = ["--drop", own.drop + 2, "--max-gradient", "0.2", "--known", f"100:{own.drop - 8}", "--spacing", "1"]
    report = call.path("r.json")
    said = call(
        "reconstruct", plan, "-o", call.path("l.csv"), "--report", report, *arguments, "--method", "slsqp", "--count", 4
    )
    assert said.status == 0, said
    found = json.loads(report.read_text("utf-8"))
    assert found["method"] == "slsqp"
    assert found["targets"]["length_m"] == own.length
    assert found["targets"]["drop_m"] == own.drop + 2
    assert (found["targets"]["min_gradient"], found["targets"]["max_gradient"]) == (-0.1, 0.2)
    assert [(known["station"], known["elevation"]) for known in found["targets"]["known"]] == [(100.0, own.drop - 8)]
    assert len(found["segments"]) == 4
    line = pd.read_csv(call.path("l.csv"))
    assert np.diff(line.station_m).max() < 1.1


def test_a_mean_gradient_of_the_command_line_is_the_usual_one(call):
    project = edits.set_mean_gradient(ready_project(), 0.085, "segments")
    plan = saved(project, call.path("p.bobdesk"))
    for arguments, expected in (
        ((), (0.085, "segments")),
        (("--mean-gradient-is", "drop-per-plan"), (0.085, "drop-per-plan")),
        (("--mean-gradient", "0.09"), (0.09, "drop-per-length")),
    ):
        assert call("check", plan, "--report", call.path("r.json"), *arguments).status == 0
        found = json.loads(call.path("r.json").read_text("utf-8"))["targets"]
        assert (found["mean_gradient"], found["mean_gradient_is"]) == expected


def test_what_neither_says_is_a_wrong_call(call):
    project = edits.set_drop(ready_project(), None)
    plan = saved(project, call.path("p.bobdesk"))
    assert "'--drop': " in call.refused("check", plan, status=2)
    assert "'--length'" in call.refused("check", saved(coordinates_project(), call.path("q.bobdesk")), status=2)
    assert call("check", plan, "--drop", "60").status == 0
    assert "drop must be more than 0 m and less" in call.refused("check", plan, "--drop", "9000", status=3)
    call.refused("check", plan, "--drop", "-3", status=2)


def test_a_plan_of_unknown_scale_is_solved_for_its_scale(call):
    project = edits.find_the_scale(ready_project())
    plan = saved(project, call.path("p.bobdesk"))
    said = call("reconstruct", plan, "-o", call.path("l.csv"), "--report", call.path("r.json"))
    assert said.status == 0, said
    run = solved_run(project)
    assert call.path("l.csv").read_bytes() == line_table(run_line(run))
    scale = json.loads(call.path("r.json").read_text("utf-8"))["scale"]
    assert scale == pytest.approx(run.scale * run.inputs.factor, rel=1e-12)


def test_a_project_is_known_by_what_it_holds(call):
    plan = saved(decided_project(), call.path("p.bobdesk"))
    renamed = call.path("plan.txt")
    renamed.write_bytes(plan.read_bytes())
    assert is_project(renamed)
    assert format_of(renamed.read_bytes(), name="plan.txt").key == "bobdesk"
    assert call("check", renamed).status == 0
    # Another program packs the same parts in another order.
    with zipfile.ZipFile(plan) as archive, zipfile.ZipFile(call.path("packed.bobdesk"), "w", 8) as packed:
        for name in reversed(archive.namelist()):
            packed.writestr(name, archive.read(name))
    assert call("check", call.path("packed.bobdesk")).out == call("check", plan).out
    found = read_line(call.path("packed.bobdesk"))
    assert found.project.name == decided_project().name
    assert not is_project(call.path("nowhere"))
    assert not is_project(call.folder)


def test_projects_are_compared(call):
    project = full_project()
    plan = saved(project, call.path("p.bobdesk"))
    call.path("a.csv").write_bytes(line_table(run_line(project.run)))
    assert call("compare", plan, call.path("a.csv")).out.startswith("elevation: RMS 0.000 m")
    # As ACTUAL a project stands for its actual track.
    actual = project.actual.points
    np.savetxt(call.path("b.csv"), actual, delimiter=",", header="x_m,y_m,z_m", comments="", fmt="%.17g")
    assert call("compare", plan, plan).out == call("compare", plan, call.path("b.csv")).out
    bare = saved(ready_project(), call.path("q.bobdesk"))
    assert "no result yet" in call.refused("compare", bare, call.path("b.csv"), status=3)


def test_a_result_is_exported_though_its_line_is_gone(call):
    project = edits.delete_line(full_project())
    plan = saved(project, call.path("p.bobdesk"))
    said = call("export", plan, "-o", call.path("l.csv"))
    assert said.status == 0
    assert "out of date" in said.err
    assert "there is no line yet" in call.refused("segment", plan, "-o", call.path("s.csv"), status=3)


def test_the_table_of_formats_has_projects():
    assert "bobdesk" in [known.key for known in FORMATS]


def test_segments_of_a_json_line_stay_as_they_are(call):
    project = full_project()
    assert call("export", saved(project, call.path("p.bobdesk")), "-o", call.path("l.json")).status == 0
    written = json.loads(call.path("l.json").read_text("utf-8"))["segments"]
    said = call("segment", call.path("l.json"), "-o", call.path("s.csv"))
    assert f"its own {len(written)} segments are used" in said.err
    table = pd.read_csv(call.path("s.csv"))
    assert table.kind.tolist() == [segment["kind"] for segment in written]
    # Fitting smooths the line anew, so that boundaries move by its change of length.
    assert table.to_m.to_numpy() == pytest.approx([segment["to_m"] for segment in written], rel=1e-3)
    assert call("segment", call.path("l.json"), "-o", call.path("s.csv"), "--count", "2").err == ""
    # What is exported again is what was read, names and all.
    assert call("export", call.path("l.json"), "-o", call.path("m.json")).status == 0
    again = json.loads(call.path("m.json").read_text("utf-8"))["segments"]
    for segment in (*written, *again):
        segment["gradient"] = pytest.approx(segment["gradient"], abs=1e-7)
    assert again == written

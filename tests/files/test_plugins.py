"""Importers, exporters and solvers of other packages, installed as such packages are."""

from __future__ import annotations

import json
import sys
from dataclasses import replace

import numpy as np
import pytest

from bobdesk.cli.main import run
from bobdesk.errors import InputError
from bobdesk.files import plugins
from bobdesk.files.exporters.formats import FORMATS as EXPORTERS
from bobdesk.files.exporters.formats import export_format_of, export_formats, export_line
from bobdesk.files.importers.formats import FORMATS as IMPORTERS
from bobdesk.files.importers.formats import import_formats, read_line
from bobdesk.files.project_file import load_project, save_project
from bobdesk.files.solvers import solver_methods
from bobdesk.project import edits
from bobdesk.solve.run import METHODS
from tests.cli.calls import MUGELLO, TARGETS
from tests.files.exporters.exact_line import exact_line
from tests.project.made_projects import ready_project

_MODULE = """
import numpy as np
from bobdesk.files.exporters.formats import ExportFormat
from bobdesk.files.importers.formats import ImportFormat
from bobdesk.errors import TargetError
from bobdesk.files.importers.imported_line import imported_line
from bobdesk.solve.iterates import Iterate, Solution
from bobdesk.solve.profile import make_profile
from bobdesk.solve.run import SolverMethod

def read(data, *, name):
    if b"burst" in data:
        raise KeyError("pipe")
    numbers = np.array(data.split()[1:], dtype=float).reshape(-1, 2)
    return imported_line(numbers, None, name=name)

def burst(line, options):
    raise ZeroDivisionError("by\\nzero")

good_in = ImportFormat("sled", "Sled", (".sled",), lambda head: head.startswith(b"SLED"), read)
good_out = ExportFormat("sled", "Sled", ".sled", lambda line, options: b"SLED %d" % len(line.points))
bursting = ExportFormat("burst", "Burst", ".burst", burst)
def even(centreline, segments, targets, settings):
    # Every segment falls by the same gradient.
    profile = make_profile(centreline, segments)
    gradient = targets.drop / profile.length
    gradients = np.full(len(profile.edges) - 1, gradient)
    yield Iterate(0, "even", gradients, 0.0, profile.length, targets.drop, 0.0, 0.0)
    if settings.weights.length == 2:
        raise KeyError("two\\nlines")
    if settings.weights.length == 3:
        yield "a word"
    if settings.weights.length == 4:
        return "a word"
    if settings.weights.length == 5:
        gradients = gradients[1:]
    if settings.weights.length == 6:
        gradients = gradients * np.nan
    if settings.weights.length == 7:
        raise TargetError("the plug-in has its reasons")
    return Solution(
        "no matter", profile, gradients, np.zeros(max(len(profile.edges) - 2, 1)), 1.0, targets.drop, 0, "Even.",
        1, 1, 0, 0.0, 0.0,
    )

level = SolverMethod("even", "Even gradient", even, holds_known=False)
unruly = SolverMethod("unruly", "Unruly", lambda *given: 7)
shouting = SolverMethod("Even More!", "Shouting", even)
second_pgd = SolverMethod("pgd", "Not ours", even)
taken = ImportFormat("csv", "Not ours", (), lambda head: True, read)
number = 7
"""
_ENTRIES = """
[bobdesk.importers]
a_good = sled_plugin:good_in
b_missing = sled_plugin:nothing
c_absent = no_such_module:x
d_exits = sled_exits:x
e_taken = sled_plugin:taken
f_number = sled_plugin:number

[bobdesk.exporters]
a_good = sled_plugin:good_out
b_burst = sled_plugin:bursting

[bobdesk.solvers]
a_even = sled_plugin:level
b_unruly = sled_plugin:unruly
c_shouting = sled_plugin:shouting
d_taken = sled_plugin:second_pgd
e_format = sled_plugin:good_in
f_absent = no_such_module:x
"""


@pytest.fixture
def _installed(tmp_path, monkeypatch):
    site = tmp_path / "site"
    about = site / "sled_plugin-1.0.dist-info"
    about.mkdir(parents=True)
    (site / "sled_plugin.py").write_text(_MODULE)
    (site / "sled_exits.py").write_text("raise SystemExit('goodbye')")
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: sled-plugin\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text(_ENTRIES)
    monkeypatch.syspath_prepend(str(site))
    plugins._loaded.cache_clear()
    yield
    plugins._loaded.cache_clear()
    sys.modules.pop("sled_plugin", None)


@pytest.mark.usefixtures("_installed")
def test_a_plugin_reads_its_files(tmp_path):
    path = tmp_path / "a.sled"
    path.write_bytes(b"SLED 0 0 10 0 20 5")
    assert read_line(path).polyline.vertices.tolist() == [[0, 0], [10, 0], [20, 5]]
    path.write_bytes(b"SLED burst")
    with pytest.raises(InputError, match="the plug-in for Sled failed: KeyError"):
        read_line(path)


@pytest.mark.usefixtures("_installed")
def test_a_plugin_writes_lines(tmp_path):
    line = exact_line(spacing=20)
    assert export_format_of(tmp_path / "x.sled").key == "sled"
    assert export_line(line, format="sled") == b"SLED %d" % len(line.points)
    with pytest.raises(InputError, match="the plug-in for Burst failed: ZeroDivisionError: by zero"):
        export_line(line, format="burst")


@pytest.mark.usefixtures("_installed")
def test_plugins_that_cannot_be_used_are_findings_and_do_no_harm(tmp_path):
    found = import_formats()
    assert [known.key for known in found.formats] == [known.key for known in IMPORTERS] + ["sled"]
    assert [finding.plugin for finding in found.findings] == ["b_missing", "c_absent", "d_exits", "e_taken", "f_number"]
    sentences = " ".join(finding.sentence for finding in found.findings)
    for reason in ("AttributeError", "ModuleNotFoundError", "SystemExit: goodbye", "'csv' already", "it is a int"):
        assert reason in sentences
    path = tmp_path / "a.csv"
    path.write_text("x,y\n0,0\n1,0\n2,1\n")
    assert np.array_equal(read_line(path).polyline.vertices, [[0, 0], [1, 0], [2, 1]])


@pytest.mark.usefixtures("_installed")
def test_a_solver_of_another_package_is_a_method_like_any(tmp_path, capsys):
    arguments = ["reconstruct", str(MUGELLO), *TARGETS, "-o", str(tmp_path / "l.csv"), "--report", str(tmp_path / "r")]
    assert run([*arguments, "--method", "even", "--known", "200:20"]) == 0
    said = capsys.readouterr()
    assert "the method even has no known elevations" in said.err
    for plugin in ("c_shouting", "d_taken", "e_format", "f_absent"):
        assert f"note: the plug-in {plugin} (" in said.err
    assert "Even." in said.out
    report = json.loads((tmp_path / "r").read_text("utf-8"))
    assert report["method"] == "even"
    gradients = [segment["gradient"] for segment in report["segments"]]
    assert gradients == pytest.approx([gradients[0]] * len(gradients), rel=1e-6)
    assert report["achieved"]["drop_m"] == pytest.approx(30)


@pytest.mark.usefixtures("_installed")
@pytest.mark.parametrize(
    ("method", "weight", "sentence"),
    [
        ("even", 2, "the method Even gradient failed: KeyError: 'two"),
        ("even", 3, "it yielded a str, not an Iterate"),
        ("even", 4, "it returned a str, not a Solution"),
        ("even", 5, "it returned gradients of the shapes"),
        ("even", 6, "figures that are no numbers"),
        ("even", 7, "the plug-in has its reasons"),
        ("unruly", 1, "the method Unruly failed: TypeError"),
    ],
)
def test_a_solver_that_fails_is_one_sentence(tmp_path, capsys, method, weight, sentence):
    output = tmp_path / "l.csv"
    chosen = ["--method", method, "--weight-length", str(weight)]
    assert run(["reconstruct", str(MUGELLO), *TARGETS, "-o", str(output), *chosen]) == 3
    *_, last = capsys.readouterr().err.splitlines()
    assert last.startswith("bobdesk: ")
    assert sentence in last
    assert not output.exists()


@pytest.mark.usefixtures("_installed")
def test_a_project_keeps_the_method_of_a_plugin_and_opens_without_it(tmp_path, capsys):
    project = ready_project()
    project = edits.set_solver(project, replace(project.solver, method="even"))
    path = tmp_path / "p.bobdesk"
    save_project(project, path)
    assert load_project(path).solver.method == "even"
    assert run(["reconstruct", str(path), "-o", str(tmp_path / "l.csv")]) == 0
    plugins._loaded.cache_clear()
    sys.path.pop(0)
    assert [method.key for method in solver_methods().formats] == [method.key for method in METHODS]
    assert load_project(path).solver.method == "even"
    assert run(["reconstruct", str(path), "-o", str(tmp_path / "m.csv")]) == 3
    assert "there is no method 'even'" in capsys.readouterr().err
    assert run(["reconstruct", str(path), "-o", str(tmp_path / "m.csv"), "--method", "pgd"]) == 0


def test_a_method_that_is_not_there_is_a_wrong_call(tmp_path, capsys):
    assert run(["reconstruct", str(MUGELLO), *TARGETS, "-o", str(tmp_path / "l.csv"), "--method", "magic"]) == 2
    assert (
        "--method must be one of pgd, published, lbfgsb, slsqp, trustconstr, de, not 'magic'" in capsys.readouterr().err
    )


def test_without_plugins_there_are_the_built_in_formats_alone():
    assert import_formats().formats == IMPORTERS
    assert export_formats().formats == EXPORTERS
    assert import_formats().findings == ()

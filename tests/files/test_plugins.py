"""Importers and exporters of other packages, installed as such packages are."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from bobdesk.errors import InputError
from bobdesk.files import plugins
from bobdesk.files.exporters.formats import FORMATS as EXPORTERS
from bobdesk.files.exporters.formats import export_format_of, export_formats, export_line
from bobdesk.files.importers.formats import FORMATS as IMPORTERS
from bobdesk.files.importers.formats import import_formats, read_line
from tests.files.exporters.exact_line import exact_line

_MODULE = """
import numpy as np
from bobdesk.files.exporters.formats import ExportFormat
from bobdesk.files.importers.formats import ImportFormat
from bobdesk.files.importers.imported_line import imported_line

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


def test_without_plugins_there_are_the_built_in_formats_alone():
    assert import_formats().formats == IMPORTERS
    assert export_formats().formats == EXPORTERS
    assert import_formats().findings == ()

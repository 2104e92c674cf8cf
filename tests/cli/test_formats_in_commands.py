"""PLAN, LINE and ACTUAL may be any format that is read; `export` writes any that is written."""

from __future__ import annotations

import pytest

from bobdesk.cli.main import run
from bobdesk.files.exporters.formats import export_line
from bobdesk.files.importers.formats import read_line
from bobdesk.plan.projection import Georeference
from tests.files.exporters.exact_line import exact_line
from tests.files.importers import made_files as made


@pytest.mark.parametrize("format", list(made.ALL))
def test_every_format_is_a_plan(tmp_path, format):
    plan = tmp_path / f"plan.{format}"
    plan.write_bytes(made.ALL[format]())
    assert run(["segment", str(plan), "-o", str(tmp_path / "S.csv")]) == 0
    assert (tmp_path / "S.csv").read_text().startswith("segment,kind")


def test_lines_of_two_formats_are_compared(tmp_path, capsys):
    line = exact_line()
    (tmp_path / "a.csv").write_bytes(export_line(line))
    (tmp_path / "b.kml").write_bytes(export_line(line, format="kml", georeference=Georeference(12.0, 46.0)))
    assert run(["compare", str(tmp_path / "a.csv"), str(tmp_path / "b.kml")]) == 0
    assert "elevation: RMS 0.000 m" in capsys.readouterr().out
    (tmp_path / "c.svg").write_bytes(made.svg())
    assert run(["compare", str(tmp_path / "a.csv"), str(tmp_path / "c.svg")]) == 3
    assert "there are no elevations" in capsys.readouterr().err


@pytest.mark.parametrize("ending", ["json", "dxf", "xodr", "figures.csv"])
def test_export_writes_the_format_that_the_name_asks_for(tmp_path, ending):
    line = exact_line()
    (tmp_path / "LINE.csv").write_bytes(export_line(line))
    target = tmp_path / f"out.{ending}"
    assert run(["export", str(tmp_path / "LINE.csv"), "-o", str(target)]) == 0
    assert target.stat().st_size > 500
    if ending in ("json", "dxf"):
        assert (read_line(target).polyline.vertices == line.points[:, :2]).all()


def test_export_keeps_the_place_on_the_earth(tmp_path, capsys):
    content = export_line(exact_line(), format="geojson", georeference=Georeference(12.0, 46.0))
    (tmp_path / "a.geojson").write_bytes(content)
    assert run(["export", str(tmp_path / "a.geojson"), "-o", str(tmp_path / "a.kml")]) == 0
    assert read_line(tmp_path / "a.kml").georeference == Georeference(12.0, 46.0)
    (tmp_path / "LINE.csv").write_bytes(export_line(exact_line()))
    assert run(["export", str(tmp_path / "LINE.csv"), "-o", str(tmp_path / "b.kml")]) == 3
    assert "no place on the Earth" in capsys.readouterr().err
    assert not (tmp_path / "b.kml").exists()


def test_export_refuses_wrong_calls(tmp_path, capsys):
    (tmp_path / "LINE.csv").write_bytes(export_line(exact_line()))
    line, target = str(tmp_path / "LINE.csv"), str(tmp_path / "x.json")
    assert run(["export", line, "-o", target, "--format", "docx"]) == 2
    assert run(["export", line, "-o", target, "--flavour", "tab"]) == 2
    assert run(["export", line, "-o", str(tmp_path / "x.docx")]) == 3
    assert run(["export", line, "-o", str(tmp_path / "x.dat"), "--format", "csv", "--flavour", "xyz"]) == 0
    assert (tmp_path / "x.dat").read_text().count(",") == 2 * 1201
    errors = capsys.readouterr().err
    assert "Traceback" not in errors
    assert not (tmp_path / "x.json").exists()

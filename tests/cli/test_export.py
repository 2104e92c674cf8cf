from __future__ import annotations

import csv
import io
from pathlib import Path

import pytest

from bobdesk.cli.main import run
from bobdesk.files.importers.line3d import read_line3d
from bobdesk.files.project_file import save_project
from bobdesk.project import derive, edits
from bobdesk.project.project import Project
from tests.project.made_projects import coordinates_project, full_project, ready_project


def saved(project: Project, folder: Path) -> str:
    path = folder / "track.bobdesk"
    save_project(project, path)
    return str(path)


def test_the_shown_run_is_written_as_csv(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = tmp_path / "line.csv"
    assert run(["export", saved(full_project(), tmp_path), "-o", str(output)]) == 0
    rows = list(csv.DictReader(io.StringIO(output.read_text())))
    shown = full_project().run
    assert shown is not None
    assert float(rows[-1]["s_m"]) == pytest.approx(shown.figures.length, abs=1e-5)
    assert float(rows[0]["z_m"]) == pytest.approx(shown.figures.drop, abs=1e-5)
    assert f"CSV, {len(rows)} rows; written to" in capsys.readouterr().out


def test_flavours_and_another_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    project, output = saved(full_project(), tmp_path), tmp_path / "line.txt"
    call = ["export", project, "-o", str(output), "--format", "csv", "--flavour", "excel-european", "--run", "Run 1"]
    assert run(call) == 0
    assert output.read_bytes().startswith(b"\xef\xbb\xbfstation_m;s_m;")
    assert "out of date: the segments changed" in capsys.readouterr().err
    assert run([*call[:-1], "none such"]) == 3
    assert "there is no run named none such; there are Run 1, Run 2" in capsys.readouterr().err


@pytest.mark.parametrize("kind", ["json", "dxf"])
def test_other_formats_hold_the_same_line(kind: str, tmp_path: Path) -> None:
    output = tmp_path / f"line.{kind}"
    assert run(["export", saved(full_project(), tmp_path), "-o", str(output)]) == 0
    line = read_line3d(output).line
    shown = full_project().run
    assert shown is not None
    assert line.slope_lengths[-1] == pytest.approx(shown.figures.length, abs=1e-5)
    assert line.elevations[0] == pytest.approx(shown.figures.drop, abs=1e-5)


def test_a_project_without_a_result_is_a_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = tmp_path / "line.csv"
    assert run(["export", saved(ready_project(), tmp_path), "-o", str(output)]) == 3
    assert capsys.readouterr().err.endswith("the project has no result yet; solve it first.\n")
    assert not output.exists()


def test_a_project_is_a_plan(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    project = coordinates_project()
    output = tmp_path / "segments.csv"
    assert run(["segment", saved(project, tmp_path), "-o", str(output)]) == 0
    length = derive.centreline(project).needed().length
    assert f"{length:.2f} m of plan" in capsys.readouterr().out
    unready = edits.delete_line(ready_project())
    assert run(["segment", saved(unready, tmp_path), "-o", str(output)]) == 3
    assert "there is no line yet" in capsys.readouterr().err

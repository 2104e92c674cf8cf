import json

import numpy as np
import pytest
from PySide6.QtGui import QGuiApplication

from bobdesk.files.exporters.written import preview, written_totals
from bobdesk.files.importers.line3d import read_line3d
from bobdesk.project import edits
from bobdesk.project.derive_runs import run_line
from bobdesk.project.project import ActualTrack, ExportChoice
from bobdesk.track.comparison import compare
from bobdesk.ui.panels.export_panel import ExportPanel
from tests.ui.answers import Answers


@pytest.fixture
def panel(desk, opened, solving, idle, qtbot):
    solving.run()
    idle()
    points = np.column_stack([np.linspace(0, 700, 200), np.zeros(200), 61 * np.linspace(1, 0, 200) ** 1.3])
    desk.session.apply("Compare", lambda project: edits.compare_with(project, ActualTrack("a.csv", points)))
    made = ExportPanel(desk)
    qtbot.addWidget(made)
    made._questions = Answers(desk.settings, made)
    made._reports._questions = made._questions
    made.show()
    idle()
    return made


def test_what_is_shown_is_what_is_written(panel, tmp_path, told):
    path = tmp_path / "line.csv"
    panel._questions.save_path = path
    panel.save_button.click()
    content = path.read_bytes()
    assert panel.text.toPlainText() == preview(content)
    head = panel.text.toPlainText().splitlines()[:20]
    assert head == content.decode().splitlines()[:20]
    assert panel.text.toPlainText().splitlines()[-1] == content.decode().splitlines()[-1]
    assert told == ["Written to line.csv."]


def test_saving_again_asks_nothing(panel, tmp_path, desk, idle):
    path = tmp_path / "line.csv"
    panel._questions.save_path = path
    panel.save_button.click()
    assert panel.save_button.text() == "Save line.csv"
    path.unlink()
    panel._questions.asked.clear()
    panel.take_focus()
    panel.save_button.click()
    assert path.exists()
    assert panel._questions.asked == []


@pytest.mark.parametrize("flavour", ["default", "excel-european", "tab", "xyz"])
def test_totals_are_those_of_the_rounded_rows(panel, desk, flavour, idle, tmp_path):
    desk.session.apply("Flavour", lambda project: edits.choose_export(project, ExportChoice("csv", flavour)))
    idle()
    run = desk.session.project.run
    totals = panel.later.value.totals
    assert totals.rows == len(run_line(run).stations)
    assert totals.length == pytest.approx(run.figures.length, abs=1e-9)
    assert totals.drop == pytest.approx(run.figures.drop, abs=1e-9)


def test_rows_at_another_distance_keep_drop_and_known_elevations(panel, desk, idle):
    desk.session.apply("Spacing", lambda project: edits.choose_export(project, ExportChoice(spacing=10.0)))
    idle()
    run = desk.session.project.run
    line = run_line(run, 10.0)
    assert np.diff(line.stations).max() == pytest.approx(10.0, rel=0.05)
    assert panel.later.value.totals.drop == pytest.approx(run.figures.drop, abs=1e-6)
    known = run.inputs.targets.known[0]
    at = np.interp(known.station, line.stations, line.elevations)
    dense = run_line(run)
    assert at == pytest.approx(np.interp(known.station, dense.stations, dense.elevations), abs=1e-6)


def test_read_again_by_compare_it_gives_the_numbers_of_the_table(panel, desk, tmp_path):
    path = tmp_path / "line.csv"
    panel._questions.save_path = path
    panel.save_button.click()
    again = compare(read_line3d(path).line.points, desk.session.project.actual.points)
    unit = desk.quantities
    rows = {row.name: row for row in panel.figures._rows}
    assert rows["z RMS, m"].run == unit.length(again.z_rms, 2, unit=False)
    assert rows["z RMS, m"].deviation == f"{unit.number(again.z_rms_percent, 3)} %"
    assert rows["z largest, m"].run == unit.length(again.z_max, 2, unit=False)
    assert rows["Length, m"].deviation == f"{unit.number(again.length_percent, 3)} %"
    assert rows["Drop, m"].deviation == f"{unit.number(again.drop_percent, 3)} %"
    assert rows["Mean gradient, %"].deviation == f"{unit.number(again.mean_gradient_percent, 3)} %"
    assert rows["Plan length, m"].deviation == f"{unit.number(again.plan_length_percent, 3)} %"


@pytest.mark.parametrize("key", ["csv", "json", "dxf", "xodr", "figures"])
def test_every_format_can_be_seen(panel, desk, key, idle):
    desk.session.apply("Format", lambda project: edits.choose_export(project, ExportChoice(key)))
    idle()
    assert panel.later.value is not None, panel.later.problem
    assert panel.text.toPlainText()
    assert panel.flavour.isVisible() == (key in ("csv", "figures"))


def test_what_cannot_be_written_is_said(panel, desk, idle):
    desk.session.apply("Format", lambda project: edits.choose_export(project, ExportChoice("kml")))
    idle()
    assert "longitudes and latitudes" in panel.size_label.text()
    assert not panel.save_button.isEnabled()


def test_the_way_of_export_is_kept_with_the_project(panel, desk, idle, tmp_path):
    from bobdesk.files.project_file import load_project, save_project

    choice = ExportChoice("csv", "tab", 2.5)
    desk.session.apply("Export", lambda project: edits.choose_export(project, choice))
    save_project(desk.session.project, tmp_path / "p.bobdesk")
    assert load_project(tmp_path / "p.bobdesk").export == choice
    idle()


def test_copies(panel):
    panel.copy()
    assert QGuiApplication.clipboard().text().encode() == panel.later.value.content
    panel.figures.copy()
    lines = QGuiApplication.clipboard().text().splitlines()
    assert {line.count("\t") for line in lines} == {4}


def test_without_a_result_it_says_so(desk, opened, qtbot, idle):
    panel = ExportPanel(desk)
    qtbot.addWidget(panel)
    assert "solve" in panel.state.text()
    idle()


def test_a_disk_that_refuses_is_told(panel, tmp_path, told):
    panel._questions.save_path = tmp_path / "none" / "line.csv"
    panel.save_button.click()
    assert len(told) == 1
    assert "line.csv" in told[0]


@pytest.mark.parametrize("kind", ["pdf", "html"])
def test_reports(panel, tmp_path, kind, idle, told, desk):
    desk.session.apply("Notes", lambda project: edits.write_notes(project, "by <me> & you"))
    path = tmp_path / f"report.{kind}"
    panel._questions.save_path = path
    panel._reports.save(kind)
    idle()
    content = path.read_bytes()
    if kind == "pdf":
        assert content.startswith(b"%PDF")
        assert len(content) > 20_000
    else:
        text = content.decode()
        assert text.count("data:image/png;base64,") == 2
        assert "by &lt;me&gt; &amp; you" in text
        assert desk.quantities.length(desk.session.project.run.figures.length, 3) in text


def test_totals_of_what_is_no_line():
    assert written_totals(b"figure,value\nlength,3\n", name="a.figures.csv") is None
    assert written_totals(json.dumps({"type": "x"}).encode(), name="a.geojson") is None

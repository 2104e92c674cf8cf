"""The mission: from a picture of a plan to a 3D line in a file, by mouse and keys alone, checked against the truth."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from bobdesk.files.importers.line3d import read_line3d
from bobdesk.track.comparison import compare
from tests.journeys.gestures import EDITING, scale_by_two_points, trace_by_two_clicks

SAMPLE = Path(__file__).parent.parent.parent / "resources" / "samples" / "made_thin"
_STRIP = "window.layout_of_window.strips_dock.widget().curvature"

_SEGMENTS = "__import__('bobdesk.project.derive', fromlist=['segments']).segments(project)"


def place_on_strip(program, station):
    """Where a station is on the curvature strip, on the screen."""
    found = program.ask(
        f"(lambda strip, on: [strip.mapToGlobal(strip.rect().topLeft()).x() + on.x({station}),"
        f" strip.mapToGlobal(strip.rect().topLeft()).y() + on.area.top() + 3])({_STRIP}, {_STRIP}.geometry_now())"
    )
    return tuple(found)


def fill(program, name, text):
    program.click_on(name)
    program.key("ctrl+a")
    program.type(text)
    program.key("Tab")


def test_the_mission(opened, tmp_path):
    about = json.loads((SAMPLE / "truth.json").read_text())
    truth = np.genfromtxt(SAMPLE / "truth.csv", delimiter=",", names=True)
    plan, actual, out = tmp_path / "plan.jpg", tmp_path / "truth.csv", tmp_path / "line.csv"
    shutil.copyfile(SAMPLE / "plan.jpg", plan)
    shutil.copyfile(SAMPLE / "truth.csv", actual)
    program = opened(tmp_path / "home")
    program.drop_file(plan, 700, 500)
    program.until("desk.picture.image is not None")

    # Scale and line.
    program.key("ctrl+2")
    program.click_on("plan_view")
    scale_by_two_points(program, (truth[0], truth[-1]))
    trace_by_two_clicks(program, about["start_px"], about["end_px"])

    # One boundary, dragged on the strip.
    program.key("ctrl+4")
    program.until(f"{_STRIP}.isVisible()")
    program.until(f"{_SEGMENTS}.value is not None")
    boundary = program.ask(f"{_SEGMENTS}.value[2].start")
    program.until(f"{_STRIP}.geometry_now() is not None")
    start = place_on_strip(program, boundary)
    end = place_on_strip(program, boundary + 8)
    program.drag(start, end)
    program.until("project.segments is not None")
    program.key("ctrl+z")
    program.until("project.segments is None")
    program.key("ctrl+y")
    program.until("project.segments is not None")

    # Targets, and the run with its plot growing.
    program.key("ctrl+5")
    fill(program, "Length (3D)", f"{about['length_m']:.2f}")
    fill(program, "Height difference", f"{about['drop_m']:.2f}")
    program.until("project.targets.drop is not None and project.targets.length is not None")
    program.until("any(text.startswith('✓ These figures can all be met') for text in texts())")
    # Two elevations that are known, at the thirds.
    for count, share in enumerate((1 / 3, 2 / 3), 1):
        station = share * about["plan_length_m"]
        row = round(station)
        program.ask(f"setattr(desk.selection, 'station', {station})")
        program.click_on("Add")
        program.until(EDITING)
        program.type(f"{truth['z_m'][row] - truth['z_m'].min():.2f}")
        program.key("Return")
        program.until(f"len(project.known_elevations) == {count}")
    program.key("F5")
    program.until("project.run is not None and not desk.session.is_saved")
    program.until("widget('convergence_plot').data is not None and widget('convergence_plot').data.count > 10")
    assert program.ask("widget('convergence_plot').data.count") == program.ask("project.run.nit + 1")

    # The true line beside it.
    program.key("ctrl+shift+p")
    program.type("Compare with a file")
    program.key("Return")
    program.until("widget('fileNameEdit').isVisible()")
    program.key("ctrl+a")
    program.type(str(actual))
    program.key("Return")
    program.until("len([top for top in __import__('PySide6.QtWidgets', fromlist=['QApplication'])"
                  ".QApplication.topLevelWidgets() if top.isVisible()]) > 1 or project.actual is not None")  # fmt: skip
    if program.ask("project.actual is None"):
        program.key("Return")
    program.until("project.actual is not None")

    # The file.
    program.key("ctrl+e")
    program.until("window.focusWidget() is not None and 'Save' in window.focusWidget().accessibleName()")
    program.until("window.focusWidget().isEnabled()")
    program.key("Return")
    program.until("widget('fileNameEdit').isVisible()")
    program.key("ctrl+a")
    program.type(str(out))
    program.key("Return")
    program.until(f"__import__('pathlib').Path({str(out)!r}).exists()")
    shown = program.ask("[row.run for row in window.panels._shown['Export'].figures._rows]")

    line = read_line3d(out).line
    true = np.column_stack([truth["x_m"], truth["y_m"], truth["z_m"]])
    found = compare(line.points, true)
    assert abs(found.length_percent) < 0.1
    assert abs(found.drop_percent) < 0.1
    assert found.z_rms_percent < 4
    assert f"{found.z_rms:.2f}" in shown
    apart = np.hypot(
        *(line.points[:, :2] - true[np.abs(truth["station_m"][:, None] - line.stations).argmin(axis=0), :2]).T
    )
    assert np.median(apart) < 1.0
    assert program.ask("float(window.panels._shown['Export'].later.value.totals.drop)") == pytest.approx(
        about["drop_m"], abs=0.01
    )

    # Ctrl+E, then Enter, writes it again.
    out.unlink()
    program.key("ctrl+e", "Return")
    program.until(f"__import__('pathlib').Path({str(out)!r}).exists()")
    program.picture(tmp_path / "end.png")
    program.key("F9")
    program.until("window.views.is_in_space")
    program.key("ctrl+s")
    program.until("widget('fileNameEdit').isVisible()")
    program.key("ctrl+a")
    program.type(str(tmp_path / "mission.bobdesk"))
    program.key("Return")
    program.until("desk.session.is_saved")
    program.key("ctrl+q")
    assert program.wait_for_end() == 0

"""From a dropped picture to a calibrated line, by mouse and keys alone; then a crash, and on it goes."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from bobdesk.files.project_file import load_project
from bobdesk.project import derive
from tests.journeys.gestures import scale_by_two_points, trace_by_two_clicks

SAMPLE = Path(__file__).parent.parent.parent / "resources" / "samples" / "made_thin"


@pytest.fixture
def truth():
    return np.genfromtxt(SAMPLE / "truth.csv", delimiter=",", names=True)


def deviation(project, truth):
    """Mean distance of the line's vertices from the true line, pixels."""
    import shapely

    line = shapely.LineString(np.column_stack([truth["px"], truth["py"]]))
    return float(np.mean(shapely.distance(shapely.points(project.trace.points), line)))


def steps_to_the_start(program):
    count = 0
    while program.ask("desk.session.undo_label") is not None:
        program.key("ctrl+z")
        count += 1
        assert count < 50
    return count


def test_whole_way_with_a_crash_in_the_middle(opened, tmp_path, truth):
    home = tmp_path / "home"
    plan = tmp_path / "igls.jpg"
    shutil.copyfile(SAMPLE / "plan.jpg", plan)
    about = json.loads((SAMPLE / "truth.json").read_text())
    first, last = truth[0], truth[-1]

    program = opened(home)
    program.drop_file(plan, 700, 500)
    program.until("desk.picture.image is not None")
    assert program.ask("project.picture.name") == "igls.jpg"

    # The scale, by two points with known coordinates.
    program.key("ctrl+2")
    program.click_on("plan_view")
    scale_by_two_points(program, (first, last))

    # The line, from two clicks.
    trace_by_two_clicks(program, about["start_px"], about["end_px"])
    traced = program.ask("len(project.trace.points)")

    # One vertex: drawn off its place, taken back, and corrected by a nudge.
    program.key("s")
    index = traced // 2
    at = program.ask(f"project.trace.points[{index}].tolist()")
    for _ in range(12):
        program.move(*program.ask(f"plan({at[0]}, {at[1]})"))
        program._hand("click", "4")
    program.until("window.view.transform().m11() > 4")
    start = program.ask(f"plan({at[0]}, {at[1]})")
    program.drag(tuple(start), (start[0] + 40, start[1] + 30))
    program.until(f"abs(project.trace.points[{index}][0] - {at[0]}) > 1")
    program.key("ctrl+z")
    program.until(f"project.trace.points[{index}].tolist() == {at}")
    program.click(*start)
    program.until(f"desk.selection.vertices == ({index},)")
    program.key("ctrl+Right")
    program.until(f"0 < project.trace.points[{index}][0] - {at[0]} < 0.1")

    # Back to the start, and forward again.
    before = program.ask("project.trace.points.tolist()")
    steps = steps_to_the_start(program)
    assert steps >= 4
    assert program.ask("project.picture") is None
    for _ in range(steps):
        program.key("ctrl+y")
    program.until("desk.session.redo_label is None")
    assert program.ask("project.trace.points.tolist()") == before

    # Saved, changed, and killed.
    saved = tmp_path / "igls.bobdesk"
    program.key("ctrl+s")
    program.until("widget('fileNameEdit').isVisible()")
    program.key("ctrl+a")
    program.type(str(saved))
    program.key("Return")
    program.until("desk.session.is_saved")
    assert deviation(load_project(saved), truth) < 0.5
    program.key("v")
    program.until("not desk.session.is_saved")
    turned = program.ask("project.trace.points[0].tolist()")
    program.until("window.documents.keeper._recovery.wait(0.01)")
    program.kill()
    assert load_project(saved).trace.points[0].tolist() != turned

    # Opened again: what was not saved is offered, and on it goes.
    program = opened(home)
    program.click_on("Recover")
    program.until("desk.session.is_open")
    assert program.ask("project.trace.points[0].tolist()") == turned
    program.click_on("plan_view")
    program.key("v", "ctrl+s")
    program.until("desk.session.is_saved")
    program.key("ctrl+q")
    assert program.wait_for_end() == 0

    project = load_project(saved)
    assert deviation(project, truth) < 0.5
    length = derive.polyline(project).needed()
    assert len(length.vertices) == traced
    assert derive.calibration(project).needed().metres_per_pixel == pytest.approx(about["metres_per_pixel"], rel=1e-3)

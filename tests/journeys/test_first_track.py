"""The guide's page "First track in ten minutes", done word for word by a newcomer with mouse and keys."""

import re

import numpy as np
import pytest

from bobdesk.files.importers.line3d import read_line3d
from bobdesk.track.comparison import compare
from tests.journeys.gestures import EDITING
from tests.journeys.real_window import ROOT

PAGE = (ROOT / "resources" / "guide" / "first-track.md").read_text("utf-8")
SAMPLE = ROOT / "resources" / "samples" / "mugello"
# Where a newcomer sees them in the picture: the ends of the scale bar, START and FINISH. A hand is a pixel off.
BAR = ((40.4, 2113.0), (439.4, 2113.5))
LINE = ((1795.5, 160.5), (160.5, 2002.5))


def said(pattern):
    """A figure that the page tells to type."""
    return re.search(pattern, PAGE)[1]


def known_elevations():
    return [(float(a), float(b)) for a, b in re.findall(r"^\| ([\d.]+) \| ([\d.]+) \|$", PAGE, re.MULTILINE)]


def zoom_in_on(program, place):
    program.move(*program.ask(f"plan{place}"))
    for _ in range(12):
        program._hand("click", "4")
    program.until("window.view.transform().m11() > 2")


def fill(program, name, text):
    program.click_on(name)
    program.key("ctrl+a")
    program.type(text)
    program.key("Tab")


def place_on_elevation_strip(program, station):
    strip = "widget('strips').elevation"
    return tuple(
        program.ask(
            f"(lambda strip, on: [strip.mapToGlobal(strip.rect().topLeft()).x() + on.x({station}),"
            f" strip.mapToGlobal(strip.rect().topLeft()).y() + on.area.top() + 6])({strip}, {strip}.geometry_now())"
        )
    )


def test_the_first_track_comes_out_as_the_page_says(opened, tmp_path):
    program = opened(tmp_path / "home")
    out = tmp_path / "line.csv"

    # The page itself, from the start page.
    program.click_on("First track in ten minutes")
    program.until("window.guide.window is not None and window.guide.window.isActiveWindow()")
    assert program.ask("window.guide.window.browser.page.name") == "first-track.md"
    program.key("ctrl+w")
    program.until("window.isActiveWindow()")

    # 1. Open the picture.
    program.key("alt+h", "p")
    program.until("desk.picture.image is not None")

    # 2. Give it a scale.
    program.key("ctrl+2")
    program.click_on("Add distance")
    for place in BAR:
        program.key("ctrl+0")
        zoom_in_on(program, place)
        program.click_plan(*place)
    program.until("widget('plan_popup').isVisible()")
    program.type(said(r"Type (\d+) and press `Enter`"))
    program.key("Return")
    program.until("len(project.known_distances) == 1")
    metres = program.ask(
        "__import__('bobdesk.project.derive', fromlist=['x']).calibration(project).needed().metres_per_pixel"
    )
    assert metres == pytest.approx(float(said(r"about ([\d.]+) m per pixel")), abs=0.002)

    # 3. Trace the line.
    program.key("ctrl+3", "ctrl+0")
    program.click_on("Trace")
    for place in LINE:
        program.click_plan(*place)
    program.until("project.trace is not None")
    low, high = (float(said(pattern)) for pattern in (r"between\s+(\d+) and", r"between\s+\d+ and (\d+) m"))
    length = program.ask("__import__('bobdesk.project.derive', fromlist=['x']).centreline(project).needed().length")
    assert low < length < high

    # 4. Segments, as they are found.
    program.key("ctrl+4")
    program.until("widget('strips')._now.is_current and len(widget('strips')._now.segments) > 4")

    # 5. What is known, and solve.
    program.key("ctrl+5")
    fill(program, "Length (3D)", said(r"Type ([\d.]+) in \*\*Length"))
    fill(program, "Height difference", said(r"and ([\d.]+) in \*\*Height"))
    program.until("project.targets.drop is not None")
    program.until("any(text.startswith(('✓', '!')) and 'm' in text for text in texts())")
    green = "any(text.startswith('✓ These figures can all be met') for text in texts())"
    if not program.ask(green):
        offer = program.until("[text for text in texts() if text.startswith('Use f =')]")
        program.click_on(offer[0])
    program.until(green)
    program.key("F5")
    program.until("project.run is not None")

    # 6. Tell it more.
    for count, (station, elevation) in enumerate(known_elevations(), 1):
        program.click(*place_on_elevation_strip(program, station))
        program.click_on("Add")
        program.until(EDITING)
        program.type(str(elevation))
        program.key("Return")
        program.until(f"len(project.known_elevations) == {count}")
        program.until(f"any(one.elevation == {elevation} for one in project.known_elevations)")
    assert program.ask("[round(one.station, -1) for one in project.known_elevations]") == [200, 400, 600]
    program.key("F5")
    program.until("len(project.runs) == 2")

    # 7. Take it with you.
    program.key("ctrl+e")
    program.until("window.focusWidget() is not None and 'Save' in window.focusWidget().accessibleName()")
    program.until("window.focusWidget().isEnabled()")
    program.key("Return")
    program.until("widget('fileNameEdit').isVisible()")
    program.key("ctrl+a")
    program.type(str(out))
    program.key("Return")
    program.until(f"__import__('pathlib').Path({str(out)!r}).exists()")

    line = read_line3d(out).line
    truth = np.genfromtxt(SAMPLE / "mugello.csv", delimiter=",", names=True)
    found = compare(line.points, np.column_stack([truth["x_m"], truth["y_m"], truth["z_m"]]))
    assert abs(found.drop_percent) < 0.1
    assert abs(found.length_percent) < 0.1
    assert found.z_rms_percent < 8
    program.key("ctrl+s")
    program.until("widget('fileNameEdit').isVisible()")
    program.key("ctrl+a")
    program.type(str(tmp_path / "first.bobdesk"))
    program.key("Return")
    program.until("desk.session.is_saved")
    program.key("ctrl+q")
    assert program.wait_for_end() == 0
    assert program.output == ""

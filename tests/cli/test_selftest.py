"""What is installed tries itself out, in a process of its own as installers call it."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
START = "import sys; from bobdesk.__main__ import main; sys.exit(main())"
PICTURES = {"PNG", "JPEG", "TIFF", "WEBP", "BMP", "GIF", "SVG", "PDF"}


class Place:
    """A home, a folder for temporary files, and one for what is asked for."""

    def __init__(self, folder):
        self.home, self.temporary, self.out = folder / "home", folder / "temporary", folder / "out"
        for each in (self.home, self.temporary, self.out):
            each.mkdir()

    def run(self, *arguments, before="", **environment):
        """Start the program after the statements `before`."""
        surroundings = {
            name: value
            for name, value in os.environ.items()
            if name not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM") and not name.startswith("XDG_")
        }
        surroundings |= {"PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"}
        surroundings |= {name: str(self.home) for name in ("HOME", "USERPROFILE", "APPDATA", "LOCALAPPDATA")}
        surroundings |= {name: str(self.temporary) for name in ("TMPDIR", "TEMP", "TMP")}
        return subprocess.run(
            [sys.executable, "-c", f"{before}\n{START}", "selftest", *map(str, arguments)],
            cwd=self.out, env=surroundings | environment, capture_output=True, text=True, timeout=120, check=False,
        )  # fmt: skip

    @property
    def report(self):
        return json.loads((self.out / "report.json").read_text(encoding="utf-8"))

    def left(self):
        """What the program has left in home and among temporary files; fontconfig's own cache does not count."""
        return [
            path
            for folder in (self.home, self.temporary)
            for path in folder.rglob("*")
            if path.is_file() and "fontconfig" not in path.parts
        ]


@pytest.fixture
def place(tmp_path):
    return Place(tmp_path)


def test_it_does_the_main_job_and_leaves_nothing_behind(place):
    done = place.run("--report", "report.json", "--picture", "window.png")
    assert done.returncode == 0, done.stderr
    found = place.report
    assert found["passed"] is True
    assert found["step"] is found["error"] is None
    assert found["against_the_truth"]["z_rms_percent"] < 4
    assert found["figures"]["drop"] == pytest.approx(125.70, abs=1e-9)
    assert set(found["pictures"]) == PICTURES
    assert found["versions"]["numpy"]
    assert found["qt"]["qt"]
    assert all(step["seconds"] >= 0 for step in found["steps"])
    if sys.platform == "linux":
        assert found["qt"]["platform_plugin"] == "offscreen"
        assert "no screen" in found["notes"][0]
    assert (place.out / "window.png").read_bytes().startswith(b"\x89PNG")
    assert not place.left()


def test_figures_are_the_same_every_time_and_in_full(place):
    figures = []
    for _ in range(2):
        assert place.run("--report", "report.json").returncode == 0
        figures.append((place.report["figures"], place.report["against_the_truth"]))
    assert figures[0] == figures[1]
    assert len(repr(figures[0][1]["z_rms"])) > 12


def test_a_program_without_standard_streams_reports_all_the_same(place):
    done = place.run("--report", "report.json", before="import sys; sys.stdin = sys.stdout = sys.stderr = None")
    assert done.returncode == 0
    assert place.report["passed"] is True
    assert place.report["system"]["has_standard_output"] is False


def test_a_wrong_result_fails_with_its_step(place):
    wrong = """
import bobdesk.files.importers.line3d as module
from dataclasses import replace
read = module.read_line3d
def off(path):
    found = read(path)
    return replace(found, line=replace(found.line, points=found.line.points + [0.0, 0.0, 0.01]))
module.read_line3d = off
"""
    done = place.run("--report", "report.json", before=wrong)
    assert done.returncode == 1
    assert place.report["passed"] is False
    assert place.report["step"] == "read the export and compare it with the truth"
    assert "off the one that was written by 0.01" in place.report["error"]
    assert place.report["error"] in done.stderr
    assert not place.left()


def test_a_fault_in_a_slot_fails_the_step_it_comes_in(place):
    fault = """
import bobdesk.ui.plan_view.tools.auto_trace as module
def broken(self, *arguments):
    raise RuntimeError("nobody has thought of that")
module.AutoTraceTool._on_progress = broken
"""
    done = place.run("--report", "report.json", before=fault)
    assert done.returncode == 1
    assert place.report["step"] == "trace the line"
    assert "nobody has thought of that" in place.report["error"]
    assert not place.left()


def test_a_library_that_is_missing_is_named(place):
    done = place.run("--report", "report.json", before="import sys; sys.modules['pypdfium2'] = None")
    assert done.returncode == 1
    assert place.report["step"] == "look around"
    assert "pypdfium2" in place.report["error"]


def test_a_step_that_hangs_is_ended(place):
    hang = """
import time
import bobdesk.ui.selftest.surroundings as module
module.versions = lambda: time.sleep(1000)
"""
    done = place.run("--report", "report.json", "--limit", "1", before=hang)
    assert done.returncode == 1
    assert place.report["step"] == "look around"
    assert "hangs" in place.report["error"]
    assert "in <lambda>" in place.report["trace"]
    assert not place.left()


def test_a_program_that_dies_has_left_the_name_of_its_step(place):
    die = """
import os
import bobdesk.ui.selftest.made_pictures as module
module.decode_made_pictures = lambda: os._exit(9)
"""
    assert place.run("--report", "report.json", before=die).returncode == 9
    assert place.report["passed"] is False
    assert place.report["step"] == "decode pictures of all kinds"
    assert "without saying why" in place.report["error"]


@pytest.mark.skipif(sys.platform != "linux", reason="fonts are found by fontconfig on Linux")
def test_letters_that_are_boxes_are_noticed(place):
    nothing = place.out / "fonts.conf"
    nothing.write_text("<fontconfig></fontconfig>")
    assert place.run("--report", "report.json", FONTCONFIG_FILE=str(nothing)).returncode == 1
    assert "no font" in place.report["error"]


def test_a_report_that_cannot_be_written_is_refused_at_once(place):
    done = place.run("--report", "missing/report.json")
    assert done.returncode == 3
    assert "there is no folder" in done.stderr

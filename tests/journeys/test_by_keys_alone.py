"""Without a mouse: from a file of coordinates to the 3D line in a file, the pointer lying in a corner all the while."""

import shutil

import numpy as np
import pytest

from bobdesk.files.importers.line3d import read_line3d
from bobdesk.track.comparison import compare
from tests.journeys.gestures import EDITING
from tests.journeys.real_window import ROOT, RealWindow

SAMPLE = ROOT / "resources" / "samples" / "mugello" / "mugello.csv"
MOST_TABS = 40
FOCUS = (
    "(lambda gui, focus: '' if focus is None else"
    " gui.QAccessible.queryAccessibleInterface(focus).text(gui.QAccessible.Text.Name))"
    "(__import__('PySide6.QtGui', fromlist=['QAccessible']),"
    " __import__('PySide6.QtWidgets', fromlist=['QApplication']).QApplication.focusWidget())"
)


class Keyboard:
    """Presses keys, and hears what a screen reader would say."""

    def __init__(self, program: RealWindow):
        self.program = program
        program.move(1499, 949)

    def press(self, *keys):
        self.program.key(*keys)

    def type(self, text):
        self.program.type(text)

    def heard(self):
        return self.program.ask(FOCUS)

    def tab_to(self, name, key="Tab"):
        """Press Tab until the control with a name has the keyboard."""
        for _ in range(MOST_TABS):
            if name in self.heard():
                return
            self.press(key)
        raise AssertionError(f"{name} is not reached by {MOST_TABS} Tabs")

    def enter_file(self, path):
        self.program.until("widget('fileNameEdit').isVisible()")
        self.press("ctrl+a")
        self.type(str(path))
        self.press("Return")


def part_in_focus(program):
    """The part of the window that has the keyboard."""
    return program.ask(
        "(lambda focus, parts: next((name for name, part in parts if part is not None and focus is not None"
        " and (part is focus or part.isAncestorOf(focus))), ''))"
        "(window.focusWidget(), [('steps', window.steps_bar), ('tools', window.layout_of_window._tools),"
        " ('plan', window.view), ('strips', window.layout_of_window.strips_dock.widget()),"
        " ('panel', window.panels.stack)])"
    )


def test_from_coordinates_to_csv_without_a_mouse(opened, tmp_path):
    plan, out = tmp_path / "plan.csv", tmp_path / "line.csv"
    shutil.copyfile(SAMPLE, plan)
    truth = np.genfromtxt(SAMPLE, delimiter=",", names=True)
    program = opened(tmp_path / "home")
    keyboard = Keyboard(program)

    # The start page: every button is reached by F6, Tab and arrows.
    assert keyboard.heard() == "New from picture"
    keyboard.press("Right")
    assert keyboard.heard() == "New from coordinates"
    keyboard.press("Right")
    assert keyboard.heard() == "Open sample"
    keyboard.press("F6")
    assert keyboard.heard() == "First track in ten minutes"
    keyboard.press("F6")
    assert keyboard.heard() == "New from picture"

    # A plan from coordinates.
    keyboard.press("ctrl+i")
    keyboard.enter_file(plan)
    program.until("widget('Import').isEnabled()")
    keyboard.press("Return")
    program.until("desk.session.is_open and project.source is not None")

    # F6 goes round the parts of the window, Shift+F6 the other way.
    keyboard.press("ctrl+4")
    program.until("widget('strips')._now.is_current")
    parts = []
    for _ in range(5):
        keyboard.press("F6")
        parts.append(part_in_focus(program))
    assert sorted(parts) == ["panel", "plan", "steps", "strips", "tools"]
    assert len(parts) == len(set(parts))
    back = []
    for _ in range(5):
        keyboard.press("shift+F6")
        back.append(part_in_focus(program))
    assert back == [*parts[-2::-1], parts[-1]]

    # A segment is selected, flipped and the flip taken back, on the strips.
    while part_in_focus(program) != "strips":
        keyboard.press("F6")
    keyboard.press("bracketright")
    program.until("len(desk.selection.segments) == 1")
    keyboard.press("o")
    program.until("desk.session.undo_label == 'Flip kind'")
    keyboard.press("ctrl+z")
    program.until("project.segments is None")

    # Targets, in the panel of step 5.
    keyboard.press("ctrl+5")
    while part_in_focus(program) != "panel":
        keyboard.press("F6")
    keyboard.tab_to("Length (3D)")
    keyboard.press("ctrl+a")
    keyboard.type("703.70")
    keyboard.tab_to("Height difference")
    keyboard.press("ctrl+a")
    keyboard.type("35.73")
    keyboard.press("Tab")
    program.until("project.targets.drop == 35.73 and project.targets.length == 703.7")
    program.until("any(text.startswith('✓ These figures can all be met') for text in texts())")

    # Three known elevations.
    for count, station in enumerate((200.0, 400.0, 600.0), 1):
        elevation = float(np.interp(station, truth["s2d_m"], truth["z_m"]) - truth["z_m"].min())
        keyboard.tab_to("Add")
        keyboard.press("space")
        program.until(EDITING)
        keyboard.type(f"{elevation:.2f}")
        keyboard.press("Return")
        program.until(f"len(project.known_elevations) == {count}")
        program.until(f"any(abs(one.elevation - {elevation:.2f}) < 1e-9 for one in project.known_elevations)")
        # The station, one cell to the left.
        keyboard.press("Left", "F2", "ctrl+a")
        keyboard.type(f"{station:.0f}")
        keyboard.press("Return")
        program.until(f"any(one.station == {station} for one in project.known_elevations)")

    keyboard.press("F5")
    program.until("project.run is not None")

    # The file.
    keyboard.press("ctrl+e")
    program.until("window.focusWidget() is not None and 'Save' in window.focusWidget().accessibleName()")
    program.until("window.focusWidget().isEnabled()")
    keyboard.press("Return")
    keyboard.enter_file(out)
    program.until(f"__import__('pathlib').Path({str(out)!r}).exists()")
    found = compare(read_line3d(out).line.points, np.column_stack([truth["x_m"], truth["y_m"], truth["z_m"]]))
    assert abs(found.drop_percent) < 0.1
    assert abs(found.length_percent) < 0.1
    assert found.z_rms_percent == pytest.approx(4.7, abs=2.0)

    # The guide, read and closed; the project, saved; the program, left.
    keyboard.press("F1")
    program.until("window.guide.window is not None and window.guide.window.isActiveWindow()")
    assert program.ask("window.guide.window.browser.page.name") == "export.md"
    keyboard.press("ctrl+f")
    keyboard.type("decimal comma")
    keyboard.press("Return")
    program.until("window.guide.window.browser.page.name in ('export.md', 'questions.md')")
    keyboard.press("ctrl+w")
    program.until("window.isActiveWindow()")
    keyboard.press("ctrl+s")
    keyboard.enter_file(tmp_path / "keys.bobdesk")
    program.until("desk.session.is_saved")
    keyboard.press("ctrl+q")
    assert program.wait_for_end() == 0
    assert program.output == ""

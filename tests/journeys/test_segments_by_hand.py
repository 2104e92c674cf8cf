"""Three wrong boundaries put right by mouse and keys; undone, done again, saved and opened."""

from pathlib import Path

import numpy as np
import pytest

from bobdesk.alignment.boundary_comparison import boundaries_of, compare_boundaries
from bobdesk.files.project_file import load_project, save_project
from bobdesk.plan.polyline import Polyline
from bobdesk.project import derive, edits
from bobdesk.project.project import Project, SourceLine
from tests.alignment.made_lines import drive, made_pieces

SEED = 5
MOST_GESTURES = 15


@pytest.fixture
def truth():
    """Where straights and curves of the made track meet: a curve is a clothoid, an arc and a clothoid."""
    lengths = [piece[0] for piece in made_pieces(SEED)]
    ends, at, index = [], lengths[0], 1
    while index < len(lengths):
        ends += [at, at + sum(lengths[index : index + 3])]
        at = ends[-1] + lengths[index + 3]
        index += 4
    return np.array(ends)


@pytest.fixture
def wrong(tmp_path, truth) -> Path:
    """A project whose segments are right but for three boundaries: one off, one too many, one missing."""
    line = SourceLine("made.csv", Polyline(drive(made_pieces(SEED), step=1.0)))
    project = edits.open_coordinates(Project(), line)
    found = derive.segments(project).needed()
    assert compare_boundaries(boundaries_of(found), truth).f1 == 1.0
    project = edits.move_boundary(project, 3, found[3].end + 11.0)
    project = edits.split_segment(project, 0.5 * (found[8].start + found[8].end))
    project = edits.merge_segments(project, 13, 14)
    path = tmp_path / "wrong.bobdesk"
    save_project(project, path)
    return path


class Hand:
    """Counts gestures: a click, a drag, a key."""

    def __init__(self, program):
        self.program = program
        self.gestures = 0

    def strip(self, station, share=0.5):
        return self.program.ask(
            f"(lambda strip, on: [strip.mapToGlobal(strip.rect().topLeft()).x() + on.x({station}),"
            f" strip.mapToGlobal(strip.rect().topLeft()).y() + on.area.top() + {share} * on.area.height()])"
            "(widget('strips').curvature, widget('strips').curvature.geometry_now())"
        )

    def on_line(self, station):
        """Return where a station of the plan is on the screen."""
        x, y = self.program.ask(
            "__import__('numpy').column_stack([__import__('numpy').interp("
            f"[{station}], now.line.stations, now.line.points[:, axis]) for axis in (0, 1)])[0].tolist()".replace(
                "now.", "widget('strips')._now.value."
            )
        )
        return self.program.ask(f"plan({x}, {-y})")

    def click(self, place):
        self.gestures += 1
        self.program.click(*place)

    def drag(self, start, end):
        self.gestures += 1
        self.program.drag(tuple(start), tuple(end))

    def key(self, key):
        self.gestures += 1
        self.program.key(key)


SEGMENTS = "[[one.kind, one.start, one.end, one.name] for one in project.segments]"
ENDS = "[one.end for one in widget('strips')._now.segments[:-1]]"


def test_three_wrong_boundaries_are_put_right(opened, tmp_path, truth, wrong):
    program = opened(tmp_path / "home", wrong)
    program.until("desk.session.is_open")
    program.key("ctrl+4")
    program.until("widget('strips')._now.is_current and len(widget('strips')._now.segments) > 10")
    program.until("window.view.tool_name == 'boundaries'")
    before = program.ask(SEGMENTS)
    ends = np.array(program.ask(ENDS))
    assert compare_boundaries(ends, truth).f1 < 0.95
    hand = Hand(program)

    # The one that is off, on the plan; it may snap, and is nudged to where the curvature rises.
    off = float(ends[3])
    hand.drag(hand.on_line(off), hand.on_line(float(truth[3])))
    program.until("desk.session.undo_label == 'Move boundary'")

    # The one too many: its handle on the strip, and it is gone.
    ends = np.array(program.ask(ENDS))
    extra = int(np.argmax([np.abs(truth - end).min() for end in ends]))
    hand.click(hand.strip(float(ends[extra])))
    program.until(f"desk.selection.boundary == {extra}")
    hand.key("Delete")
    program.until("desk.session.undo_label == 'Delete boundary'")

    # The missing one: split there, and flip the part that is of the wrong kind.
    ends = np.array(program.ask(ENDS))
    missing = float(truth[np.argmax([np.abs(ends - end).min() for end in truth])])
    hand.click(hand.strip(missing, 0.7))
    hand.key("x")
    program.until("desk.session.undo_label == 'Split segment'")
    kinds = program.ask("[one.kind for one in widget('strips')._now.segments]")
    at = program.ask("desk.selection.segments[0]")
    if kinds[at] == kinds[at + 1]:
        hand.key("o")
    else:
        hand.key("bracketleft")
        hand.key("o")
    program.until("desk.session.undo_label == 'Flip kind'")

    assert hand.gestures < MOST_GESTURES
    after = program.ask(SEGMENTS)
    ends = np.array(program.ask(ENDS))
    assert compare_boundaries(ends, truth, within=3.0).f1 == 1.0
    assert [one[0] for one in after] == ["straight", "curve"] * 8 + ["straight"]

    # Back to the start, and forward again.
    steps = 0
    while program.ask("desk.session.undo_label") is not None:
        program.key("ctrl+z")
        steps += 1
    assert steps == 4
    assert program.ask(SEGMENTS) == before
    for _ in range(steps):
        program.key("ctrl+y")
    program.until("desk.session.redo_label is None")
    assert program.ask(SEGMENTS) == after

    # Saved and opened again.
    program.key("ctrl+s")
    program.until("desk.session.is_saved")
    program.key("ctrl+q")
    assert program.wait_for_end() == 0
    kept = load_project(wrong)
    assert [[one.kind, one.start, one.end, one.name] for one in kept.segments] == after
    program = opened(tmp_path / "home", wrong)
    program.until("desk.session.is_open")
    assert program.ask(SEGMENTS) == after
    program.key("ctrl+q")
    assert program.wait_for_end() == 0


@pytest.mark.parametrize("key", ["Escape", "ctrl+5", "ctrl+3", "ctrl+z"])
@pytest.mark.parametrize("where", ["strip", "plan"])
def test_a_key_in_mid_drag_lets_go_of_the_boundary(opened, tmp_path, wrong, where, key):
    program = opened(tmp_path / "home", wrong)
    program.until("desk.session.is_open")
    program.key("ctrl+4")
    program.until("widget('strips')._now.is_current and len(widget('strips')._now.segments) > 10")
    hand = Hand(program)
    # Something to undo.
    hand.click(hand.strip(20.0, 0.7))
    hand.key("o")
    program.until("desk.session.undo_label == 'Flip kind'")
    before, end = program.ask(SEGMENTS), float(program.ask(ENDS)[4])
    places = [hand.strip(at) if where == "strip" else hand.on_line(at) for at in (end, end + 9.0)]
    strips = "window.layout_of_window.strips_dock.widget()"
    program.hold(*map(tuple, places))
    program.until(f"{strips}._now.is_preview")
    program.key(key)
    program.until(f"not {strips}._now.is_preview")
    after = program.ask(SEGMENTS)
    assert after == before or key == "ctrl+z"
    program.move(places[1][0] + 4, places[1][1])
    program.release()
    assert program.ask(SEGMENTS) == after
    assert not program.ask(f"{strips}._now.is_preview")
    assert program.ask("desk.session.undo_label") == (None if key == "ctrl+z" else "Flip kind")
    program.key("ctrl+s")
    program.until("desk.session.is_saved")
    program.key("ctrl+q")
    assert program.wait_for_end() == 0

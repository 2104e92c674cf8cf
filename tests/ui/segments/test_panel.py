"""The panel of the segments: settings, rules, designs, files."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton

from bobdesk.alignment.segments import Segment, check_segments, in_words
from bobdesk.files.importers.line3d import read_line3d
from bobdesk.files.project_file import load_project, save_project
from bobdesk.files.recovery import Recovery
from bobdesk.files.recovery_store import recover, recoverable
from bobdesk.plan.polyline import Polyline
from bobdesk.project import edits, segment_edits
from bobdesk.project.project import Project, SourceLine
from bobdesk.project.segment_edits import shortest_by_hand
from bobdesk.project.steps import steps
from bobdesk.ui.actions.action_set import ActionSet
from bobdesk.ui.actions.segment_actions import SegmentActions
from bobdesk.ui.panels.segments_panel import SegmentsPanel
from bobdesk.ui.segments.design import design_of
from bobdesk.ui.segments.operations import operations
from bobdesk.ui.segments.segment_files import SegmentFiles

SAMPLES = Path(__file__).parent.parent.parent.parent / "resources" / "samples"
CORTINA = SAMPLES / "cortina_2026_design"


@pytest.fixture
def panel(desk, now, window, shown, idle):
    actions = ActionSet(SegmentActions(desk, window).table(), desk.settings, window, window)
    made = shown(SegmentsPanel(desk, actions), 430, 900)
    idle()
    return made


def button(panel, text):
    return next(one for one in panel.findChildren(QPushButton) if one.text().startswith(text))


def test_the_state_is_said_in_a_line(desk, panel):
    assert panel.state.text() == "17 segments, 8 of them curves · found automatically"
    do = operations(desk)
    do.flip_one(3)
    do.set_locked(5, locked=True)
    assert panel.state.text() == "17 segments, 7 of them curves · 1 made by hand · 1 locked"


def test_every_setting_is_one_merged_step(desk, now, panel, idle):
    panel.automatic.threshold.setValue(0.006)
    idle()
    panel.automatic.threshold.setValue(0.007)
    idle()
    assert desk.session.project.segmentation.threshold == 0.007
    assert not panel.automatic.threshold_auto.isChecked()
    desk.session.undo()
    idle()
    assert desk.session.undo_label is None
    assert panel.automatic.threshold_auto.isChecked()
    panel.automatic.count.setValue(9)
    idle()
    assert len(now.segments) == 9
    panel.automatic.count.setValue(0)
    panel.automatic.shortest.setValue(40.0)
    idle()
    assert min(segment.length for segment in now.segments) >= 40.0
    assert desk.session.project.segmentation.count is None


def test_a_small_threshold_is_shown_as_it_is(desk, now, panel, idle):
    settings = replace(desk.session.project.segmentation, threshold=3.5e-5)
    desk.session.apply("Threshold", lambda project: segment_edits.set_segmentation(project, settings))
    idle()
    assert panel.automatic.threshold.value() == 3.5e-5
    desk.session.undo()
    idle()
    assert panel.automatic.threshold.decimals() == 4


def test_it_is_said_why_there_are_more_segments_than_wanted(desk, now, panel, idle):
    assert not panel.automatic.kept.isVisible()
    desk.session.apply("Lock", lambda project: segment_edits.lock_segments(project, range(8)))
    panel.automatic.count.setValue(5)
    idle()
    assert len(now.segments) > 5
    assert panel.automatic.kept.isVisible()
    assert panel.automatic.kept.text().startswith(f"{len(now.segments)} segments, since those that are locked")
    desk.session.undo()
    idle()
    assert not panel.automatic.kept.isVisible()


def test_the_picture_of_the_fit_chooses_a_number(desk, now, panel, idle):
    gain = panel.automatic.gain
    assert len(gain.shares) > 17
    assert gain.shares[16] > 0.97
    assert gain.shares[4] < 0.6
    at = QPoint(round(gain._x(11)), 40)
    QTest.mouseClick(gain, Qt.MouseButton.LeftButton, pos=at)
    idle()
    assert len(now.segments) == 11
    QTest.keyClick(gain, Qt.Key.Key_Right)
    QTest.keyClick(gain, Qt.Key.Key_Return)
    idle()
    assert len(now.segments) in (11, 12)


def test_the_published_rule_has_no_wanted_number(desk, now, panel, idle):
    desk.session.apply("x", lambda project: edits.set_smoothing(project, 20.0))
    panel.automatic.count.setValue(12)
    idle()
    panel.automatic.fold.set_open(True)
    panel.automatic.rule.setCurrentIndex(1)
    panel.automatic.rule.activated.emit(1)
    idle()
    assert desk.session.project.segmentation.rule == "published"
    assert not panel.automatic.count.isVisible()
    panel.automatic.rule.setCurrentIndex(0)
    panel.automatic.rule.activated.emit(0)
    idle()
    assert panel.automatic.count.isVisible()


def test_both_rules_are_seen_side_by_side(panel, idle):
    panel.rules.fold.set_open(True)
    idle()
    assert "segments: recommended 17, published" in panel.rules.found.text()
    assert 0.5 < float(panel.rules.score.text()) <= 1.0


def test_buttons_do_what_their_keys_do(desk, now, panel):
    desk.selection.station = 0.5 * (now.segments[2].start + now.segments[2].end)
    QTest.mouseClick(button(panel, "Split"), Qt.MouseButton.LeftButton)
    assert len(now.segments) == 18
    assert "segment 4" in panel._at.text()
    QTest.mouseClick(button(panel, "Delete boundary"), Qt.MouseButton.LeftButton)
    assert len(now.segments) == 17
    assert isinstance(panel._actions["split_segment"], QAction)


def test_segments_are_saved_and_opened(desk, now, panel, tmp_path, window, told, idle):
    files = SegmentFiles(desk, window)
    before = [(one.kind, one.end) for one in now.segments]
    assert files.save(tmp_path / "s.csv")
    header = (tmp_path / "s.csv").read_text().splitlines()[0]
    assert header == "segment,kind,from_m,to_m,radius_m,turn_rad"
    operations(desk).flip_one(2)
    assert files.open(tmp_path / "s.csv")
    assert [one.kind for one in now.segments] == [kind for kind, _ in before]
    assert [one.end for one in now.segments] == pytest.approx([end for _, end in before], abs=1e-3)
    (tmp_path / "bad.csv").write_text("kind,from_m,to_m\nstraight,0,50\nloop,50,60\n")
    project = desk.session.project
    assert not files.open(tmp_path / "bad.csv")
    assert "line 3" in told[-1]
    assert desk.session.project is project
    assert not files.save(tmp_path / "nowhere" / "s.csv")


def test_a_file_that_has_a_locked_segment_otherwise_is_refused(desk, now, panel, window, tmp_path, told):
    files = SegmentFiles(desk, window)
    assert files.save(tmp_path / "s.csv")
    desk.session.apply("Name", lambda project: segment_edits.name_segment(project, 1, "Kreisel"))
    desk.session.apply("Lock", lambda project: segment_edits.lock_segment(project, 1))
    assert files.open(tmp_path / "s.csv")
    kept = desk.session.project.segments[1]
    assert (kept.name, kept.locked) == ("Kreisel", True), "the file knows neither, and has it where it is"
    before = desk.session.project
    rows = (tmp_path / "s.csv").read_text().splitlines()
    one, two = (row.split(",") for row in rows[2:4])
    moved = f"{float(one[3]) + 1:.3f}"
    rows[2], rows[3] = ",".join([*one[:3], moved, *one[4:]]), ",".join([*two[:2], moved, *two[3:]])
    (tmp_path / "moved.csv").write_text("\n".join(rows) + "\n")
    assert not files.open(tmp_path / "moved.csv")
    assert desk.session.project is before
    assert "segment 2 is locked, and the file has it otherwise" in told[-1].lower()


SHORT = {
    "one": ("straight,0,0.01\ncurve,0.01,50\nstraight,50,{end}\n", "segment 1 is shorter", 2),
    "several": (
        "straight,0,20\ncurve,20,20.01\nstraight,20.01,21\ncurve,21,50\nstraight,50,50.5\ncurve,50.5,{end}\n",
        "3 segments (2, 3 and 5) are shorter",
        3,
    ),
    "all": (
        "".join(f"curve,{at},{at + 2}\n" for at in range(0, 20, 2)) + "straight,20,{end}\n",
        "10 segments (1, 2, 3, 4, 5, 6, …) are shorter",
        None,
    ),
}


@pytest.mark.parametrize("case", SHORT)
def test_segments_of_a_file_that_are_too_short_are_joined_and_said(desk, now, panel, tmp_path, window, told, case):
    rows, sentence, count = SHORT[case]
    (tmp_path / "short.csv").write_text("kind,from_m,to_m\n" + rows.format(end=now.value.line.length))
    assert SegmentFiles(desk, window).open(tmp_path / "short.csv")
    assert len(told) == 1
    assert told[0].startswith("short.csv: ")
    assert sentence in told[0]
    assert "3.0 m" in told[0]
    assert count is None or len(now.segments) == count
    shortest = shortest_by_hand(desk.session.project)
    assert min(one.length for one in now.segments) >= shortest
    check_segments(now.segments, length=now.value.line.length)
    desk.session.undo()
    assert len(now.segments) == 17


@pytest.mark.parametrize(
    ("kinds", "sentence"),
    [
        ("s", "1 segment, a straight"),
        ("c", "1 segment, a curve"),
        ("ss", "2 segments, none of them a curve"),
        ("sc", "2 segments, 1 of them a curve"),
        ("cc", "2 segments, all of them curves"),
        ("scsc", "4 segments, 2 of them curves"),
    ],
)
def test_few_segments_are_counted_in_good_english(desk, now, panel, kinds, sentence):
    length = now.value.line.length
    ends = [length * (index + 1) / len(kinds) for index in range(len(kinds))]
    words = {"s": "straight", "c": "curve"}
    made = tuple(
        Segment(words[kind], start, end) for kind, start, end in zip(kinds, [0.0, *ends[:-1]], ends, strict=True)
    )
    operations(desk).take(made, "x")
    assert panel.state.text().split(" · ")[0] == sentence
    assert in_words(now.segments) == sentence
    found = next(step for step in steps(desk.session.project) if step.name == "Segments")
    assert found.sentence == f"{sentence}, set by hand."


def test_a_question_keeps_its_question_mark(desk, panel, idle):
    tiny = SourceLine("tiny.csv", Polyline(np.array([[0.0, 0.0], [0.3, 0.0], [0.5, 0.1]])))
    desk.session.open(edits.open_coordinates(Project(), tiny), None)
    idle()
    assert panel.problem.text().endswith("are the coordinates metres?")
    assert all(not step.sentence.endswith("?.") for step in steps(desk.session.project))


def test_a_design_is_compared_with_what_was_found(desk, now, panel, idle, told):
    points = read_line3d(CORTINA / "plan.csv").line.points
    line = SourceLine("plan.csv", Polyline(points[:, :2]))
    desk.session.open(edits.open_coordinates(Project(), line), None)
    idle()
    design = design_of(desk)
    assert not panel.design.isVisible()
    assert design.read(CORTINA / "design.json")
    assert panel.design.isVisible()
    assert panel.design.model.rowCount() == 16
    assert design.offset == pytest.approx(22.0, abs=1.0)
    pairs = design.pairs()
    found = [pair for pair in pairs if pair.segment is not None]
    assert len(found) >= 14
    tight = [pair for pair in found if pair.curve.radius < 100]
    assert all(pair.side == pair.curve.side for pair in tight)
    assert all(abs(pair.radius - pair.curve.radius) < 0.35 * pair.curve.radius for pair in tight)
    assert panel.design.model.index(0, 4).data() == "17.0"
    panel.design.table.clicked.emit(panel.design.model.index(2, 0))
    assert desk.selection.segments == (pairs[2].index,)
    QTest.mouseClick(button(panel, "Stop comparing"), Qt.MouseButton.LeftButton)
    assert not panel.design.isVisible()
    assert not design.read(CORTINA / "SOURCE.md")
    assert told


def test_a_design_is_kept_in_the_project_undone_saved_and_recovered(desk, now, panel, tmp_path, idle, until):
    design, session = design_of(desk), desk.session
    assert design.read(CORTINA / "design.json")
    assert session.undo_label == "Compare with a design"
    compared = session.project
    first = design.offset
    panel.design.offset.setValue(first + 1)
    panel.design.offset.setValue(first + 2.5)
    assert session.undo_label == "Move design"
    assert session.project.design.offset == first + 2.5
    moved = session.project
    session.undo()
    assert session.project is compared
    assert panel.design.offset.value() == first
    session.undo()
    assert not panel.design.isVisible()
    session.redo()
    session.redo()
    assert session.project is moved
    assert panel.design.isVisible()

    save_project(moved, tmp_path / "a.bobdesk")
    recovery = Recovery(tmp_path / "kept")
    recovery.keep(moved, path=None, last_edit="Move design")
    recovery.wait(10)
    recovery.close(forget=False)
    (copy,) = recoverable(tmp_path / "kept")
    for again in (load_project(tmp_path / "a.bobdesk"), recover(copy)):
        session.close()
        idle()
        assert not panel.design.isVisible()
        session.open(again, None)
        idle()
        assert session.project.design == moved.design
        assert panel.design.model.rowCount() == 16
        assert panel.design.offset.value() == first + 2.5
    design.close()
    assert session.undo_label == "Stop comparing"
    assert session.project.design is None


@pytest.mark.parametrize(
    ("rows", "sentence"),
    [
        ("9000,10,20\n", "d.csv: 1 curve, which has no counterpart in this line"),
        ("9000,10,20\n9100,10,20\n", "d.csv: 2 curves, none of which has a counterpart in this line"),
    ],
)
def test_a_design_without_counterparts_says_so(desk, now, panel, tmp_path, rows, sentence):
    (tmp_path / "d.csv").write_text("from_m,length_m,radius_m\n" + rows)
    assert design_of(desk).read(tmp_path / "d.csv")
    assert panel.design.sentence.text() == sentence


def test_every_control_has_a_name_and_a_tip(panel):
    from PySide6.QtWidgets import QAbstractSpinBox, QComboBox, QToolButton

    for kind in (QPushButton, QAbstractSpinBox, QComboBox, QToolButton):
        for one in panel.findChildren(kind):
            if one.isVisible() and one.focusPolicy() & Qt.FocusPolicy.TabFocus:
                assert one.accessibleName(), one
                assert one.toolTip(), one.accessibleName()

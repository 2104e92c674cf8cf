"""Undo and Redo by key while the keyboard is in a field of the window."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractSpinBox, QApplication, QLineEdit

from bobdesk.ui.widgets.fold import Fold

CTRL = Qt.KeyboardModifier.ControlModifier
SHIFT = Qt.KeyboardModifier.ShiftModifier
REDO_KEYS = ((Qt.Key.Key_Y, CTRL), (Qt.Key.Key_Z, CTRL | SHIFT))


@pytest.fixture
def window(whole_window):
    return whole_window


@pytest.fixture
def idle(window, until):
    return lambda: until(lambda: not window.desk.runner.jobs)


def press(key, modifiers=Qt.KeyboardModifier.NoModifier):
    QTest.keyClick(QApplication.focusWidget(), key, modifiers)


def take(field):
    field.setFocus(Qt.FocusReason.TabFocusReason)
    assert QApplication.focusWidget() is field


def panel(window, step):
    window.go_to(step)
    return window.panels._shown[step]


@pytest.mark.parametrize("keys", REDO_KEYS)
def test_a_spin_box_whose_number_was_taken_undoes_the_document(window, idle, keys):
    spin, session = panel(window, "Segments").automatic.shortest, window.desk.session
    before = session.project
    take(spin)
    spin.selectAll()
    QTest.keyClicks(spin, "40")
    press(Qt.Key.Key_Return)
    idle()
    assert session.project.segmentation.shortest == 40.0
    press(Qt.Key.Key_Z, CTRL)
    assert session.project is before
    idle()
    assert spin.value() == before.segmentation.shortest
    press(*keys)
    idle()
    assert session.project.segmentation.shortest == 40.0
    assert spin.value() == 40.0


def test_text_that_is_not_taken_yet_is_undone_first_and_the_document_after_it(window, idle):
    found, session = panel(window, "Segments"), window.desk.session
    found._operations.flip_one(3)
    flipped, spin = session.project, found.automatic.shortest
    shown = spin.text()
    take(spin)
    spin.selectAll()
    QTest.keyClicks(spin, "77")
    press(Qt.Key.Key_Z, CTRL)
    assert session.project is flipped
    assert spin.text() == shown
    press(Qt.Key.Key_Y, CTRL)
    assert spin.text().startswith("77")
    press(Qt.Key.Key_Z, CTRL)
    press(Qt.Key.Key_Z, CTRL)
    assert session.undo_label is None
    assert session.redo_label == "Flip kind"
    idle()


def test_the_arrows_of_a_spin_box_are_steps_of_the_document(window, idle):
    spin, session = panel(window, "Segments").automatic.shortest, window.desk.session
    before = session.project
    take(spin)
    press(Qt.Key.Key_Up)
    idle()
    assert session.project is not before
    press(Qt.Key.Key_Z, CTRL)
    assert session.project is before
    idle()


def test_a_field_that_tells_while_one_types(window, idle, until):
    found, session = panel(window, "Solve"), window.desk.session
    field, before = found.targets.drop, session.project
    take(field)
    field.selectAll()
    QTest.keyClicks(field, "101.5")
    until(lambda: session.project.targets.drop == 101.5)
    assert field.text() == "101.5"
    press(Qt.Key.Key_Z, CTRL)
    assert session.project is before
    assert field.text() != "101.5"
    press(Qt.Key.Key_Z, CTRL | SHIFT)
    assert session.project.targets.drop == 101.5
    assert field.text() == "101.5"
    idle()


def test_a_cell_that_is_edited(window, idle):
    found, session = panel(window, "Segments"), window.desk.session
    found._operations.flip_one(3)
    flipped, table = session.project, found.table
    index = table.model().index(2, table.segments.column("name"))
    table.setFocus()
    table.setCurrentIndex(index)
    table.edit(index)
    editor = QApplication.focusWidget()
    assert isinstance(editor, QLineEdit)
    QTest.keyClicks(editor, "Kreisel")
    press(Qt.Key.Key_Z, CTRL)
    assert session.project is flipped
    press(Qt.Key.Key_Z, CTRL)
    assert session.project is not flipped
    idle()


def test_name_and_notes_are_steps_of_the_document(window, idle):
    found, session = panel(window, "Plan"), window.desk.session
    for field, name in ((found.name, "name"), (found.notes, "notes")):
        before = session.project
        take(field)
        QTest.keyClicks(field, "old")
        assert getattr(session.project, name) != getattr(before, name)
        press(Qt.Key.Key_Z, CTRL)
        assert session.project is before
        press(Qt.Key.Key_Y, CTRL)
        assert "old" in getattr(session.project, name)
    idle()


def test_every_field_of_every_panel_lets_undo_through(window, idle):
    session = window.desk.session
    session.apply("Touch", lambda project: project.__class__(**{**vars(project), "notes": "touched"}))
    touched, tried = session.project, 0
    for step in ("Plan", "Scale", "Centreline", "Segments", "Solve", "Export"):
        found = panel(window, step)
        for fold in found.findChildren(Fold):
            fold.set_open(True)
        idle()
        for kind in (QLineEdit, QAbstractSpinBox):
            for field in found.findChildren(kind):
                line = field.lineEdit() if isinstance(field, QAbstractSpinBox) else field
                is_inner = isinstance(field.parent(), QAbstractSpinBox)
                if is_inner or not field.isVisible() or not field.isEnabled() or line.isReadOnly():
                    continue
                take(field)
                press(Qt.Key.Key_Z, CTRL)
                assert session.project is not touched, (step, field.accessibleName())
                press(Qt.Key.Key_Y, CTRL)
                assert session.project is touched, (step, field.accessibleName())
                tried += 1
    assert tried > 15


@pytest.mark.parametrize(("first", "then"), [("Segments", "Solve"), ("Solve", "Segments"), ("Segments", "Scale")])
def test_another_step_by_key_takes_the_keyboard_out_of_fields(window, idle, first, then):
    steps = ("Plan", "Scale", "Centreline", "Segments", "Solve", "Export")
    panel(window, then)
    found, session = panel(window, first), window.desk.session
    idle()
    field = next(
        one
        for kind in (QAbstractSpinBox, QLineEdit)
        for one in found.findChildren(kind)
        if one.isVisible() and one.isEnabled() and not isinstance(one.parent(), QAbstractSpinBox)
    )
    take(field)
    press(getattr(Qt.Key, f"Key_{steps.index(then) + 1}"), CTRL)
    assert window.panels.stack.currentWidget() is window.panels._shown[then]
    assert QApplication.focusWidget() is window.view
    before = session.project
    session.apply("Touch", lambda project: project.__class__(**{**vars(project), "notes": "touched"}))
    press(Qt.Key.Key_Z, CTRL)
    assert session.project is before


def test_what_was_typed_when_the_step_changed_is_taken(window, idle):
    spin, session = panel(window, "Segments").automatic.shortest, window.desk.session
    take(spin)
    spin.selectAll()
    QTest.keyClicks(spin, "31")
    press(Qt.Key.Key_5, CTRL)
    idle()
    assert session.project.segmentation.shortest == 31.0


@pytest.mark.parametrize(("step", "kind"), [("Solve", QLineEdit), ("Segments", QAbstractSpinBox)])
def test_export_by_key_leaves_a_field(window, idle, step, kind):
    found = panel(window, step)
    idle()
    take(next(one for one in found.findChildren(kind) if one.isVisible() and one.isEnabled()))
    press(Qt.Key.Key_E, CTRL)
    assert window.panels.stack.currentWidget() is window.panels._shown["Export"]
    idle()

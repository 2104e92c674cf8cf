"""Del takes the selected row away wherever a table has a button for it, and never while a cell is edited."""

import re

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QLineEdit

from bobdesk.plan.control_points import KnownDistance
from bobdesk.project import edits
from bobdesk.solve.targets import KnownElevation
from bobdesk.ui.panels.scale_panel import ScalePanel
from bobdesk.ui.panels.solve_panel import SolvePanel
from tests.journeys.real_window import ROOT

PARTS = {path: path.read_text("utf-8") for path in sorted((ROOT / "bobdesk" / "ui").rglob("*_part.py"))}
WITH_BUTTONS = [
    path for path, text in PARTS.items() if "self.table = Table(" in text and re.search("(remove|delete)_button", text)
]


def shown(qtbot, panel):
    qtbot.addWidget(panel)
    panel.resize(430, 1200)
    panel.show()
    panel.activateWindow()
    qtbot.waitUntil(panel.isActiveWindow)
    return panel


def select(qtbot, table, row):
    table.setFocus()
    table.setCurrentIndex(table.model().index(row, 1))
    qtbot.waitUntil(table.hasFocus)


def test_a_known_elevation_goes_and_comes_back(qtbot, desk, opened, idle):
    panel = shown(qtbot, SolvePanel(desk))
    desk.session.apply("Add", lambda now: edits.add_known_elevation(now, KnownElevation(50.0, 20.0)))
    before = desk.session.project.known_elevations
    select(qtbot, panel.known.table, 0)
    qtbot.keyClick(panel.known.table, Qt.Key.Key_Delete)
    assert desk.session.project.known_elevations == before[1:]
    desk.session.undo()
    assert desk.session.project.known_elevations == before
    idle()


def test_del_in_a_cell_is_for_its_text(qtbot, desk, opened, idle):
    panel = shown(qtbot, SolvePanel(desk))
    desk.session.apply("Add", lambda now: edits.add_known_elevation(now, KnownElevation(50.0, 20.0)))
    before = desk.session.project
    table = panel.known.table
    select(qtbot, table, 0)
    table.edit(table.model().index(0, 1))
    editor = QApplication.focusWidget()
    assert isinstance(editor, QLineEdit)
    editor.selectAll()
    qtbot.keyClick(editor, Qt.Key.Key_Delete)
    assert editor.text() == ""
    assert desk.session.project is before
    qtbot.keyClick(editor, Qt.Key.Key_Escape)
    idle()


def test_a_distance_goes_and_comes_back(qtbot, desk, opened, idle):
    panel = shown(qtbot, ScalePanel(desk))
    known = KnownDistance((10.0, 10.0), (110.0, 10.0), 50.0)
    desk.session.apply("Add", lambda now: edits.add_known_distance(now, known))
    before = desk.session.project.known_distances
    table = panel.distances.table
    assert len(before) > 0
    select(qtbot, table, len(before) - 1)
    qtbot.keyClick(table, Qt.Key.Key_Delete)
    assert desk.session.project.known_distances == before[:-1]
    desk.session.undo()
    assert desk.session.project.known_distances == before
    idle()


@pytest.mark.parametrize("path", WITH_BUTTONS, ids=lambda path: path.stem)
def test_every_table_with_such_a_button_has_the_key(path):
    assert "self.table.on_key(Qt.Key.Key_Delete, self." in PARTS[path]

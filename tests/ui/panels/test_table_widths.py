"""Columns of a table in wide and in narrow panels."""

import pytest
from PySide6.QtCore import Qt

from bobdesk.ui.panels.centreline_panel import CentrelinePanel
from bobdesk.ui.widgets.columns_model import Column, ColumnsModel
from bobdesk.ui.widgets.table import Table

_ACROSS = Qt.Orientation.Horizontal


@pytest.fixture
def table(qtbot):
    columns = tuple(Column(lambda name=name: name, name, lambda _row: "8") for name in ("One", "Two", "Three", "Four"))
    made = Table("Numbers", ColumnsModel(columns, lambda: 3, print))
    qtbot.addWidget(made)
    made.show()
    made.fit_columns(("8,888.88",) * 4, dispensable=(1,))
    return made


def widths(table):
    return [table.columnWidth(column) for column in range(4) if not table.isColumnHidden(column)]


def test_columns_sit_closer_before_one_goes_and_come_back(table):
    table.resize(700, 200)
    wide = widths(table)
    assert len(wide) == 4
    table.resize(sum(wide) - 20, 200)
    closer = widths(table)
    assert len(closer) == 4
    assert sum(closer) <= table.viewport().width()
    table.resize(sum(wide) - 60, 200)
    assert len(widths(table)) == 3
    assert table.isColumnHidden(1)
    assert sum(widths(table)) <= table.viewport().width()
    table.resize(700, 200)
    assert widths(table) == wide


def test_a_width_that_was_drawn_by_hand_stays(table):
    table.resize(700, 200)
    table.horizontalHeader().resizeSection(0, 222)
    table.resize(300, 200)
    assert table.columnWidth(0) == 222


@pytest.mark.parametrize("width", [300, 430])
def test_how_sure_a_vertex_is_can_be_seen_in_a_narrow_panel(desk, opened, idle, qtbot, width):
    panel = CentrelinePanel(desk)
    qtbot.addWidget(panel)
    panel.resize(width, 1400)
    panel.show()
    idle()
    table = panel.vertices.table
    sure = next(column for column in range(6) if table.model().headerData(column, _ACROSS) == "Sure")
    right = table.columnViewportPosition(sure) + table.columnWidth(sure)
    assert not table.isColumnHidden(sure)
    assert right <= table.viewport().width()
    assert table.columnWidth(sure) >= table.fontMetrics().horizontalAdvance("100 %")

"""The table of segments."""

import csv
import dataclasses
import io
import math

import pytest
from PySide6.QtCore import QLocale, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit

from bobdesk.ui.segments.automatic_operations import automatic_operations
from bobdesk.ui.segments.kind_delegate import KindDelegate
from bobdesk.ui.segments.segments_table import SegmentsTable


@pytest.fixture
def table(desk, now, shown):
    return shown(SegmentsTable(desk), 900, 500)


def cell(table, row, name):
    return table.segments.index(row, table.segments.column(name))


def text(table, row, name):
    return cell(table, row, name).data()


def edit(table, row, name, value):
    return table.segments.setData(cell(table, row, name), value)


def test_every_column_is_filled(now, table):
    assert [text(table, 0, name) for name in ("#", "kind", "from", "radius", "side")] == [
        "1",
        "straight",
        "0.0",
        "–",
        "",
    ]
    figures = now.figures[1]
    assert text(table, 1, "kind") == "curve"
    assert float(text(table, 1, "radius")) == pytest.approx(figures.radius, abs=0.06)
    assert text(table, 1, "side") == "left"
    assert text(table, 1, "turn").endswith("°")
    assert text(table, 1, "gradient") == "–"


def test_stations_lengths_names_and_kinds_are_typed(desk, now, table, told):
    end = now.segments[1].end
    assert edit(table, 1, "to", f"{end + 4:.1f}")
    assert now.segments[1].end == pytest.approx(end + 4, abs=0.06)
    assert edit(table, 2, "from", str(round(end, 3)))
    assert edit(table, 1, "length", "40")
    assert now.segments[1].length == pytest.approx(40)
    assert edit(table, 1, "name", "Kreisel")
    assert edit(table, 1, "kind", "straight")
    assert now.segments[1].kind == "straight"
    assert now.segments[1].name == "Kreisel"
    assert not edit(table, 1, "to", "far")
    assert told[-1] == "'far' is not a number; write it like 1234.5."
    for _ in range(5):
        desk.session.undo()
    assert now.segments[1].end == end


@pytest.mark.parametrize("column", ["from", "length", "to"])
@pytest.mark.parametrize("way", ["short", "long"])
def test_what_is_typed_out_of_range_is_said_with_numbers(desk, now, table, told, column, way):
    boundary = 2 if column == "from" else 3
    first, last = now.segments[boundary].start + 3.0, now.segments[boundary + 1].end - 3.0
    typed = {"short": "1.5", "long": "900"}[way] if column == "length" else {"short": "-20", "long": "5000"}[way]
    assert edit(table, 3, column, typed)
    wanted = first if way == "short" else last
    assert now.segments[boundary].end == pytest.approx(wanted)
    assert len(told) == 1
    number = desk.quantities.length
    assert told[0] == (
        f"{typed} is out of range: the boundary between segments {boundary + 1} and {boundary + 2} can lie from"
        f" {number(first, unit=False)} to {number(last)}, for no segment may be shorter than 3.0 m;"
        f" it is at {number(wanted)} now."
    )


def test_what_is_typed_within_range_says_nothing(now, table, told):
    assert edit(table, 3, "to", str(now.segments[3].start + 3.0))
    assert told == []


def test_the_ends_of_the_line_cannot_be_typed(now, table):
    last = len(now.segments) - 1
    editable = Qt.ItemFlag.ItemIsEditable
    assert not table.segments.flags(cell(table, 0, "from")) & editable
    assert not table.segments.flags(cell(table, last, "to")) & editable
    assert table.segments.flags(cell(table, 1, "from")) & editable


def test_feet_are_typed_as_feet(desk, now, table):
    desk.settings.length_unit = "ft"
    assert "ft" in table.segments.headings()[2]
    assert edit(table, 1, "length", "100")
    assert now.segments[1].length == pytest.approx(30.48)


def test_a_box_locks(desk, now, table):
    state = Qt.CheckState.Checked.value
    assert table.segments.setData(cell(table, 3, "lock"), state, Qt.ItemDataRole.CheckStateRole)
    assert now.segments[3].locked


def test_sorting_keeps_rows_and_segments_together(desk, now, table):
    table.sortByColumn(table.segments.column("length"), Qt.SortOrder.DescendingOrder)
    longest = max(range(17), key=lambda index: now.segments[index].length)
    table.selectRow(0)
    assert desk.selection.segments == (longest,)
    segment = now.segments[longest]
    assert desk.selection.station == pytest.approx(0.5 * (segment.start + segment.end))
    desk.selection.segments = (2, 3)
    chosen = sorted(table._row_of(index.row()) for index in table.selectionModel().selectedRows())
    assert chosen == [2, 3]


def test_rows_are_copied_as_a_spreadsheet_takes_them(desk, table):
    desk.selection.segments = (0, 1)
    QTest.keyClick(table, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    lines = QGuiApplication.clipboard().text().splitlines()
    assert len(lines) == 3
    rows = [line.split("\t") for line in lines]
    assert {len(row) for row in rows} == {table.segments.columnCount()}
    assert rows[1][:2] == ["1", "straight"]
    assert rows[1][4] == ""
    QLocale.setDefault(QLocale(QLocale.Language.German))
    table.copy()
    assert "," in QGuiApplication.clipboard().text().split("\n")[2].split("\t")[3]


def test_letters_do_not_begin_to_edit(table):
    table.setCurrentIndex(table.model().index(1, 0))
    QTest.keyClick(table, Qt.Key.Key_X)
    assert table.state() != table.State.EditingState


def test_the_kind_is_chosen_from_a_list(desk, now, table):
    delegate = table.itemDelegateForColumn(table.segments.column("kind"))
    assert isinstance(delegate, KindDelegate)
    index = table.model().index(0, table.segments.column("kind"))
    table.edit(index)
    box = table.findChild(
        type(delegate.createEditor(table, None, index)), options=Qt.FindChildOption.FindChildrenRecursively
    )
    box.setCurrentIndex(1)
    delegate.setModelData(box, table.model(), index)
    assert now.segments[0].kind == "curve"


@pytest.mark.parametrize("name", ['"Bayern" Kurve', "a\tb", 'Öhr, "x"', "two\nlines"])
def test_any_name_stays_one_cell_of_a_spreadsheet(desk, now, table, name):
    named = (*now.segments[:1], dataclasses.replace(now.segments[1], name=name), *now.segments[2:])
    desk.session.apply("Name", lambda project: dataclasses.replace(project, segments=named))
    desk.selection.segments = (1,)
    table.copy()
    head, row = csv.reader(io.StringIO(QGuiApplication.clipboard().text(), newline=""), delimiter="\t")
    assert row[table.segments.column("name")] == name
    assert len(row) == len(head)
    assert float(row[table.segments.column("turn")]) == pytest.approx(math.degrees(now.figures[1].turn), abs=0.06)


def test_while_a_threshold_is_tried_no_row_is_edited(desk, now, table, idle, told):
    automatic_operations(desk).preview_threshold(0.03)
    idle()
    before = desk.session.project
    assert not edit(table, 1, "kind", "straight" if now.segments[1].kind == "curve" else "curve")
    assert desk.session.project is before
    assert "is being tried" in told[-1]


def test_german_numbers_are_typed_into_cells(desk, now, table, qtbot, told):
    QLocale.setDefault(QLocale(QLocale.Language.German))
    index = table.model().index(3, table.segments.column("length"))

    def typed(text):
        table.edit(index)
        editor = table.findChild(QLineEdit)
        editor.selectAll()
        QTest.keyClicks(editor, text)
        QTest.keyClick(editor, Qt.Key.Key_Return)
        qtbot.waitUntil(lambda: table.findChild(QLineEdit) is None)

    typed("12,5")
    assert now.segments[3].length == pytest.approx(12.5)
    typed("13.25")
    assert now.segments[3].length == pytest.approx(13.25)
    typed("1.290")
    assert now.segments[3].length == pytest.approx(13.25)
    assert len(told) == 1
    assert "can be read as" in told[0]

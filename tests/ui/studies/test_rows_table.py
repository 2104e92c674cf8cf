"""Rows that keep coming into a table that is sorted, and the line of a job that is told of its state often."""

import pytest
from PySide6.QtCore import Qt

from bobdesk.ui.studies.job_bar import JobBar
from bobdesk.ui.studies.rows_table import RowsColumn, RowsModel, RowsTable

UP, DOWN = Qt.SortOrder.AscendingOrder, Qt.SortOrder.DescendingOrder


class Asked:
    """A column's key that counts how often it is asked."""

    def __init__(self):
        self.count = 0

    def __call__(self, row):
        self.count += 1
        return row[0]


@pytest.fixture
def asked():
    return Asked()


@pytest.fixture
def table(qtbot, asked):
    model = RowsModel(
        (
            RowsColumn(lambda: "n", "", lambda row: str(row[0]), asked),
            RowsColumn(lambda: "word", "", lambda row: row[1], is_number=False),
        )
    )
    made = RowsTable("rows", model)
    model.setParent(made)
    qtbot.addWidget(made)
    return made


@pytest.mark.parametrize(("order", "expected"), [(UP, [1, 2, 3, 4, 5, None]), (DOWN, [5, 4, 3, 2, 1, None])])
def test_rows_that_come_later_take_their_places(table, order, expected):
    model = table.rows_model
    model.show_rows([(3, "c"), (None, "x"), (1, "a")])
    table.sortByColumn(0, order)
    table.choose([row[0] for row in model.rows].index(3))
    chosen = table.chosen
    model.add_rows([(5, "e"), (2, "b")])
    model.add_rows([(4, "d")])
    assert [row[0] for row in model.rows] == expected
    assert table.chosen is chosen
    assert [model.index(row, 0).data() for row in range(6)] == [str(value) for value in expected]


def test_each_row_is_asked_once_for_what_it_is_sorted_by(table, asked):
    model = table.rows_model
    table.sortByColumn(0, UP)
    for number in range(50):
        model.add_rows([(number % 7, "a"), (number % 5, "b")])
    assert asked.count == 100
    assert [row[0] for row in model.rows] == sorted(row[0] for row in model.rows)


def test_another_column_or_none_sorts_all_rows_anew(table):
    model = table.rows_model
    table.sortByColumn(0, UP)
    model.add_rows([(1, "b"), (2, "c")])
    table.sortByColumn(1, UP)
    model.add_rows([(3, "a")])
    assert [row[1] for row in model.rows] == ["a", "b", "c"]
    table.sortByColumn(-1, UP)
    model.add_rows([(0, "0")])
    assert [row[1] for row in model.rows] == ["a", "b", "c", "0"]
    table.sortByColumn(0, DOWN)
    model.show_rows([(7, "x"), (9, "y")])
    assert [row[0] for row in model.rows] == [9, 7]


def test_texts_in_other_units_are_sorted_anew(table):
    words = {1: "b", 2: "a"}
    column = RowsColumn(lambda: "word", "", lambda row: words[row[0]], is_number=False)
    model = RowsModel((column,), parent=table)
    model.sort(0, UP)
    model.add_rows([(1,), (2,)])
    assert [row[0] for row in model.rows] == [2, 1]
    words[1] = "0"
    model.refresh()
    assert [row[0] for row in model.rows] == [1, 2]


def test_the_same_icon_is_not_drawn_anew(qtbot, window):
    bar = JobBar(window)
    bar.show_work("Pause", "", "pause")
    drawn = bar.main_button.icon().cacheKey()
    bar.show_work("Pause", "", "pause")
    assert bar.main_button.icon().cacheKey() == drawn
    bar.show_work("Go on", "", "run")
    assert bar.main_button.icon().cacheKey() != drawn
    assert not bar.main_button.icon().isNull()

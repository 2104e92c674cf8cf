"""A table of results that can be sorted by any column and copied as it stands."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Any

from PySide6.QtCore import QItemSelectionModel, QObject, Qt
from PySide6.QtGui import QColor, QFontMetrics, QGuiApplication, QKeyEvent, QKeySequence, QPixmap
from PySide6.QtWidgets import QAbstractItemView, QTableView, QWidget

from bobdesk.ui.table_text import plain_number, table_text
from bobdesk.ui.theme import colours
from bobdesk.ui.widgets.headed_model import NOWHERE, HeadedModel, Index

_ROOM_IN_ROW = 8
_WIDEST, _SAMPLED_ROWS = 360, 200
Row = Any


@dataclass(frozen=True)
class RowsColumn:
    """A column.

    Attributes
    ----------
    heading
        Asked each time, since units change; in one line or two.
    tip
        A sentence about it.
    text
        What a row shows.
    key
        What rows are sorted by; None sorts last, whichever way. Without it the text is.
    is_number
        Right aligned.
    """

    heading: Callable[[], str]
    tip: str
    text: Callable[[Row], str]
    key: Callable[[Row], Any] | None = None
    is_number: bool = True


class RowsModel(HeadedModel):
    """Rows, in the order in which the user wants to see them.

    Parameters
    ----------
    problem
        Why a row failed, in a sentence; "" for others. It stands out, and its tip says why.
    dot
        The picture before the first column of a row, or None.
    """

    def __init__(
        self,
        columns: Sequence[RowsColumn],
        *,
        problem: Callable[[Row], str] = lambda _row: "",
        dot: Callable[[Row], QPixmap | None] = lambda _row: None,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._columns = tuple(columns)
        self._problem, self._dot = problem, dot
        self._rows: list[Row] = []
        self._sorted_by: tuple[int, Qt.SortOrder] | None = None
        # What is sorted, with what it is sorted by, and the rows that have nothing of it: where 100,000 keep coming,
        # each is asked once.
        self._keyed: list[tuple[Any, Row]] = []
        self._without: list[Row] = []

    @property
    def rows(self) -> tuple[Row, ...]:
        """The rows in the order in which they are shown."""
        return tuple(self._rows)

    def headed(self) -> tuple[RowsColumn, ...]:
        """Return the columns."""
        return self._columns

    def show_rows(self, rows: Sequence[Row]) -> None:
        """Show these rows in the place of all others."""
        self.beginResetModel()
        self._rows = self._in_order(list(rows))
        self._count = len(self._rows)
        self.endResetModel()

    def add_rows(self, rows: Sequence[Row]) -> None:
        """Show more rows, below the others, or where the order wants them."""
        if not rows:
            return
        self.beginInsertRows(NOWHERE, self._count, self._count + len(rows) - 1)
        self._rows += rows
        self._count = len(self._rows)
        self.endInsertRows()
        if self._sorted_by is not None:
            self._rearrange(lambda: self._among_others(rows))

    def refresh(self) -> None:
        """Show the same rows in other units or colours; texts that they are sorted by may be others, too."""
        if self._sorted_by is not None:
            self.sort(*self._sorted_by)
        self.headerDataChanged.emit(Qt.Orientation.Horizontal, 0, len(self._columns) - 1)
        if self._count:
            self.dataChanged.emit(self.index(0, 0), self.index(self._count - 1, len(self._columns) - 1))

    def sort(self, column: int, order: Qt.SortOrder = Qt.SortOrder.AscendingOrder) -> None:
        """Bring the rows into the order of a column; what is selected stays selected."""
        self._sorted_by = (column, order) if column >= 0 else None
        self._rearrange(lambda: self._in_order(self._rows))

    def _rearrange(self, ordered: Callable[[], list[Row]]) -> None:
        self.layoutAboutToBeChanged.emit()
        before = self.persistentIndexList()
        meant = [self._rows[index.row()] for index in before]
        self._rows = ordered()
        wanted = {id(row) for row in meant}
        at = {id(row): number for number, row in enumerate(self._rows) if id(row) in wanted} if wanted else {}
        after = [self.index(at[id(row)], index.column()) for row, index in zip(meant, before, strict=True)]
        self.changePersistentIndexList(before, after)
        self.layoutChanged.emit()

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Return what a cell shows."""
        if not index.isValid():
            return None
        row, column = self._rows[index.row()], self._columns[index.column()]
        if role == Qt.ItemDataRole.DisplayRole:
            return column.text(row)
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return self.alignment_of(index.column())
        if role == Qt.ItemDataRole.DecorationRole and index.column() == 0:
            return self._dot(row)
        if role == Qt.ItemDataRole.ToolTipRole:
            return self._problem(row) or (column.text(row) if not column.is_number else column.tip)
        if role == Qt.ItemDataRole.AccessibleTextRole:
            return " ".join(f"{column.heading()} {column.text(row)}".split())
        if role == Qt.ItemDataRole.ForegroundRole and self._problem(row):
            return QColor(colours().error)
        return None

    def as_text(self) -> str:
        """Return the table as spreadsheets take it."""
        lines = [[column.heading() for column in self._columns]]
        lines += [
            [plain_number(column.text(row)) if column.is_number else column.text(row) for column in self._columns]
            for row in self._rows
        ]
        return table_text([" ".join(cell.split()) for cell in line] for line in lines)

    def _in_order(self, rows: list[Row]) -> list[Row]:
        self._keyed, self._without = [], []
        return rows if self._sorted_by is None else self._among_others(rows)

    def _among_others(self, rows: Sequence[Row]) -> list[Row]:
        """Sort rows among those that are sorted already."""
        assert self._sorted_by is not None
        column, order = self._columns[self._sorted_by[0]], self._sorted_by[1]
        for row in rows:
            key = _sort_key(column, row)
            if key is None:
                self._without.append(row)
            else:
                self._keyed.append((key, row))
        self._keyed.sort(key=itemgetter(0), reverse=order == Qt.SortOrder.DescendingOrder)
        return [row for _, row in self._keyed] + self._without


def _sort_key(column: RowsColumn, row: Row) -> Any:
    return column.text(row).casefold() or None if column.key is None else column.key(row)


class RowsTable(QTableView):
    """Fills the room that it is given; a click on a heading sorts, Ctrl+C copies."""

    def __init__(self, name: str, model: RowsModel, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.rows_model = model
        self.setAccessibleName(name)
        self.setModel(model)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setAlternatingRowColors(True)
        self.setTabKeyNavigation(False)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setHorizontalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(QFontMetrics(self.font()).height() + _ROOM_IN_ROW)
        header = self.horizontalHeader()
        header.setHighlightSections(False)
        header.setSectionsClickable(True)
        header.setSortIndicatorClearable(True)
        header.setSortIndicator(-1, Qt.SortOrder.AscendingOrder)
        self.setSortingEnabled(True)

    @property
    def chosen(self) -> Row | None:
        """The selected row."""
        found = self.selectionModel().selectedRows()
        return self.rows_model.rows[found[0].row()] if found else None

    def choose(self, row: int) -> None:
        """Select a row by its number from the top."""
        flags = QItemSelectionModel.SelectionFlag.ClearAndSelect | QItemSelectionModel.SelectionFlag.Rows
        self.selectionModel().setCurrentIndex(self.rows_model.index(row, 0), flags)

    def fit_columns(self) -> None:
        """Make each column as wide as its heading and its first rows, within reason."""
        metrics = QFontMetrics(self.font())
        room = 2 * metrics.averageCharWidth() + 10
        rows = self.rows_model.rows[:_SAMPLED_ROWS]
        for index, column in enumerate(self.rows_model.headed()):
            # Headings are bold by style sheet, which the metrics do not know, and have the sort mark beside them.
            lines = column.heading().split("\n")
            heading = round(1.15 * max(metrics.horizontalAdvance(line) for line in lines)) + 16
            widest = max((metrics.horizontalAdvance(column.text(row)) for row in rows), default=0)
            dot = 20 if index == 0 else 0
            self.setColumnWidth(index, min(max(heading, widest + dot), _WIDEST) + room)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Copy the whole table: a single cell is of little use."""
        if event.matches(QKeySequence.StandardKey.Copy):
            self.copy()
        else:
            super().keyPressEvent(event)

    def copy(self) -> None:
        """Put the table on the clipboard as it is shown, with tabs."""
        QGuiApplication.clipboard().setText(self.rows_model.as_text())

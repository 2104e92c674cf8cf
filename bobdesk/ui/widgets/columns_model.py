"""A table model made of columns: what each shows, how a cell is edited, and which rows stand out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QColor, QFont, QIcon

from bobdesk.errors import InputError
from bobdesk.ui.icons import icon
from bobdesk.ui.theme import Colours, colours
from bobdesk.ui.widgets.headed_model import HeadedModel, Index


def nothing_said(_row: int) -> str:
    """No row stands out."""
    return ""


def never(_row: int) -> bool:
    """No row at all."""
    return False


@dataclass(frozen=True)
class Column:
    """One column.

    Attributes
    ----------
    heading
        Asked each time, since units change.
    tip
        A sentence: tool tip of heading and cells.
    text
        What a row shows.
    edit_text, change
        For cells that can be edited: what stands in the editor, and what is done with the new text; it
        raises InputError for text that cannot be used, and returns whether the project took it.
    is_checked, check
        For cells with a check box.
    marks
        The cell of a row that stands out is emphasised here.
    is_number
        Right aligned.
    """

    heading: Callable[[], str]
    tip: str
    text: Callable[[int], str]
    edit_text: Callable[[int], str] | None = None
    change: Callable[[int, str], bool] | None = None
    is_checked: Callable[[int], bool] | None = None
    check: Callable[[int, bool], bool] | None = None
    marks: bool = False
    is_number: bool = True


class ColumnsModel(HeadedModel):
    """Rows of the document seen through columns; it holds nothing but their number.

    Parameters
    ----------
    count
        How many rows the document has now.
    refuse
        Takes the sentence about text that cannot be used.
    stands_out
        Why a row stands out, in a sentence; "" for most.
    is_faint
        Whether a row takes no part.
    """

    def __init__(
        self,
        columns: tuple[Column, ...],
        count: Callable[[], int],
        refuse: Callable[[str], object],
        *,
        stands_out: Callable[[int], str] = nothing_said,
        is_faint: Callable[[int], bool] = never,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._columns = columns
        self._count_now = count
        self._refuse = refuse
        self._stands_out = stands_out
        self._is_faint = is_faint
        self._count = count()
        # An index that is nowhere has the column -1, the last one here.
        self._flags = (*(_flags(column) for column in columns), Qt.ItemFlag.NoItemFlags)
        self._icon: tuple[Colours, QIcon] | None = None

    def refresh(self) -> None:
        """Show the document as it is now."""
        count = self._count_now()
        if count != self._count:
            self.beginResetModel()
            self._count = count
            self.endResetModel()
        elif count:
            self.dataChanged.emit(self.index(0, 0), self.index(count - 1, len(self._columns) - 1))

    def refresh_headings(self) -> None:
        """Show other units."""
        self.headerDataChanged.emit(Qt.Orientation.Horizontal, 0, len(self._columns) - 1)
        self.refresh()

    def headed(self) -> tuple[Column, ...]:
        """Return the columns."""
        return self._columns

    def flags(self, index: Index) -> Qt.ItemFlag:
        """Say what can be edited and checked."""
        # Headings ask this of every cell of a selected column: 120,000 times for 20,000 vertices.
        return self._flags[index.column()]

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Return what a cell shows."""
        row = index.row()
        # Between an edit and `refresh` the document may have fewer rows than the view knows of.
        if not index.isValid() or row >= self._count_now():
            return None
        column = self._columns[index.column()]
        if role == Qt.ItemDataRole.DisplayRole:
            return column.text(row)
        if role == Qt.ItemDataRole.EditRole:
            return column.text(row) if column.edit_text is None else column.edit_text(row)
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return self.alignment_of(index.column())
        if role == Qt.ItemDataRole.CheckStateRole and column.is_checked is not None:
            return Qt.CheckState.Checked if column.is_checked(row) else Qt.CheckState.Unchecked
        if role == Qt.ItemDataRole.ToolTipRole:
            return self._stands_out(row) or column.tip
        if role == Qt.ItemDataRole.AccessibleTextRole:
            return f"{column.heading()} {column.text(row)}".strip()
        return self._look(row, column, role)

    def setData(self, index: Index, value: Any, role: int = Qt.ItemDataRole.EditRole) -> bool:
        """Edit a cell by way of the document; the old text stays if that refuses."""
        row = index.row()
        if not index.isValid() or row >= self._count_now():
            return False
        column = self._columns[index.column()]
        if role == Qt.ItemDataRole.CheckStateRole and column.check is not None:
            return column.check(row, Qt.CheckState(value) == Qt.CheckState.Checked)
        if role != Qt.ItemDataRole.EditRole or column.change is None or column.edit_text is None:
            return False
        text = str(value)
        if text == column.edit_text(row):
            return True
        try:
            return column.change(row, text)
        except InputError as error:
            self._refuse(str(error))
            return False

    def _look(self, row: int, column: Column, role: int) -> Any:
        marked = bool(self._stands_out(row))
        if role == Qt.ItemDataRole.BackgroundRole and marked:
            return QColor(colours().error_soft)
        if role == Qt.ItemDataRole.ForegroundRole:
            if marked and column.marks:
                return QColor(colours().error)
            return QColor(colours().muted) if self._is_faint(row) else None
        if role == Qt.ItemDataRole.FontRole and marked and column.marks:
            bold = QFont()
            bold.setBold(True)
            return bold
        if role == Qt.ItemDataRole.DecorationRole and marked and not column.is_number and column.check is None:
            return self._warning()
        return None

    def _warning(self) -> QIcon:
        """Return the icon in the colours in force; drawing it for every cell would take longer than the table."""
        if self._icon is None or self._icon[0] != colours():
            self._icon = (colours(), icon("warning"))
        return self._icon[1]


def _flags(column: Column) -> Qt.ItemFlag:
    found = Qt.ItemFlag.ItemIsSelectable | Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemNeverHasChildren
    if column.change is not None:
        found |= Qt.ItemFlag.ItemIsEditable
    if column.check is not None:
        found |= Qt.ItemFlag.ItemIsUserCheckable
    return found

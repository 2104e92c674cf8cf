"""What table models with described columns have in common: their size, headings and tips."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, Qt

Index = QModelIndex | QPersistentModelIndex
NOWHERE = QModelIndex()


class Headed(Protocol):
    """A column: its heading, asked each time since units change, its tip, and whether it holds numbers."""

    @property
    def heading(self) -> Callable[[], str]:
        """Returns the text of the heading."""

    @property
    def tip(self) -> str:
        """A sentence."""

    @property
    def is_number(self) -> bool:
        """Right aligned."""


class HeadedModel(QAbstractTableModel):
    """A subclass sets `_count`, how many rows the view knows of."""

    _count = 0

    def headed(self) -> Sequence[Headed]:
        """Return the columns."""
        raise NotImplementedError

    def alignment_of(self, section: int) -> Qt.AlignmentFlag:
        """Return how heading and cells of a column are aligned."""
        is_number = self.headed()[section].is_number
        side = Qt.AlignmentFlag.AlignRight if is_number else Qt.AlignmentFlag.AlignLeft
        return side | Qt.AlignmentFlag.AlignVCenter

    def rowCount(self, parent: Index = NOWHERE) -> int:
        """Return the number of rows."""
        return 0 if parent.isValid() else self._count

    def columnCount(self, parent: Index = NOWHERE) -> int:
        """Return the number of columns."""
        return 0 if parent.isValid() else len(self.headed())

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Return a heading, or its tip."""
        if orientation != Qt.Orientation.Horizontal or not 0 <= section < len(self.headed()):
            return None
        column = self.headed()[section]
        if role == Qt.ItemDataRole.DisplayRole:
            return column.heading()
        if role == Qt.ItemDataRole.ToolTipRole:
            return column.tip
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return self.alignment_of(section)
        return None

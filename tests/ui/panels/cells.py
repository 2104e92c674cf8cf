"""Cells of a table as a person sees and edits them."""

from __future__ import annotations

from PySide6.QtCore import QAbstractItemModel, Qt


def typed(model: QAbstractItemModel, row: int, column: int, text: str) -> bool:
    """Edit a cell as the table's editor does."""
    return model.setData(model.index(row, column), text, Qt.ItemDataRole.EditRole)


def shown(model: QAbstractItemModel, row: int, column: int) -> str:
    """Return the text of a cell."""
    return str(model.data(model.index(row, column)))


def checked(model: QAbstractItemModel, row: int, column: int, on: bool) -> bool:
    """Click a cell's check box."""
    state = Qt.CheckState.Checked if on else Qt.CheckState.Unchecked
    return model.setData(model.index(row, column), state, Qt.ItemDataRole.CheckStateRole)

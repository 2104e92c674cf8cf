"""The segments as a table: what is shown now, edited by way of the document."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from PySide6.QtCore import QObject, Qt

from bobdesk.errors import InputError
from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.segments.operations import operations
from bobdesk.ui.strips.run_profile import RunProfile, run_profile_later
from bobdesk.ui.table_text import plain_number
from bobdesk.ui.widgets.headed_model import HeadedModel, Index
from bobdesk.ui.widgets.typed_number import number_to_edit, typed_number

SORT_ROLE = Qt.ItemDataRole.UserRole
KIND, LOCK = "kind", "lock"


@dataclass(frozen=True)
class _Column:
    """A column: what it shows, what it is sorted by, and how a new text is taken."""

    name: str
    heading: Callable[[], str]
    tip: str
    text: Callable[[int], str]
    value: Callable[[int], Any]
    to_edit: Callable[[int], str] | None = None
    change: Callable[[int, str], bool] | None = None
    is_number: bool = True


class SegmentsModel(HeadedModel):
    """Holds nothing but how many rows were shown last."""

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._now = alignment_now(desk)
        self._operations = operations(desk)
        self._profile = run_profile_later(desk)
        self._columns = self._made_columns()
        self._shown = self._now.segments
        self._count = len(self._shown)
        self._now.changed.connect(self.refresh)
        self._profile.changed.connect(self.refresh_all)
        desk.quantities.changed.connect(self._on_units)

    def refresh(self) -> None:
        """Show the segments as they are now."""
        before, self._shown = self._shown, self._now.segments
        count = len(self._shown)
        if count != self._count:
            self.beginResetModel()
            self._count = count
            self.endResetModel()
        else:
            others = [row for row in range(count) if self._shown[row] is not before[row]]
            if others:
                self._tell(others[0], others[-1])

    def refresh_all(self) -> None:
        """Show every row anew: their figures may be others though the segments are not."""
        self.refresh()
        if self._count:
            self._tell(0, self._count - 1)

    def column(self, name: str) -> int:
        """Return the number of a column."""
        return next(number for number, column in enumerate(self._columns) if column.name == name)

    def headings(self) -> list[str]:
        """Return all headings."""
        return [column.heading() for column in self._columns]

    def row_texts(self, row: int) -> list[str]:
        """Return what a row shows, as a spreadsheet of the user's country reads it."""
        texts = []
        for column in self._columns:
            value = column.value(row)
            if column.name == LOCK:
                texts.append(self.tr("yes") if value else "")
            elif column.is_number and isinstance(value, float):
                texts.append("" if not math.isfinite(value) else plain_number(column.text(row).rstrip("°")))
            else:
                texts.append(column.text(row))
        return texts

    def alignment_of(self, section: int) -> Qt.AlignmentFlag:
        """Return how a column is aligned; the lock stands in the middle."""
        if self._columns[section].name == LOCK:
            return Qt.AlignmentFlag.AlignCenter
        return super().alignment_of(section)

    def headed(self) -> tuple[_Column, ...]:
        """Return the columns."""
        return self._columns

    def flags(self, index: Index) -> Qt.ItemFlag:
        """Say what can be edited."""
        found = super().flags(index)
        if not index.isValid() or index.row() >= len(self._now.segments):
            return found
        column, row = self._columns[index.column()], index.row()
        if column.name == LOCK:
            return found | Qt.ItemFlag.ItemIsUserCheckable
        is_end = (column.name == "from" and row == 0) or (column.name in ("to", "length") and row == self._count - 1)
        if column.change is not None and not is_end:
            found |= Qt.ItemFlag.ItemIsEditable
        return found

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Return what a cell shows."""
        row = index.row()
        if not index.isValid() or row >= len(self._now.segments):
            return None
        column = self._columns[index.column()]
        if role == Qt.ItemDataRole.DisplayRole:
            return column.text(row)
        if role == Qt.ItemDataRole.EditRole:
            return column.text(row) if column.to_edit is None else column.to_edit(row)
        if role == SORT_ROLE:
            return column.value(row)
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return self.alignment_of(index.column())
        if role == Qt.ItemDataRole.CheckStateRole and column.name == LOCK:
            return Qt.CheckState.Checked if column.value(row) else Qt.CheckState.Unchecked
        if role == Qt.ItemDataRole.ToolTipRole:
            made = self.tr("Made by hand; detecting again leaves it.") if self._now.segments[row].by_hand else ""
            return f"{column.tip}\n{made}".strip()
        if role == Qt.ItemDataRole.AccessibleTextRole:
            return f"{column.heading()} {' '.join(self.row_texts(row)[index.column()].split())}".strip()
        return None

    def setData(self, index: Index, value: Any, role: int = Qt.ItemDataRole.EditRole) -> bool:
        """Edit a cell by way of the document; what cannot be is said, and the old text stays."""
        row = index.row()
        if not index.isValid() or row >= len(self._now.segments):
            return False
        if self._now.is_trying_threshold:
            # The rows are those of a threshold that is tried, and may be other segments than the document's.
            self._desk.notices.refuse(self.tr("A threshold is being tried; edit the table when that is done."))
            return False
        column = self._columns[index.column()]
        if role == Qt.ItemDataRole.CheckStateRole and column.name == LOCK:
            return self._operations.set_locked(row, locked=Qt.CheckState(value) == Qt.CheckState.Checked)
        if role != Qt.ItemDataRole.EditRole or column.change is None:
            return False
        text = str(value)
        if column.to_edit is not None and text == column.to_edit(row):
            return True
        try:
            return column.change(row, text)
        except InputError as error:
            self._desk.notices.refuse(str(error), weight="warning")
            return False

    def kinds(self) -> tuple[tuple[str, str], ...]:
        """Return both kinds, as they are stored and as they are shown."""
        return (("straight", self.tr("straight")), ("curve", self.tr("curve")))

    def gradient_of(self, row: int) -> tuple[float, float]:
        """Return mean gradient and drop of a segment in the chosen run, NaN before there is one."""
        profile, value = self._profile.value, self._now.value
        if not isinstance(profile, RunProfile) or value is None or self._desk.session.project.run is None:
            return math.nan, math.nan
        segment, length = self._now.segments[row], value.line.length
        ends = np.interp([segment.start / length, segment.end / length], profile.shares, profile.elevations)
        drop = float(ends[0] - ends[1])
        return drop / (segment.length / length * profile.length), drop

    def _made_columns(self) -> tuple[_Column, ...]:
        unit = self._desk.quantities

        def with_unit(text: str) -> Callable[[], str]:
            return lambda: f"{text} {unit.length_unit}"

        return (
            _Column("#", lambda: "#", self.tr("Number of the segment"), lambda row: str(row + 1), lambda row: row),
            _Column(
                KIND, lambda: self.tr("Kind"), self.tr("Straight or curve"),
                lambda row: dict(self.kinds())[self._segment(row).kind], lambda row: self._segment(row).kind,
                lambda row: self._segment(row).kind, self._set_kind, is_number=False,
            ),
            _Column(
                "from", with_unit(self.tr("From")), self.tr("Station where the segment begins"),
                lambda row: self._length(self._segment(row).start), lambda row: self._segment(row).start,
                lambda row: self._to_edit(self._segment(row).start), self._set_from,
            ),
            _Column(
                "length", with_unit(self.tr("Length")), self.tr("Length in plan; typing one moves the end"),
                lambda row: self._length(self._segment(row).length), lambda row: self._segment(row).length,
                lambda row: self._to_edit(self._segment(row).length), self._set_length,
            ),
            _Column(
                "radius", with_unit(self.tr("Radius")), self.tr("Radius of the arc fitted to the curve"),
                self._radius, lambda row: self._radius_value(row),
            ),
            _Column(LOCK, lambda: self.tr("Lock"), self.tr("Locked segments are never changed"), lambda _row: "",
                    lambda row: self._segment(row).locked, is_number=False),
            _Column(
                "name", lambda: self.tr("Name"), self.tr("Curve number or name, as the track has it"),
                lambda row: self._segment(row).name, lambda row: self._segment(row).name,
                lambda row: self._segment(row).name, self._operations.rename, is_number=False,
            ),
            _Column(
                "to", with_unit(self.tr("To")), self.tr("Station where the segment ends"),
                lambda row: self._length(self._segment(row).end), lambda row: self._segment(row).end,
                lambda row: self._to_edit(self._segment(row).end), self._set_to,
            ),
            _Column(
                "side", lambda: self.tr("Side"), self.tr("Which way the curve turns"), self._side, self._side,
                is_number=False,
            ),
            _Column(
                "turn", lambda: self.tr("Turn °"), self.tr("Change of heading from start to end"),
                lambda row: unit.angle(abs(self._now.figures[row].turn)), lambda row: abs(self._now.figures[row].turn),
            ),
            _Column(
                "gradient", lambda: self.tr("Gradient {unit}").format(unit=unit.gradient_unit),
                self.tr("Mean gradient in the chosen run, downhill positive"),
                lambda row: unit.gradient(self.gradient_of(row)[0], unit=False), lambda row: self.gradient_of(row)[0],
            ),
            _Column(
                "drop", with_unit(self.tr("Drop")), self.tr("Height difference in the chosen run"),
                lambda row: unit.length(self.gradient_of(row)[1], 2, unit=False), lambda row: self.gradient_of(row)[1],
            ),
            _Column(
                "fit", with_unit(self.tr("Fit ±")),
                self.tr("Largest distance of the line from the fitted arc or straight"),
                lambda row: unit.length(self._now.figures[row].deviation, 2, unit=False),
                lambda row: self._now.figures[row].deviation,
            ),
        )  # fmt: skip

    def _segment(self, row: int) -> Any:
        return self._now.segments[row]

    def _length(self, metres: float) -> str:
        return self._desk.quantities.length(metres, unit=False)

    def _to_edit(self, metres: float) -> str:
        return number_to_edit(round(metres * self._desk.quantities.length_factor, 3))

    def _metres(self, text: str) -> float:
        return typed_number(text) / self._desk.quantities.length_factor

    def _radius_value(self, row: int) -> float:
        radius = self._now.figures[row].radius
        return math.inf if radius is None or radius > 1e4 else float(radius)

    def _radius(self, row: int) -> str:
        radius = self._radius_value(row)
        return self._desk.quantities.length(radius, unit=False)

    def _side(self, row: int) -> str:
        if self._segment(row).kind == "straight":
            return ""
        return self.tr("left") if self._now.figures[row].turn >= 0 else self.tr("right")

    def _set_kind(self, row: int, kind: str) -> bool:
        return kind == self._segment(row).kind or self._operations.flip_one(row)

    def _set_from(self, row: int, text: str) -> bool:
        return row > 0 and self._operations.put_boundary(row - 1, self._metres(text), text)

    def _set_to(self, row: int, text: str) -> bool:
        return row < self._count - 1 and self._operations.put_boundary(row, self._metres(text), text)

    def _set_length(self, row: int, text: str) -> bool:
        station = self._segment(row).start + self._metres(text)
        return row < self._count - 1 and self._operations.put_boundary(row, station, text)

    def _on_units(self) -> None:
        self.headerDataChanged.emit(Qt.Orientation.Horizontal, 0, len(self._columns) - 1)
        self.refresh_all()

    def _tell(self, first: int, last: int) -> None:
        self.dataChanged.emit(self.index(first, 0), self.index(last, len(self._columns) - 1))

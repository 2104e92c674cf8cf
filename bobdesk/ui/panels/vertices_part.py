"""The vertices of the digitised line as a table; its selection is that of the plan view."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QItemSelection, QItemSelectionModel, Qt

from bobdesk.arrays import BoolArray, FloatArray
from bobdesk.plan.traced_line import Trace
from bobdesk.project import derive, edits
from bobdesk.project.project import Project
from bobdesk.ui.widgets.columns_model import Column, ColumnsModel
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.table import Table
from bobdesk.ui.widgets.typed_number import number_to_edit, typed_number

if TYPE_CHECKING:
    from bobdesk.plan.calibration import Calibration

_X, _Y = 0, 1
_PX_X, _PX_Y, _CONFIDENCE = 1, 2, 5


class VerticesPart(Part):
    """Twenty thousand rows at the price of those that are seen."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Vertices"))
        self._is_linking = False
        self._metres: FloatArray | None = None
        self._calibration: Calibration | None = None
        self._suspect: BoolArray = np.zeros(0, dtype=np.bool_)
        self.model = ColumnsModel(
            self._columns(), self._count, panel.refuse, stands_out=self._why_it_stands_out, parent=self
        )
        self.table = Table(self.tr("Vertices"), self.model, fewest_rows=6, most_rows=10, parent=self)
        self.table.setSelectionMode(Table.SelectionMode.ExtendedSelection)
        self._samples: tuple[str, ...] = ()
        self.column.addWidget(self.table)
        flow = panel.add_buttons(self.column)
        self.show_button = panel.button(
            flow, self.tr("Show"), self.tr("Show the selected vertices in the plan"), "fit-selection"
        )
        self.delete_button = panel.button(
            flow, self.tr("Delete"), self.tr("Delete the selected vertices (Del)"), "delete"
        )
        self.delete_button.clicked.connect(self._delete_selected)
        self.table.on_key(Qt.Key.Key_Delete, self.delete_button)
        self.table.selectionModel().selectionChanged.connect(self._on_rows_selected)
        self.model.modelReset.connect(self._select_rows)
        self.desk.selection.vertices_changed.connect(self._select_rows)
        self.desk.quantities.changed.connect(self.model.refresh_headings)

    def refresh(self, project: Project) -> None:
        """Show the vertices of a project."""
        trace = None if project.source is not None else project.trace
        self.setVisible(trace is not None or project.source is not None)
        self._calibration = None if trace is None else derive.calibration(project).value
        self._metres = self._in_metres(project, trace)
        self._suspect = _suspect_vertices(trace)
        self.table.hide_columns((_PX_X, _PX_Y, _CONFIDENCE) if trace is None else ())
        self.model.refresh()
        self._fit_columns(trace)
        self.delete_button.setVisible(trace is not None)
        self._enable()

    def _fit_columns(self, trace: Trace | None) -> None:
        """Give columns the width of their longest number, found without asking every row."""
        number, length = self.desk.quantities.number, self.desk.quantities.length
        pixels = _longest(None if trace is None else trace.points)
        metres = _longest(self._metres)
        samples = (
            f"⚠⚠ {number(self._count(), 0)}",
            *(number(value, 2) for value in pixels),
            *(length(value, 2, unit=False) for value in metres),
            "100 %",
        )
        wanted = (*samples, "" if self._metres is None else "metres")
        if wanted != self._samples:
            self._samples = wanted
            # The same places stand in metres, once there is a scale.
            self.table.fit_columns(samples, dispensable=() if self._metres is None else (_PX_X, _PX_Y))

    @property
    def _trace(self) -> Trace | None:
        project = self.desk.session.project
        return None if project.source is not None else project.trace

    def _count(self) -> int:
        project = self.desk.session.project
        if project.source is not None:
            return len(project.source.polyline.vertices)
        return 0 if project.trace is None else len(project.trace.points)

    def _in_metres(self, project: Project, trace: Trace | None) -> FloatArray | None:
        if project.source is not None:
            return project.source.polyline.vertices
        known = self._calibration is not None and self._calibration.scale_known
        return self._calibration.to_metres(trace.points) if known and trace is not None and self._calibration else None

    def _columns(self) -> tuple[Column, ...]:
        unit = self.desk.quantities

        def pixels(heading: str, tip: str, axis: int) -> Column:
            return Column(
                lambda: heading,
                tip,
                lambda row: unit.number(self._pixel(row, axis), 2),
                lambda row: number_to_edit(self._pixel(row, axis)),
                lambda row, text: self._move(row, axis, typed_number(text)),
            )

        def metres(heading: str, tip: str, axis: int) -> Column:
            return Column(
                lambda: f"{heading} {unit.length_unit}",
                tip,
                lambda row: unit.length(self._metre(row, axis), 2, unit=False),
                lambda row: number_to_edit(self._shown_metre(row, axis)),
                lambda row, text: self._move_in_metres(row, axis, typed_number(text) / unit.length_factor),
            )

        return (
            Column(lambda: "#", self.tr("Number of the vertex, from the start"), lambda row: unit.number(row + 1, 0),
                   is_number=False),
            pixels("px x", self.tr("Place in the picture, pixels from the left"), _X),
            pixels("px y", self.tr("Place in the picture, pixels from the top"), _Y),
            metres("x", self.tr("Place on the ground, to the east"), _X),
            metres("y", self.tr("Place on the ground, to the north"), _Y),
            Column(lambda: self.tr("Sure"), self.tr("How sure the tracer is; 100 % for what a hand has placed"),
                   self._confidence, marks=True),
        )  # fmt: skip

    def _pixel(self, row: int, axis: int) -> float | None:
        trace = self._trace
        return None if trace is None else float(trace.points[row, axis])

    def _metre(self, row: int, axis: int) -> float | None:
        return None if self._metres is None or row >= len(self._metres) else float(self._metres[row, axis])

    def _shown_metre(self, row: int, axis: int) -> float | None:
        value = self._metre(row, axis)
        return None if value is None else value * self.desk.quantities.length_factor

    def _confidence(self, row: int) -> str:
        trace = self._trace
        return "" if trace is None else f"{self.desk.quantities.number(100 * float(trace.confidence[row]), 0)} %"

    def _why_it_stands_out(self, row: int) -> str:
        if row < len(self._suspect) and self._suspect[row]:
            return self.tr("The line may be wrong here; look at it.")
        return ""

    def _move(self, row: int, axis: int, value: float) -> bool:
        trace = self._trace
        if trace is None:
            self.panel.refuse(self.tr("Coordinates from a file are not edited here."))
            return False
        x, y = trace.points[row].tolist()
        x, y = (value, y) if axis == _X else (x, value)
        return self._place(row, x, y)

    def _move_in_metres(self, row: int, axis: int, value: float) -> bool:
        if self._trace is None:
            self.panel.refuse(self.tr("Coordinates from a file are not edited here."))
            return False
        if self._metres is None or self._calibration is None:
            self.panel.refuse(self.tr("There is no scale yet; edit the pixels."))
            return False
        place = self._metres[row].copy()
        place[axis] = value
        x, y = self._calibration.to_pixels([place])[0].tolist()
        return self._place(row, x, y)

    def _place(self, row: int, x: float, y: float) -> bool:
        return self.desk.session.apply(self.tr("Move vertex"), lambda project: edits.move_vertex(project, row, x, y))

    def _delete_selected(self) -> None:
        chosen = self.desk.selection.vertices
        if chosen and self._trace is not None:
            self.desk.selection.vertices = ()
            self.desk.session.apply(self.tr("Delete vertices"), lambda project: edits.delete_vertices(project, chosen))

    def _on_rows_selected(self) -> None:
        if self._is_linking:
            return
        self._is_linking = True
        try:
            rows: list[int] = []
            for span in self.table.selectionModel().selection().toList():
                rows.extend(range(span.top(), span.bottom() + 1))
            self.desk.selection.vertices = rows
        finally:
            self._is_linking = False
        self._enable()

    def _select_rows(self) -> None:
        if self._is_linking:
            return
        self._is_linking = True
        try:
            self._select(tuple(row for row in self.desk.selection.vertices if row < self.model.rowCount()))
        finally:
            self._is_linking = False
        self._enable()

    def _select(self, rows: tuple[int, ...]) -> None:
        selection, last = QItemSelection(), self.model.columnCount() - 1
        for first, end in _runs(rows):
            selection.select(self.model.index(first, 0), self.model.index(end, last))
        model = self.table.selectionModel()
        model.select(selection, QItemSelectionModel.SelectionFlag.ClearAndSelect)
        if rows:
            model.setCurrentIndex(self.model.index(rows[0], 0), QItemSelectionModel.SelectionFlag.NoUpdate)
            self.table.scrollTo(self.model.index(rows[0], 0))

    def _enable(self) -> None:
        chosen = bool(self.desk.selection.vertices)
        self.show_button.setEnabled(chosen)
        self.delete_button.setEnabled(chosen)


def _runs(rows: tuple[int, ...]) -> list[tuple[int, int]]:
    """Return the first and last of each run of neighbours in ascending rows."""
    if not rows:
        return []
    array = np.array(rows)
    breaks = np.flatnonzero(np.diff(array) > 1)
    firsts, lasts = array[np.concatenate([[0], breaks + 1])], array[np.concatenate([breaks, [len(array) - 1]])]
    return list(zip(firsts.tolist(), lasts.tolist(), strict=True))


def _longest(points: FloatArray | None) -> tuple[float, float]:
    """Return a number for each column that is as long as its longest: negative if any is."""
    if points is None or len(points) == 0:
        return 0.0, 0.0
    largest, lowest = np.abs(points).max(axis=0), points.min(axis=0)
    x, y = np.where(lowest < 0, -largest, largest).tolist()
    return x, y


def _suspect_vertices(trace: Trace | None) -> BoolArray:
    if trace is None:
        return np.zeros(0, dtype=np.bool_)
    found = np.zeros(len(trace.points), dtype=np.bool_)
    for first, last in trace.suspect.tolist():
        found[first : last + 1] = True
    return found

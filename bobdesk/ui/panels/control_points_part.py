"""The table of control points with their residuals, and what can be done about the worst one."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QItemSelectionModel, QSignalBlocker, Qt

from bobdesk.plan.control_points import ControlPoint
from bobdesk.project import derive, edits
from bobdesk.project.project import Project
from bobdesk.ui.actions.scale_actions import ScaleActions
from bobdesk.ui.panels.worst_item import WorstItem, worst_item
from bobdesk.ui.widgets.columns_model import Column, ColumnsModel
from bobdesk.ui.widgets.notice_box import NoticeBox
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.table import Table
from bobdesk.ui.widgets.typed_number import number_to_edit, typed_number

if TYPE_CHECKING:
    from bobdesk.plan.calibration_fit import CalibrationFit, PointResidual


class ControlPointsPart(Part):
    """A row for each control point; the selected row is the selected point everywhere."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Control points"))
        self._fit: CalibrationFit | None = None
        self._worst: WorstItem | None = None
        self._actions = ScaleActions(self.desk, self)
        self.model = ColumnsModel(
            self._columns(),
            lambda: len(self._points),
            panel.refuse,
            stands_out=self._why_it_stands_out,
            is_faint=lambda row: not self._points[row].used,
            parent=self,
        )
        self.table = Table(self.tr("Control points"), self.model, parent=self)
        self.table.setSelectionMode(Table.SelectionMode.SingleSelection)
        self.column.addWidget(self.table)
        self.hint = panel.add_label(self.tr("No control points yet."), "muted", self.column)
        flow = panel.add_buttons(self.column)
        add = panel.button(
            flow, self.tr("Add point"), self.tr("Click a place whose coordinates are known"), "calibrate"
        )
        self.remove_button = panel.button(
            flow, self.tr("Remove"), self.tr("Take the selected control point away (Del)"), "delete"
        )
        self.load_button = panel.button(
            flow, self.tr("Load .points…"), self.tr("Take control points from a QGIS .points file"), "load"
        )
        self.save_button = panel.button(
            flow, self.tr("Save .points…"), self.tr("Write the control points as a QGIS .points file"), "save"
        )
        self.table.on_key(Qt.Key.Key_Delete, self.remove_button)
        add.clicked.connect(lambda: panel.tool_wanted.emit("calibrate"))
        self.remove_button.clicked.connect(self._actions.remove_selected)
        self.load_button.clicked.connect(self._actions.load_by_dialog)
        self.save_button.clicked.connect(self._actions.save_by_dialog)
        self.worst_box = NoticeBox(self)
        self.column.addWidget(self.worst_box)
        self.table.selectionModel().selectionChanged.connect(self._on_row_selected)
        self.model.modelReset.connect(self._select_row)
        self.desk.selection.control_point_changed.connect(self._select_row)
        self.desk.quantities.changed.connect(self.model.refresh_headings)

    @property
    def _points(self) -> tuple[ControlPoint, ...]:
        return self.desk.session.project.control_points

    def refresh(self, project: Project) -> None:
        """Show the points of a project."""
        has_some = bool(project.control_points or project.known_distances)
        self._fit = derive.calibration_fit(project).value if has_some else None
        self.table.setVisible(bool(project.control_points))
        self.hint.setVisible(not project.control_points)
        self.save_button.setEnabled(self._actions.can_save())
        self.load_button.setEnabled(self._actions.can_load())
        self.remove_button.setEnabled(self._actions.can_remove())
        self._worst = worst_item(self._fit)
        self.model.refresh()
        self._say_worst()

    def _columns(self) -> tuple[Column, ...]:
        unit = self.desk.quantities
        number, length = unit.number, unit.length

        def metres(name: str) -> Any:
            return lambda: f"{name} {unit.length_unit}"

        def placed(heading: str, tip: str, field: str) -> Column:
            return Column(
                lambda: heading,
                tip,
                lambda row: number(getattr(self._points[row], field), 1),
                lambda row: number_to_edit(getattr(self._points[row], field)),
                lambda row, text: self._change(row, **{field: typed_number(text)}),
            )

        def known(heading: str, tip: str, field: str) -> Column:
            return Column(
                metres(heading),
                tip,
                lambda row: length(getattr(self._points[row], field), 2, unit=False),
                lambda row: number_to_edit(getattr(self._points[row], field) * unit.length_factor),
                lambda row, text: self._change(row, **{field: typed_number(text) / unit.length_factor}),
            )

        def residual(heading: str, tip: str, field: str, *, in_pixels: bool = False, marks: bool = False) -> Column:
            def text(row: int) -> str:
                found = self._residual(row)
                value = None if found is None else getattr(found, field)
                return number(value, 1) if in_pixels else length(value, 2, unit=False)

            return Column((lambda: heading) if in_pixels else metres(heading), tip, text, marks=marks)

        return (
            Column(
                lambda: "",
                self.tr("Whether the scale is fitted to the point"),
                lambda _row: "",
                is_checked=lambda row: self._points[row].used,
                check=self._use,
                is_number=False,
            ),
            Column(
                lambda: "#",
                self.tr("Name of the point"),
                lambda row: self.name_of(row),
                lambda row: self._points[row].name,
                lambda row, text: self._change(row, name=text.strip()),
                is_number=False,
            ),
            placed("px x", self.tr("Place in the picture, pixels from the left"), "x_px"),
            placed("px y", self.tr("Place in the picture, pixels from the top"), "y_px"),
            known("X", self.tr("Known position to the east"), "x_m"),
            known("Y", self.tr("Known position to the north"), "y_m"),
            residual(self.tr("resid. px"), self.tr("From the known position to the click, pixels"), "norm_px",
                     in_pixels=True, marks=True),
            residual(self.tr("resid."), self.tr("From the known position to the click, on the ground"), "norm_m",
                     marks=True),
            residual("dX", self.tr("Part of the residual to the east"), "dx_m"),
            residual("dY", self.tr("Part of the residual to the north"), "dy_m"),
        )  # fmt: skip

    def name_of(self, row: int) -> str:
        """Return the point's name, or its number if it has none."""
        return self._points[row].name or str(row + 1)

    def _residual(self, row: int) -> PointResidual | None:
        # At no degrees of freedom every residual is 0 without meaning anything.
        fit = self._fit
        if fit is None or row >= len(fit.points) or (fit.degrees_of_freedom == 0 and fit.points[row].used):
            return None
        return fit.points[row]

    def _change(self, row: int, **values: Any) -> bool:

        point = replace(self._points[row], **values)
        return self.desk.session.apply(
            self.tr("Change control point"), lambda project: edits.change_control_point(project, row, point)
        )

    def _use(self, row: int, used: bool) -> bool:

        label = self.tr("Switch control point on") if used else self.tr("Switch control point off")
        return self.desk.session.apply(label, lambda project: edits.use_control_point(project, row, used=used))

    def _why_it_stands_out(self, row: int) -> str:
        worst = self._worst
        if worst is None or worst.kind != "point" or worst.row != row:
            return ""
        return self.tr("This point disagrees with the others.")

    def _say_worst(self) -> None:
        worst = self._worst
        if worst is None or worst.kind != "point":
            self.worst_box.say("")
            return
        length = self.desk.quantities.length
        text = self.tr("Point {name} disagrees with the others. Without it the RMS falls from {now} to {then}.")
        row, point = worst.row, self._points[worst.row]
        self.worst_box.say(
            text.format(name=self.name_of(row), now=length(worst.rms_m, 2), then=length(worst.rms_without_m, 2)),
            (
                (self.tr("Switch it off"), lambda: self._use(row, False)),
                (self.tr("Show it"), lambda: self._show(row, point)),
            ),
        )

    def _show(self, row: int, point: ControlPoint) -> None:
        self.desk.selection.control_point = row
        self.panel.place_wanted.emit(point.x_px, point.y_px)

    def _on_row_selected(self) -> None:
        rows = self.table.selectionModel().selectedRows()
        self.desk.selection.control_point = rows[0].row() if rows else None
        self.remove_button.setEnabled(self._actions.can_remove())

    def _select_row(self) -> None:
        row = self.desk.selection.control_point
        model = self.table.selectionModel()
        flags = QItemSelectionModel.SelectionFlag
        shown = [index.row() for index in model.selectedRows()]
        if row is None or not 0 <= row < self.model.rowCount():
            if shown:
                with QSignalBlocker(model):
                    model.clearSelection()
                self.table.viewport().update()
        elif shown != [row]:
            model.setCurrentIndex(self.model.index(row, 1), flags.ClearAndSelect | flags.Rows)
            self.table.scrollTo(self.model.index(row, 1))
        self.remove_button.setEnabled(self._actions.can_remove())

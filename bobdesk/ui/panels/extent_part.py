"""Start, finish and cut as distances along the digitised line."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker
from PySide6.QtWidgets import QCheckBox

from bobdesk.project import derive, edits
from bobdesk.project.project import Project
from bobdesk.ui.session import Edit
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.spin import Spin


class ExtentPart(Part):
    """Three spin boxes in the user's unit of length; in pixels while there is no scale."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Start and finish, along the digitised line"))
        self._shown_per_unit = 1.0
        self._whole = 0.0
        form = panel.add_form(self.column)
        self.start = self._spin(self.tr("Start"))
        panel.add_field(form, self.tr("Start"), self.start, self.tr("Where the track begins on the line"))
        self.start.valueChanged.connect(self._on_start)
        self.finish = self._spin(self.tr("Finish"))
        panel.add_field(
            form, self.tr("Finish"), self.finish, self.tr("Where the track ends on the line; its end if not set")
        )
        self.finish.valueChanged.connect(self._on_finish)
        self.is_cut = QCheckBox(self.tr("Cut off the final climb"), self)
        self.is_cut.setToolTip(self.tr("Let the track end at its lowest point, where the run-out begins to climb"))
        self.is_cut.clicked.connect(self._on_is_cut)
        form.addRow(self.is_cut)
        self.cut = self._spin(self.tr("Cut at"))
        panel.add_field(form, self.tr("Cut at"), self.cut, self.tr("Where the line is cut off"))
        self.cut.valueChanged.connect(self._on_cut)
        self._form = form
        flow = panel.add_buttons(self.column)
        flags = panel.button(
            flow, self.tr("Set in the plan"), self.tr("Click start, finish or cut on the line"), "flags"
        )
        flags.clicked.connect(lambda: panel.tool_wanted.emit("flags"))

    def refresh(self, project: Project) -> None:
        """Show start, finish and cut of a project."""
        whole = derive.digitised_length(project)
        self.setVisible(whole is not None)
        if whole is None:
            return
        self._whole = whole
        self._shown_per_unit, unit = self._units(project)
        extent = project.extent
        most = whole * self._shown_per_unit
        for spin in (self.start, self.finish, self.cut):
            spin.show_unit(unit)
            spin.show_range(0.0, most)
        self.start.show_value(extent.start * self._shown_per_unit)
        self.finish.show_value(most if extent.finish is None else extent.finish * self._shown_per_unit)
        self.cut.show_value(most if extent.cut_off is None else extent.cut_off * self._shown_per_unit)
        with QSignalBlocker(self.is_cut):
            self.is_cut.setChecked(extent.cut_off is not None)
        self._form.setRowVisible(self.cut, extent.cut_off is not None)

    def _spin(self, name: str) -> Spin:
        spin = Spin(name, self)
        spin.setDecimals(1)
        spin.setSingleStep(1.0)
        return spin

    def _units(self, project: Project) -> tuple[float, str]:
        """Return shown units per unit of the digitised line, and the sign of the unit."""
        quantities = self.desk.quantities
        if project.source is not None:
            return quantities.length_factor, quantities.length_unit
        found = derive.calibration(project).value
        if found is None or not found.scale_known:
            return 1.0, self.tr("px")
        return quantities.length_factor * found.metres_per_pixel, quantities.length_unit

    def _at(self, spin: Spin) -> float:
        """Return the distance along the line that a spin box shows, in the line's own unit."""
        if spin.value() >= spin.maximum():
            return self._whole
        return min(self._whole, spin.value() / self._shown_per_unit)

    def _on_start(self) -> None:
        at = self._at(self.start)
        self._apply(self.tr("Set start"), lambda project: edits.set_start(project, at), "start")

    def _on_finish(self) -> None:
        at = self._at(self.finish)
        finish = None if at >= self._whole else at
        self._apply(self.tr("Set finish"), lambda project: edits.set_finish(project, finish), "finish")

    def _on_cut(self) -> None:
        at = self._at(self.cut)
        self._apply(self.tr("Cut off the final climb"), lambda project: edits.cut_final_climb(project, at), "cut")

    def _on_is_cut(self, checked: bool) -> None:
        if checked:
            extent = self.desk.session.project.extent
            at = self._whole if extent.end is None else extent.end
            self._apply(self.tr("Cut off the final climb"), lambda project: edits.cut_final_climb(project, at), "cut")
        else:
            self._apply(self.tr("Keep the final climb"), edits.keep_final_climb, None)

    def _apply(self, label: str, edit: Edit, key: str | None) -> None:
        if not self.desk.session.apply(label, edit, key=key):
            self.refresh(self.desk.session.project)

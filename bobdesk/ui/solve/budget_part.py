"""The error budget: what each source of error is worth, in a table and a sentence."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QSignalBlocker
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QCheckBox

from bobdesk.errors import InputError
from bobdesk.files.atomic import write_atomic
from bobdesk.project.project import Project
from bobdesk.ui.questions import Questions
from bobdesk.ui.solve.open_data import open_data_of
from bobdesk.ui.solve.report_open_data import source_named
from bobdesk.ui.solve.target_field import TargetField
from bobdesk.ui.widgets.columns_model import Column, ColumnsModel
from bobdesk.ui.widgets.fold import Fold
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.table import Table

if TYPE_CHECKING:
    from bobdesk.track.error_budget import Share


class BudgetPart(Part):
    """Worked out in the background once it is unfolded, or the error band is shown."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Error budget"))
        self.heading.hide()
        self._open = open_data_of(self.desk)
        self._shares: tuple[Share, ...] = ()
        self._questions = Questions(self.desk.settings, self)
        self.fold = Fold(self.tr("How far may the real track lie from this?"), self)
        self.fold.toggled.connect(self._open.want_budget)
        self.column.addWidget(self.fold)
        inside = self.fold.column
        form = panel.add_form(inside)
        self.plan_error = TargetField(self.tr("Error of the plan's scale"), panel.refuse, self)
        self.plan_error.setPlaceholderText(self.tr("as calibrated"))
        panel.add_field(
            form, self.tr("Scale error (1σ)") + ", %", self.plan_error,
            self.tr("How far the scale of the plan may be wrong; leave it empty for what the calibration says, and"
                    " give it where coordinates or a scale by number say nothing of it"),
        )  # fmt: skip
        self.model = ColumnsModel(self._columns(), lambda: len(self._shares), panel.refuse, parent=self)
        self.table = Table(self.tr("Error budget"), self.model, fewest_rows=3, most_rows=8, parent=self)
        self.table.setSelectionMode(Table.SelectionMode.NoSelection)
        self.table.fit_columns(("rounding, length", "± 8.88", "± 0.888", "± 8.88", "± 8.88"))
        inside.addWidget(self.table)
        self.sentence = panel.add_label("", "", inside)
        self.in_strips = QCheckBox(self.tr("Show the band in the strips"), self)
        self.in_strips.setAccessibleName(self.in_strips.text())
        self.in_strips.setToolTip(self.tr("Where the real track lies with 95 %, by station"))
        inside.addWidget(self.in_strips)
        flow = panel.add_buttons(inside)
        self.copy_button = panel.button(
            flow, self.tr("Copy table"), self.tr("Copy the table with tabs, in metres"), "copy"
        )
        self.save_button = panel.button(
            flow, self.tr("Save table…"), self.tr("Write the table as CSV, as the command does"), "save-as"
        )
        self.band_button = panel.button(
            flow,
            self.tr("Save band…"),
            self.tr("Write elevation and gradient with their errors by station as CSV, as the command does"),
            "save-as",
        )
        self.plan_error.entered.connect(self._on_plan_error)
        self.in_strips.toggled.connect(lambda on: self._open.show("error_band", on))
        self.copy_button.clicked.connect(self.copy)
        self.save_button.clicked.connect(lambda: self._save("budget"))
        self.band_button.clicked.connect(lambda: self._save("band"))
        self._open.changed.connect(self._show)
        self.desk.quantities.changed.connect(self._on_units)
        self._show()

    def refresh(self, project: Project) -> None:
        """Show the settings of a project."""
        share = project.plan_error
        self.plan_error.show_value(None if share is None else 100 * share)

    def content(self, kind: str) -> bytes | None:
        """Return the file that the command writes: "budget" or "band"."""
        from bobdesk.files.exporters.study_tables import budget_table, error_band_table

        found = self._open.budget
        if found is None or not self._open.is_current("budget"):
            return None
        return budget_table(found) if kind == "budget" else error_band_table(found)

    def copy(self) -> None:
        """Copy the table with tabs."""
        from bobdesk.files.exporters.study_tables import budget_table

        found = self._open.budget
        if found is not None:
            QGuiApplication.clipboard().setText(budget_table(found, flavour="tab").decode())
            self.desk.notices.note(self.tr("The table is on the clipboard."))

    def save(self, kind: str, path: Path) -> None:
        """Write one of both files."""
        content = self.content(kind)
        if content is None:
            return
        try:
            write_atomic(path, content)
        except InputError as error:
            self.desk.notices.error(str(error))
            return
        self.desk.notices.note(self.tr("Written to {name}.").format(name=path.name))

    def _save(self, kind: str) -> None:
        track = self.desk.session.project.name or self.tr("track")
        name = track + (self.tr("-error-budget") if kind == "budget" else self.tr("-error-band")) + ".csv"
        path = self._questions.file_to_save("export", self.tr("Error budget"), name, "CSV (*.csv)", ".csv")
        if path is not None:
            self.save(kind, path)

    def _columns(self) -> tuple[Column, ...]:
        unit = self.desk.quantities

        def metres(value: float, digits: int) -> str:
            return "–" if value == 0 else "± " + unit.length(value, digits, unit=False)

        def ratio(value: float) -> str:
            return "–" if value == 0 else "± " + unit.number(100 * value, 2 if 100 * value >= 0.1 else 3)

        return (
            Column(
                lambda: self.tr("Source"),
                self.tr("What the error comes from"),
                lambda row: source_named(self._shares[row].source),
                is_number=False,
            ),
            Column(
                lambda: self.tr("Plan") + f", {unit.length_unit}",
                self.tr("Length of the plan, 95 %"),
                lambda row: metres(self._shares[row].plan_length, 2),
            ),
            Column(
                lambda: self.tr("f, %"),
                self.tr("Scale of the plan, 95 %"),
                lambda row: ratio(self._shares[row].scale),
            ),
            Column(
                lambda: "z" + f", {unit.length_unit}",
                self.tr("Elevation, 95 %, root mean square along the line"),
                lambda row: metres(self._shares[row].elevation, 2),
            ),
            Column(
                lambda: self.tr("Grad., %"),
                self.tr("Gradient, 95 %, root mean square along the line"),
                lambda row: (
                    "–" if self._shares[row].gradient == 0 else "± " + unit.number(100 * self._shares[row].gradient, 2)
                ),
            ),
        )

    def _on_units(self) -> None:
        self.model.refresh_headings()
        self._show()

    def _show(self) -> None:
        found, current = self._open.budget, self._open.is_current("budget")
        self._shares = () if found is None else found.shares
        self.model.refresh()
        self.table.setVisible(found is not None)
        with QSignalBlocker(self.in_strips):
            self.in_strips.setChecked(self._open.is_shown("error_band"))
        for button in (self.copy_button, self.save_button, self.band_button):
            button.setEnabled(found is not None and current)
        if not current:
            text = self.tr("Working it out …")
        elif found is not None:
            text = found.sentence
        else:
            text = (self._open.problem("budget") or self.tr("A centreline comes first")).rstrip(".") + "."
        self.sentence.setText(text[:1].upper() + text[1:])

    def _on_plan_error(self, shown: float | None) -> None:
        from bobdesk.project import edits

        share = None if shown is None else shown / 100
        if not self.desk.session.apply(
            self.tr("Error of the plan's scale"), lambda project: edits.set_plan_error(project, share), key="plan error"
        ):
            self.plan_error.setModified(False)
            self.refresh(self.desk.session.project)

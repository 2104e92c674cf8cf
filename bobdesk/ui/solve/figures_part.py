"""The figures of the shown run beside its targets and the actual track."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication

from bobdesk.project.project import Project
from bobdesk.ui.derived import DerivedLater
from bobdesk.ui.solve.run_figures import actual_figures, mean_of, percent_text
from bobdesk.ui.widgets.columns_model import Column, ColumnsModel
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.table import Table

if TYPE_CHECKING:
    from bobdesk.track.comparison import Comparison


@dataclass(frozen=True)
class _Row:
    name: str
    run: str
    target: str = "–"
    actual: str = "–"
    deviation: str = ""


def _compared(project: Project) -> Comparison | None:
    from bobdesk.project.derive_runs import run_comparison

    return None if project.run is None else run_comparison(project, project.run)


def _inputs(project: Project) -> tuple[object, ...] | None:
    return None if project.run is None or project.actual is None else (project.run.layout, project.actual)


class FiguresPart(Part):
    """Figure, result, target, actual, and the deviation in percent: of the actual track, else of the target."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Result"))
        self._rows: tuple[_Row, ...] = ()
        self._later = DerivedLater(self.desk, self.tr("Comparing with the actual track"), _compared, _inputs, self)
        self.model = ColumnsModel(self._columns(), lambda: len(self._rows), panel.refuse, parent=self)
        self.table = Table(self.tr("Figures of the result"), self.model, fewest_rows=4, most_rows=10, parent=self)
        self.table.setSelectionMode(Table.SelectionMode.NoSelection)
        self.table.fit_columns(("Min. gradient, %", "8,888.8", "≥ −88.88", "8,888.8", "−88.888 %"))
        self.column.addWidget(self.table)
        self.note = panel.add_label("", "muted", self.column)
        flow = panel.add_buttons(self.column)
        self.copy_button = panel.button(
            flow, self.tr("Copy table"), self.tr("Copy the table with tabs, for a spreadsheet"), "copy"
        )
        self.copy_button.clicked.connect(self.copy)
        self._later.changed.connect(lambda: self.refresh(self.desk.session.project))
        self.desk.quantities.changed.connect(lambda: self.refresh(self.desk.session.project))

    def refresh(self, project: Project) -> None:
        """Show the figures of the chosen run."""
        run = project.run
        self.setVisible(run is not None)
        if run is None:
            return
        against = self.tr("against the actual track") if project.actual is not None else self.tr("against its targets")
        self.name_it(self.tr("Result: {name} {against}").format(name=run.name, against=against))
        self._rows = tuple(self._figures(project))
        self.model.refresh()
        definition = {
            "drop-per-length": self.tr("Mean gradient: height difference divided by the length in space."),
            "drop-per-plan": self.tr("Mean gradient: height difference divided by the length in plan."),
            "segments": self.tr("Mean gradient: mean of the gradients of all segments."),
        }
        note = definition[run.inputs.targets.mean_gradient_is]
        if project.actual is not None:
            note += " " + self.tr("z RMS: in percent of the actual height difference.")
        self.note.setText(note)

    def copy(self) -> None:
        """Copy the table as it is shown, with tabs."""
        columns = range(self.model.columnCount())
        head = [str(self.model.headerData(column, Qt.Orientation.Horizontal)) for column in columns]
        rows = [[row.name, row.run, row.target, row.actual, row.deviation] for row in self._rows]
        QGuiApplication.clipboard().setText("\n".join("\t".join(row) for row in [head, *rows]) + "\n")
        self.desk.notices.note(self.tr("The table is on the clipboard."))

    def _columns(self) -> tuple[Column, ...]:
        return (
            Column(lambda: "", self.tr("Figure"), lambda row: self._rows[row].name, is_number=False),
            Column(lambda: self.tr("Run"), self.tr("Of the shown run"), lambda row: self._rows[row].run),
            Column(lambda: self.tr("Target"), self.tr("What it was to meet"), lambda row: self._rows[row].target),
            Column(lambda: self.tr("Actual"), self.tr("Of the actual track"), lambda row: self._rows[row].actual),
            Column(
                lambda: self.tr("Off by"),
                self.tr("From the actual track, or from the target where there is none"),
                lambda row: self._rows[row].deviation,
            ),
        )

    def _figures(self, project: Project) -> list[_Row]:
        run = project.run
        if run is None:
            return []
        unit, wanted, found = self.desk.quantities, run.inputs.targets, run.figures
        actual = None if project.actual is None else actual_figures(project.actual)
        named = wanted.mean_gradient_is
        length = unit.length

        def row(
            name: str, value: float, target: float | None, real: float | None, show: object, sign: str = ""
        ) -> _Row:
            base = real if real is not None else (target if not sign else None)
            apart = "" if not base else self._percent(100 * (value - base) / base)
            shown = "–" if target is None else f"{sign}{show(target)}"  # type: ignore[operator]
            return _Row(name, show(value), shown, "–" if real is None else show(real), apart)  # type: ignore[operator]

        def metres(value: float) -> str:
            return length(value, 2, unit=False)

        def gradient(value: float) -> str:
            return unit.gradient(value, unit=False)

        in_length, in_gradient = f", {unit.length_unit}", f", {unit.gradient_unit}"
        rows = [
            row(self.tr("Length") + in_length, found.length, wanted.length,
                None if actual is None else actual.length, metres),
            row(self.tr("Drop") + in_length, found.drop, wanted.drop, None if actual is None else actual.drop, metres),
            row(self.tr("Mean gradient") + in_gradient, mean_of(found, named), wanted.mean_gradient,
                None if actual is None else mean_of(actual, named), gradient),
            row(self.tr("Max. gradient") + in_gradient, found.max_gradient, wanted.max_gradient,
                None if actual is None else actual.max_gradient, gradient, "≤ "),
            row(self.tr("Min. gradient") + in_gradient, found.min_gradient, wanted.min_gradient,
                None if actual is None else actual.min_gradient, gradient, "≥ "),
            _Row(self.tr("Plan length") + in_length, metres(found.plan_length), "–",
                 "–" if actual is None else metres(actual.plan_length),
                 "" if actual is None else self._percent(100 * (found.plan_length / actual.plan_length - 1))),
            _Row(self.tr("|K2−K3|") + ", 1/m", self.desk.quantities.short(found.mean_curvature_difference, 2)),
        ]  # fmt: skip
        compared: Comparison | None = self._later.value
        if compared is not None and actual is not None:
            rows += [
                _Row(self.tr("z RMS") + in_length, metres(compared.z_rms), "–", "–",
                     self._percent(compared.z_rms_percent)),
                _Row(self.tr("z largest") + in_length, metres(compared.z_max), "–", "–",
                     self.tr("at {station}").format(station=length(compared.z_max_station, 0))),
                _Row(self.tr("Gradient RMS") + in_gradient, gradient(compared.gradient_rms)),
            ]  # fmt: skip
        return rows

    def _percent(self, value: float) -> str:
        return percent_text(self.desk.quantities, value)

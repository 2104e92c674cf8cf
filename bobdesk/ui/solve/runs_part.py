"""The list of runs in the paper's columns, beside targets and the actual track."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QItemSelectionModel, QSignalBlocker, Qt
from PySide6.QtGui import QGuiApplication

from bobdesk.project.project import Project
from bobdesk.project.runs import Run
from bobdesk.track.figures import Figures
from bobdesk.ui.icons import dot
from bobdesk.ui.shown_result import shown_result_of
from bobdesk.ui.solve.run_figures import actual_figures, mean_of
from bobdesk.ui.table_text import plain_number, table_text
from bobdesk.ui.widgets.columns_model import Column, ColumnsModel
from bobdesk.ui.widgets.headed_model import Index
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.table import Table

_NAME = 1


class RunsModel(ColumnsModel):
    """Columns with the run's colour as a dot before its name."""

    colour_of: Callable[[int], str] | None = None

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Return what a cell shows."""
        if role == Qt.ItemDataRole.DecorationRole and index.column() == _NAME and self.colour_of is not None:
            colour = self.colour_of(index.row())
            return dot(colour) if colour else None
        if role == Qt.ItemDataRole.CheckStateRole and self.colour_of is not None and not self.colour_of(index.row()):
            return None
        return super().data(index, role)


class RunsPart(Part):
    """Runs can be shown, overlaid, renamed and deleted; two rows at the end hold targets and the actual track."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Runs"))
        self.shown = shown_result_of(self.desk)
        self.model = RunsModel(
            self._columns(), self._count, panel.refuse, is_faint=lambda row: row >= len(self._runs), parent=self
        )
        self.model.colour_of = self._colour_of
        self.table = Table(self.tr("Runs"), self.model, fewest_rows=2, most_rows=8, parent=self)
        self.table.setObjectName("runs_table")
        self.table.setSelectionMode(Table.SelectionMode.SingleSelection)
        self._fit()
        self.column.addWidget(self.table)
        self.note = panel.add_label("", "muted", self.column)
        flow = panel.add_buttons(self.column)
        self.baseline_button = panel.button(
            flow, self.tr("Baseline"), self.tr("Show the differences of the others to the selected run"), "link"
        )
        self.baseline_button.setCheckable(True)
        self.copy_button = panel.button(
            flow, self.tr("Copy table"), self.tr("Copy the table with tabs, for a spreadsheet"), "copy"
        )
        self.delete_button = panel.button(
            flow, self.tr("Delete run"), self.tr("Take the selected run from the list"), "delete"
        )
        self.baseline_button.clicked.connect(self._on_baseline)
        self.copy_button.clicked.connect(self.copy)
        self.delete_button.clicked.connect(self._on_delete)
        self.table.selectionModel().selectionChanged.connect(self._on_row)
        self.model.modelReset.connect(self._select_row)
        self.shown.changed.connect(self._on_shown)
        self.desk.quantities.changed.connect(self._on_units)
        self._actual: Figures | None = None

    def refresh(self, project: Project) -> None:
        """Show the runs of a project."""
        self._actual = None if project.actual is None else actual_figures(project.actual)
        self.model.refresh()
        self._select_row()
        some = bool(project.runs)
        self.setVisible(some or project.actual is not None)
        self.copy_button.setEnabled(some)
        self._say()

    def copy(self) -> None:
        """Copy the table as it is shown, with tabs."""
        columns = range(_NAME, self.model.columnCount())
        head = [str(self.model.headerData(column, Qt.Orientation.Horizontal)) for column in columns]
        rows = [
            [self._name(row), *(plain_number(self._shown_text(row, column)) for column in columns[1:])]
            for row in range(self.model.rowCount())
        ]
        QGuiApplication.clipboard().setText(table_text([head, *rows]))
        self.desk.notices.note(self.tr("The table is on the clipboard."))

    def _shown_text(self, row: int, column: int) -> str:
        return str(self.model.data(self.model.index(row, column)) or "")

    @property
    def _runs(self) -> tuple[Run, ...]:
        return self.desk.session.project.runs

    def _count(self) -> int:
        project = self.desk.session.project
        return len(project.runs) + 1 + (project.actual is not None)

    def _figures(self, row: int) -> Figures | None:
        return self._runs[row].figures if row < len(self._runs) else None

    def _colour_of(self, row: int) -> str:
        return self.shown.colour_of(self._runs[row]) if row < len(self._runs) else ""

    def _columns(self) -> tuple[Column, ...]:
        unit = self.desk.quantities

        def figure(heading: Callable[[], str], tip: str, value: Callable[[Figures], float], show: Any) -> Column:
            return Column(heading, tip, lambda row: self._text(row, value, show))

        return (
            Column(
                lambda: "",
                self.tr("Draw this run beside the shown one"),
                lambda _row: "",
                is_checked=lambda row: row < len(self._runs) and self.shown.is_overlaid(self._runs[row]),
                check=self._overlay,
                is_number=False,
            ),
            Column(
                lambda: self.tr("Run"),
                self.tr("Name of the run; click shows it, F2 renames it"),
                self._name,
                lambda row: self._runs[row].name if row < len(self._runs) else self._name(row),
                self._rename,
                is_number=False,
            ),
            figure(lambda: self.tr("Length") + " " + unit.length_unit, self.tr("Length in space"),
                   lambda of: of.length, lambda value: unit.length(value, 2, unit=False)),
            figure(lambda: self.tr("Drop") + " " + unit.length_unit, self.tr("Height difference"),
                   lambda of: of.drop, lambda value: unit.length(value, 2, unit=False)),
            figure(lambda: self.tr("Mean") + " " + unit.gradient_unit,
                   self.tr("Mean gradient, by the definition of the targets"), self._mean,
                   lambda value: unit.gradient(value, unit=False)),
            figure(lambda: self.tr("Max") + " " + unit.gradient_unit, self.tr("Largest gradient"),
                   lambda of: of.max_gradient, lambda value: unit.gradient(value, unit=False)),
            figure(lambda: self.tr("Min") + " " + unit.gradient_unit, self.tr("Smallest gradient"),
                   lambda of: of.min_gradient, lambda value: unit.gradient(value, unit=False)),
            figure(lambda: "|K2−K3| 1/m", self.tr("Mean difference between curvature in plan and in space"),
                   lambda of: of.mean_curvature_difference, unit.short),
            Column(lambda: "f", self.tr("Factor from the plan to true size"),
                   lambda row: unit.number(self._runs[row].scale * self._runs[row].inputs.factor, 5)
                   if row < len(self._runs) else ""),
            Column(lambda: self.tr("Iterations"), self.tr("How many iterations it took"),
                   lambda row: unit.number(self._runs[row].nit, 0) if row < len(self._runs) else ""),
            Column(lambda: self.tr("Time s"), self.tr("How long it took"),
                   lambda row: unit.number(self._runs[row].seconds, 2) if row < len(self._runs) else ""),
            Column(lambda: self.tr("Method"), self.tr("How the gradients were found, and for which start house"),
                   lambda row: f"{self._runs[row].inputs.settings.method}, {self._runs[row].target_set}"
                   if row < len(self._runs) else "", is_number=False),
            Column(lambda: self.tr("End"), self.tr("Why the run ended"),
                   lambda row: unit.sentence(self._runs[row].message)
                   if row < len(self._runs) else "", is_number=False),
        )  # fmt: skip

    def _fit(self) -> None:
        self.table.fit_columns(
            ("☑☑", "● Actual track xx", "8,888.88", "888.88", "88.88", "−88.88", "−88.88", "0.000888", "8.88888",
             "88,888", "888.88", "published, Track", "x" * 60)
        )  # fmt: skip

    def _name(self, row: int) -> str:
        if row < len(self._runs):
            return self._runs[row].name
        return self.tr("Targets") if row == len(self._runs) else self.tr("Actual track")

    def _mean(self, figures: Figures) -> float:
        return mean_of(figures, self.desk.session.project.targets.mean_gradient_is)

    def _text(self, row: int, value: Callable[[Figures], float], show: Callable[[float], str]) -> str:
        found = self._figures(row)
        if found is None:
            return self._target_text(value, show) if row == len(self._runs) else self._actual_text(value, show)
        baseline = self.shown.baseline
        if baseline is None or baseline is self._runs[row]:
            return show(value(found))
        apart = value(found) - value(baseline.figures)
        text = show(apart)
        return text if text.startswith("−") or text.startswith("-") else f"+{text}"

    def _actual_text(self, value: Callable[[Figures], float], show: Callable[[float], str]) -> str:
        return "" if self._actual is None else show(value(self._actual))

    def _target_text(self, value: Callable[[Figures], float], show: Callable[[float], str]) -> str:
        project = self.desk.session.project
        wanted = project.targets
        # A figure of targets has a value only where there is a target.
        marks = Figures(1, 2, 0, 3, 3, 3, 4, 5, 0)
        which = value(marks)
        found = {
            1: wanted.length,
            2: wanted.drop,
            3: wanted.mean_gradient,
            4: project.limits.max_gradient,
            5: project.limits.min_gradient,
        }.get(int(which))
        if found is None:
            return ""
        sign = {4: "≤ ", 5: "≥ "}.get(int(which), "")
        return f"{sign}{show(found)}"

    def _overlay(self, row: int, on: bool) -> bool:
        if row >= len(self._runs):
            return False
        self.shown.overlay(self._runs[row], on)
        return True

    def _rename(self, row: int, name: str) -> bool:
        from bobdesk.project import edits

        if row >= len(self._runs):
            return False
        if not name.strip():
            self.panel.refuse(self.tr("A run needs a name."))
            return False
        return self.desk.session.apply(self.tr("Rename run"), lambda project: edits.name_run(project, row, name))

    def _on_row(self) -> None:
        from bobdesk.project import edits

        rows = self.table.selectionModel().selectedRows()
        row = rows[0].row() if rows else None
        is_run = row is not None and row < len(self._runs)
        self.delete_button.setEnabled(is_run)
        self.baseline_button.setEnabled(is_run)
        if is_run and row != self.desk.session.project.chosen_run:
            self.desk.session.apply(self.tr("Show another run"), lambda project: edits.choose_run(project, row))
        self._mark_baseline()

    def _select_row(self) -> None:
        row = self.desk.session.project.chosen_run
        model = self.table.selectionModel()
        flags = QItemSelectionModel.SelectionFlag
        if [index.row() for index in model.selectedRows()] != ([] if row is None else [row]):
            with QSignalBlocker(model):
                if row is None:
                    model.clearSelection()
                else:
                    model.setCurrentIndex(self.model.index(row, _NAME), flags.ClearAndSelect | flags.Rows)
                    self.table.scrollTo(self.model.index(row, 0))
            self.table.viewport().update()
        self.delete_button.setEnabled(row is not None)
        self.baseline_button.setEnabled(row is not None)
        self._mark_baseline()

    def _mark_baseline(self) -> None:
        baseline = self.shown.baseline
        with QSignalBlocker(self.baseline_button):
            self.baseline_button.setChecked(baseline is not None and baseline is self.desk.session.project.run)

    def _on_baseline(self, on: bool) -> None:
        self.shown.set_baseline(self.desk.session.project.run if on else None)

    def _on_delete(self) -> None:
        from bobdesk.project import edits

        row = self.desk.session.project.chosen_run
        if row is not None:
            self.desk.session.apply(self.tr("Delete run"), lambda project: edits.remove_run(project, row))

    def _on_shown(self) -> None:
        if not self.shown.is_live:
            self.model.refresh()
            self._mark_baseline()
            self._say()

    def _on_units(self) -> None:
        self.model.refresh_headings()
        self._fit()

    def _say(self) -> None:
        baseline = self.shown.baseline
        if baseline is None:
            self.note.hide()
            return
        self.note.setText(self.tr("Other rows: difference to {name}.").format(name=baseline.name))
        self.note.show()

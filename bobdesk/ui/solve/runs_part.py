"""The list of runs in the paper's columns, beside targets and the actual track."""

from __future__ import annotations

from PySide6.QtCore import QItemSelectionModel, QSignalBlocker, Qt
from PySide6.QtGui import QGuiApplication, QKeySequence

from bobdesk.project.project import Project
from bobdesk.project.runs import Run
from bobdesk.ui.shown_result import shown_result_of
from bobdesk.ui.solve.runs_model import NAME, RunsModel
from bobdesk.ui.table_text import table_text
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.table import Table


class RunsPart(Part):
    """Runs can be shown, overlaid, renamed and deleted; two rows at the end hold targets and the actual track."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Runs"))
        self.shown = shown_result_of(self.desk)
        self.model = RunsModel(
            self.desk, self.shown, panel.refuse, overlay=self._overlay, rename=self._rename, parent=self
        )
        self.table = Table(self.tr("Runs"), self.model, fewest_rows=2, most_rows=8, parent=self)
        self.table.setObjectName("runs_table")
        self.table.setSelectionMode(Table.SelectionMode.SingleSelection)
        self._has_baseline = False
        self._fit()
        self.column.addWidget(self.table)
        self.off = panel.add_label("", "", self.column)
        self.off.setAccessibleName(self.tr("How far the shown run is off its targets"))
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
            flow, self.tr("Delete run"), self.tr("Take the selected run from the list (Del)"), "delete"
        )
        self.baseline_button.clicked.connect(self._on_baseline)
        self.copy_button.clicked.connect(self.copy)
        self.delete_button.clicked.connect(self._on_delete)
        self.table.on_key(Qt.Key.Key_Delete, self.delete_button)
        self.table.on_key(QKeySequence.StandardKey.Copy, self.copy_button)
        self.table.selectionModel().selectionChanged.connect(self._on_row)
        self.model.modelReset.connect(self._select_row)
        self.shown.changed.connect(self._on_shown)
        self.desk.quantities.changed.connect(self._on_units)

    def refresh(self, project: Project) -> None:
        """Show the runs of a project."""
        self.model.refresh()
        self._select_row()
        some = bool(project.runs)
        self.setVisible(some or project.actual is not None)
        self.copy_button.setEnabled(some)
        self._say()

    def copy(self) -> None:
        """Copy the table as it is shown, with tabs."""
        QGuiApplication.clipboard().setText(table_text(self.model.as_texts()))
        self.desk.notices.note(self.tr("The table is on the clipboard."))

    @property
    def _runs(self) -> tuple[Run, ...]:
        return self.desk.session.project.runs

    def _fit(self) -> None:
        self.table.fit_columns(
            ("☑☑", "● Actual track xx", "8,888.88", "888.88", "88.88", "−88.88", "−88.88", "0.000888", "8.88888",
             "88,888", "888.88", "published, Track", "x" * 60)
        )  # fmt: skip

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
                    model.setCurrentIndex(self.model.index(row, NAME), flags.ClearAndSelect | flags.Rows)
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
        self._say()

    def _say(self) -> None:
        run, baseline = self.desk.session.project.run, self.shown.baseline
        if self._has_baseline is not (baseline is not None):
            self._has_baseline = baseline is not None
            self.model.refresh_headings()
            self._fit()
        self.off.setVisible(run is not None)
        self.note.setVisible(baseline is not None)
        if run is not None:
            self.off.setText(self.model.off_targets(run))
        if baseline is not None:
            self.note.setText(
                self.tr("Δ: all rows but that of {name} show their differences to it.").format(name=baseline.name)
            )

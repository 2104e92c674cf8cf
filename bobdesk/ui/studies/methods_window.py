"""Compare methods: all of them on the open project's problem, side by side."""

from __future__ import annotations

import time
from collections.abc import Generator
from dataclasses import replace
from typing import Any

import numpy as np
from PySide6.QtCore import QSignalBlocker, QSize, Qt
from PySide6.QtGui import QPixmap
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QSplitter, QVBoxLayout, QWidget

from bobdesk.files.method_run import MethodResult, MethodsProgress, run_methods, run_of
from bobdesk.files.processes import process_executor
from bobdesk.progress import Progress
from bobdesk.project.project import Project
from bobdesk.project.runs import InputsDigest, RunInputs
from bobdesk.ui.desk import Desk
from bobdesk.ui.icons import dot
from bobdesk.ui.plots.chart import Chart, Series, colour_of_number
from bobdesk.ui.plots.chart_view import ChartView
from bobdesk.ui.studies.beside_window import BesideWindow
from bobdesk.ui.studies.icon_button import IconButton
from bobdesk.ui.studies.method_titles import method_titles
from bobdesk.ui.studies.methods_columns import methods_columns
from bobdesk.ui.studies.methods_note import methods_note
from bobdesk.ui.studies.rows_table import RowsModel, RowsTable
from bobdesk.ui.studies.saving import save_file
from bobdesk.ui.studies.wrapping_row import wrapping_row

_FIRST_SIZE = QSize(1000, 720)
# A comparison is of one problem: the settings of two kinds of methods are looked at.
_KINDS = ("pgd", "published")


def _compared(project: Project, titles: dict[str, str]) -> Generator[Progress, None, Any]:
    from bobdesk.project import derive

    yield Progress(0.0, "methods")
    inputs = derive.run_inputs(project).needed()
    with process_executor(1) as executor:
        return (yield from run_methods(inputs, executor, titles=tuple(titles.items())))


class MethodsWindow(BesideWindow):
    """Runs the methods in a process of their own; the table grows row by row, and a row can become a run."""

    def __init__(self, desk: Desk) -> None:
        super().__init__("methods_window", "", _FIRST_SIZE, desk)
        self.setWindowTitle(self.tr("Compare methods"))
        self.setAccessibleName(self.windowTitle())
        self.titles = method_titles()
        self.results: tuple[MethodResult, ...] = ()
        self._inputs: RunInputs | None = None
        self._project: Project | None = None
        self._at_work, self._since = "", 0.0
        self._make_parts()
        self._lay_out()
        self._connect()
        self._show_state()

    def question_before_stopping(self) -> tuple[str, str]:
        """Return what is asked before the comparison is ended."""
        return self.tr("The methods are still being compared. Stop?"), self.tr("The rows that are finished stay.")

    def compare(self) -> None:
        """Run all methods on the project as it is now."""
        if self.job is not None:
            return
        project = self.desk.session.project
        self.titles = method_titles()
        titles = dict(self.titles)
        self._project, self._inputs = project, None
        self._show_results(())
        self.job = self.desk.runner.start(
            self.tr("Comparing methods"),
            lambda: _compared(project, titles),
            done=self._on_done,
            failed=self.desk.notices.error,
            stopped=self._on_stopped,
            progressed=self._on_progress,
        )
        self.job.ended.connect(self._on_ended)
        self._at_work, self._since = "", time.monotonic()
        self.bar.show_progress(0.0)
        self._show_state()

    def take_over(self) -> None:
        """Make the selected row a run of the project."""
        from bobdesk.project import edits
        from bobdesk.project.digest import inputs_digest

        result, project, inputs = self.table.chosen, self._project, self._inputs
        if result is None or project is None or inputs is None or result.row.solution is None:
            return
        now = self.desk.session.project
        title = self.titles.get(result.row.method, result.row.title)
        names = {run.name for run in now.runs}
        name, number = title, 2
        while name in names:
            name, number = f"{title} {number}", number + 1
        solved = replace(project, solver=replace(project.solver, method=result.row.method))
        run = run_of(result, inputs, digest=inputs_digest(solved), name=name, target_set=project.targets.name)
        label = self.tr("Take over {name}").format(name=name)
        if self.desk.session.apply(label, lambda project: edits.take_over_run(project, run)):
            self.desk.notices.note(self.tr("{name} is a run of the project now; Undo takes it back.").format(name=name))

    def copy(self) -> None:
        """Copy the table as it is shown."""
        self.table.copy()
        self.desk.notices.note(self.tr("The table is on the clipboard."))

    def save(self) -> None:
        """Write the table as the command does."""
        from bobdesk.files.exporters.study_tables import methods_table

        name = (self._project.name if self._project is not None else "") or self.tr("track")
        rows = [result.row for result in self.results]
        save_file(self, lambda: methods_table(rows), f"{name}-methods.csv", ".csv")

    def _make_parts(self) -> None:
        self.about = QLabel(self)
        self.about.setWordWrap(True)
        self.about.setTextFormat(Qt.TextFormat.PlainText)
        self.changed_note = QLabel(
            self.tr("! The project has changed since. Compare again to see it as it is now."), self
        )
        self.changed_note.setProperty("kind", "warning")
        self.changed_note.setWordWrap(True)
        self.model = RowsModel(
            methods_columns(self.desk.quantities, self._title_of),
            problem=lambda result: "" if result.row.found is not None else result.row.message,
            dot=self._dot,
            parent=self,
        )
        self.table = RowsTable(self.tr("Methods side by side"), self.model, self)
        self.table.setMinimumHeight(150)
        self.table.fit_columns()
        self.note = QLabel(self)
        self.note.setProperty("kind", "muted")
        self.note.setTextFormat(Qt.TextFormat.PlainText)
        self.note.setWordWrap(True)
        self.note.hide()
        self.shown = QComboBox(self)
        for text, key in (
            (self.tr("Elevation by station"), "elevation"),
            (self.tr("Gradient by station"), "gradient"),
            (self.tr("Elevation less that of the selected method"), "difference"),
        ):
            self.shown.addItem(text, key)
        self.shown.setAccessibleName(self.tr("What is drawn"))
        self.shown.setToolTip(self.tr("What is drawn of the methods, one colour each"))
        self.chart = ChartView(self.tr("Profiles of the methods"), self)
        self.copy_button = IconButton(
            self.tr("Copy table"), self.tr("Copy the table with tabs, for a spreadsheet"), "copy", self
        )
        self.save_button = IconButton(
            self.tr("Save CSV…"), self.tr("Write the table as the command line does"), "export", self
        )
        self.take_button = IconButton(
            self.tr("Take over as run"),
            self.tr(
                "Add the selected row to the project's runs, and make its method the project's; Undo takes it back"
            ),
            "check",
            self,
        )

    def _lay_out(self) -> None:
        above = QWidget(self)
        column = QVBoxLayout(above)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.table, 1)
        column.addWidget(self.note)
        column.addWidget(wrapping_row(above, (self.copy_button, self.save_button, self.take_button)))
        below = QWidget(self)
        column = QVBoxLayout(below)
        column.setContentsMargins(0, 0, 0, 0)
        row = QHBoxLayout()
        row.addWidget(self.shown)
        row.addStretch(1)
        column.addLayout(row)
        column.addWidget(self.chart, 1)
        self.splitter = QSplitter(Qt.Orientation.Vertical, self)
        self.splitter.addWidget(above)
        self.splitter.addWidget(below)
        self.splitter.setChildrenCollapsible(False)
        self.splitter.setSizes([300, 340])
        self.hint = QLabel(
            self.tr(
                "All methods solve the open project with its targets, limits and segments, one after the other."
                " Where they agree, the data say what the track is like; where they do not, the method does."
            ),
            self,
        )
        self.hint.setProperty("kind", "muted")
        self.hint.setWordWrap(True)
        self.hint.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.hint.setMargin(60)
        for widget in (self.about, self.changed_note):
            self.column.addWidget(widget)
        self.column.addWidget(self.hint, 1)
        self.column.addWidget(self.splitter, 1)
        self.column.addWidget(self.bar)

    def _connect(self) -> None:
        self.bar.main_button.clicked.connect(self.compare)
        self.copy_button.clicked.connect(self.copy)
        self.save_button.clicked.connect(self.save)
        self.take_button.clicked.connect(self.take_over)
        self.shown.activated.connect(self._draw)
        self.table.selectionModel().selectionChanged.connect(self._on_row)
        self.desk.session.changed.connect(self._show_state)
        self.desk.session.document_changed.connect(self._on_document)
        self.desk.session.state_changed.connect(self._show_state)
        self.desk.quantities.changed.connect(self._on_units)

    def _title_of(self, result: MethodResult) -> str:
        return self.titles.get(result.row.method, result.row.title)

    def _number_of(self, result: MethodResult) -> int:
        return list(self.titles).index(result.row.method)

    def _dot(self, result: MethodResult) -> QPixmap | None:
        return None if result.row.line is None else dot(colour_of_number(self._number_of(result)))

    def _on_progress(self, step: object) -> None:
        if not isinstance(step, MethodsProgress):
            return
        if step.inputs is not None:
            self._inputs = step.inputs
        if step.at_work != self._at_work:
            self._at_work, self._since = step.at_work, time.monotonic()
        if len(step.results) != len(self.results):
            self._show_results(step.results)
        self.bar.show_progress(step.fraction)
        self._show_state()

    def _on_done(self, results: Any) -> None:
        self._look_at_steps()
        self._show_results(results)

    def _on_stopped(self) -> None:
        self._look_at_steps()

    def _look_at_steps(self) -> None:
        """See what came since the last look: the job ends without telling of it."""
        for step in [] if self.job is None else self.job.drained():
            if isinstance(step, MethodsProgress):
                self._inputs = step.inputs or self._inputs
                if len(step.results) > len(self.results):
                    self._show_results(step.results)

    def _on_ended(self) -> None:
        self._look_at_steps()
        self.job = None
        self._show_state()

    def _on_document(self) -> None:
        self.stop()
        self._project, self._inputs = None, None
        self._show_results(())
        self._show_state()

    def _show_results(self, results: tuple[MethodResult, ...]) -> None:
        chosen = self.table.chosen
        self.results = results
        with QSignalBlocker(self.table.selectionModel()):
            self.model.show_rows(results)
            for number, result in enumerate(self.model.rows):
                if chosen is not None and result.row.method == chosen.row.method:
                    self.table.choose(number)
        self.table.fit_columns()
        self._show_note()
        self._on_row()

    def _show_note(self) -> None:
        text = methods_note(self.results, self.desk.quantities, self._title_of)
        self.note.setText(text)
        self.note.setVisible(bool(text))

    def _on_row(self) -> None:
        chosen = self.table.chosen
        self.take_button.setEnabled(chosen is not None and chosen.row.solution is not None)
        self._draw()

    def _on_units(self) -> None:
        self.model.refresh()
        self.table.fit_columns()
        self._show_note()
        self._draw()

    def _draw(self) -> None:
        drawn = [result for result in self.results if result.row.line is not None]
        kind = self.shown.currentData()
        unit = self.desk.quantities
        base = self.table.chosen
        if base is None or base.row.line is None:
            base = drawn[0] if drawn else None
        series = []
        for result in drawn:
            line = result.row.line
            assert line is not None
            if kind == "gradient":
                y = np.array([unit.shown_gradient(value) for value in line.gradients.tolist()])
                x = line.stations[: len(y)]
            else:
                x, y = line.stations, unit.length_factor * line.elevations
                if kind == "difference" and base is not None and base.row.line is not None:
                    other = base.row.line
                    y = y - unit.length_factor * np.interp(x, other.stations, other.elevations)
            series.append(Series(self._title_of(result), unit.length_factor * x, y, self._number_of(result)))
        y_label = (
            self.tr("gradient ({unit})").format(unit=unit.gradient_unit)
            if kind == "gradient"
            else self.tr("elevation ({unit})").format(unit=unit.length_unit)
        )
        if kind == "difference" and base is not None:
            y_label = self.tr("elevation less that of {name} ({unit})").format(
                name=self._title_of(base), unit=unit.length_unit
            )
        x_label = self.tr("station ({unit})").format(unit=unit.length_unit)
        self.chart.show_chart(Chart("", x_label, y_label, tuple(series)) if series else None)

    def _show_state(self) -> None:
        running, some = self.is_running, bool(self.results)
        is_open = self.desk.session.is_open
        self.hint.setVisible(not some and not running)
        self.splitter.setVisible(some or running)
        self.copy_button.setEnabled(some)
        self.save_button.setEnabled(some)
        self.changed_note.setVisible(some and not running and self._has_changed())
        self.about.setText(self._about())
        if running:
            self.bar.show_work(
                self.tr("Comparing …"), self.tr("The methods run one after the other"), "run", enabled=False
            )
            done, all_ = len(self.results), len(self.titles)
            text = self.tr("{done} of {all} methods").format(done=done, all=all_)
            if self._at_work:
                seconds = self.desk.quantities.number(time.monotonic() - self._since, 0)
                text += self.tr(", {name} since {seconds} s").format(name=self._at_work, seconds=seconds)
            self.bar.say(text)
            return
        self.bar.show_idle(
            self.tr("Compare"), self.tr("Have all methods solve the project as it is now"), enabled=is_open
        )
        missing = len(self.titles) - len(self.results)
        if not is_open:
            self.bar.say(self.tr("Open a project first."))
        elif some and missing:
            self.bar.say(self.tr("Stopped; methods that were not run: {count}.").format(count=missing))
        else:
            self.bar.say("")

    def _about(self) -> str:
        project = self._project if self.results or self.is_running else self.desk.session.project
        if project is None or not self.desk.session.is_open:
            return ""
        unit, wanted = self.desk.quantities, project.targets
        parts = [project.name, wanted.name]
        parts.append(self.tr("length {length}").format(length=unit.length(wanted.length)))
        parts.append(self.tr("drop {drop}").format(drop=unit.length(wanted.drop)))
        return ", ".join(part for part in parts if part)

    def _has_changed(self) -> bool:
        return self._project is not None and _digests(self._project) != _digests(self.desk.session.project)


def _digests(project: Project) -> tuple[InputsDigest, ...]:
    from bobdesk.project.digest import inputs_digest

    return tuple(inputs_digest(replace(project, solver=replace(project.solver, method=kind))) for kind in _KINDS)

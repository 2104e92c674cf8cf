"""Which plans are studied: the open project and files, with their targets."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from pathlib import Path
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHeaderView

from bobdesk.errors import InputError
from bobdesk.progress import Progress
from bobdesk.project.project import Project
from bobdesk.ui.questions import Questions
from bobdesk.ui.studies.plan_entries import PlanEntry, named, read_entry, with_values
from bobdesk.ui.studies.study_choice import PlanFile
from bobdesk.ui.widgets.columns_model import Column, ColumnsModel
from bobdesk.ui.widgets.long_names import shortened
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.table import Table
from bobdesk.ui.widgets.typed_number import number_to_edit, typed_number

_NAME = 1
Read = list["PlanEntry | str"]


def _reading(files: Sequence[PlanFile], project: Project) -> Generator[Progress, None, Read]:
    found: Read = []
    for number, file in enumerate(files):
        yield Progress(number / len(files), Path(file.path).name)
        try:
            found.append(read_entry(file, project))
        except InputError as error:
            found.append(str(error))
    return found


class PlansPart(Part):
    """Files are read in the background; one that cannot be used is told of and left out.

    Signals
    -------
    changed
        Other plans, or other targets.
    """

    changed = Signal()

    def __init__(self, panel: Panel, questions: Questions) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Plans"))
        self._questions = questions
        self.with_project = True
        self.entries: list[PlanEntry] = []
        self._waiting = 0
        self.model = ColumnsModel(self._columns(), self._count, panel.refuse, parent=self)
        self.table = Table(self.tr("Plans of the study"), self.model, fewest_rows=2, most_rows=6, parent=self)
        self.table.setSelectionMode(Table.SelectionMode.SingleSelection)
        self._fit()
        self.table.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.column.addWidget(self.table)
        flow = panel.add_buttons(self.column)
        self.add_button = panel.button(
            flow, self.tr("Add files…"), self.tr("Add plans from files: coordinates or projects"), "plus"
        )
        self.remove_button = panel.button(
            flow, self.tr("Remove"), self.tr("Take the selected file from the study (Del)"), "minus"
        )
        self.note = panel.add_label(
            self.tr("Files that are no projects need a length and a height difference; projects bring their own."),
            "muted",
            self.column,
        )
        self.add_button.clicked.connect(self.ask_for_files)
        self.remove_button.clicked.connect(self._on_remove)
        self.table.on_key(Qt.Key.Key_Delete, self.remove_button)
        self.table.selectionModel().selectionChanged.connect(self._on_row)
        # Told after every edit and every other document, too.
        self.desk.session.state_changed.connect(self._on_project)
        self.desk.quantities.changed.connect(self._on_units)
        self._on_row()

    @property
    def is_reading(self) -> bool:
        """Whether files are still being read."""
        return self._waiting > 0

    def used(self) -> list[tuple[str, PlanEntry | Project]]:
        """Return the plans of the study with their names."""
        found: list[PlanEntry | Project] = []
        session = self.desk.session
        if self._has_project and self.with_project:
            found.append(session.project)
        found += [entry for entry in self.entries if entry.used]
        return named(found, self._project_name)

    def ask_for_files(self) -> None:
        """Ask for files and add them."""
        from bobdesk.files.importers.formats import import_formats

        patterns = " ".join(f"*{suffix}" for known in import_formats().formats for suffix in known.extensions)
        filters = ";;".join([self.tr("Plans") + f" ({patterns})", self.tr("All files") + " (*)"])
        self.add_files(self._questions.files_to_open("coordinates", self.tr("Add plans"), filters))

    def add_files(self, paths: Sequence[Path]) -> None:
        """Add plans from files."""
        there = {entry.path for entry in self.entries}
        self.read([PlanFile(str(path)) for path in dict.fromkeys(paths) if path not in there])

    def read(self, files: Sequence[PlanFile], *, quietly: bool = False) -> None:
        """Read files in the background.

        Parameters
        ----------
        quietly
            Whether what cannot be read is not worth a sentence.
        """
        if not files:
            return
        project = self.desk.session.project
        self._waiting += 1

        def done(found: Any) -> None:
            for entry in found:
                if isinstance(entry, PlanEntry):
                    self.entries.append(entry)
                elif not quietly:
                    self.panel.refuse(entry)

        job = self.desk.runner.start(
            self.tr("Reading plans"), lambda: _reading(files, project), done=done, failed=self.panel.refuse
        )
        job.ended.connect(self._on_read)

    @property
    def _has_project(self) -> bool:
        project = self.desk.session.project
        return self.desk.session.is_open and (project.source is not None or project.trace is not None)

    @property
    def _project_name(self) -> str:
        path = self.desk.session.path
        return path.stem if path is not None else self.desk.session.project.name or self.tr("project")

    def _count(self) -> int:
        return len(self.entries) + self._has_project

    def _entry(self, row: int) -> PlanEntry | None:
        """Return the file in a row; None for the open project."""
        at = row - self._has_project
        return self.entries[at] if 0 <= at < len(self.entries) else None

    def _columns(self) -> tuple[Column, ...]:
        unit = self.desk.quantities

        def target(heading: Callable[[], str], tip: str, name: str) -> Column:
            def value(row: int) -> float | None:
                entry = self._entry(row)
                return getattr(self.desk.session.project.targets if entry is None else entry, name)  # type: ignore[no-any-return]

            def edit(row: int) -> str:
                found = value(row)
                return "" if found is None else number_to_edit(found * unit.length_factor)

            return Column(
                heading,
                tip,
                lambda row: unit.length(value(row), 2, unit=False),
                edit,
                lambda row, text: self._change(row, name, text),
            )

        return (
            Column(
                lambda: "",
                self.tr("Whether the plan is part of the study"),
                lambda _row: "",
                is_checked=self._is_used,
                check=self._use,
                is_number=False,
            ),
            Column(lambda: self.tr("Plan"), self.tr("Name in the rows of the study"), self._name_in, is_number=False),
            target(
                lambda: self.tr("Length") + " " + unit.length_unit,
                self.tr("3D length that every result must meet"),
                "length",
            ),
            target(
                lambda: self.tr("Drop") + " " + unit.length_unit,
                self.tr("Height difference that every result must meet"),
                "drop",
            ),
        )

    def _name_in(self, row: int) -> str:
        entry = self._entry(row)
        if entry is None:
            return self.tr("{name} (open)").format(name=shortened(self._project_name, 24))
        return shortened(entry.path.stem, 28)

    def _is_used(self, row: int) -> bool:
        entry = self._entry(row)
        return self.with_project if entry is None else entry.used

    def _use(self, row: int, on: bool) -> bool:
        entry = self._entry(row)
        if entry is None:
            self.with_project = on
        else:
            self.entries[self.entries.index(entry)] = with_values(entry, used=on)
        self._tell()
        return True

    def _change(self, row: int, name: str, text: str) -> bool:
        entry = self._entry(row)
        if entry is None or entry.is_project:
            self.panel.refuse(self.tr("A project brings its own targets; they are set in its Solve step."))
            return False
        value = typed_number(text) / self.desk.quantities.length_factor
        if value <= 0:
            self.panel.refuse(self.tr("Length and drop must be more than 0."))
            return False
        self.entries[self.entries.index(entry)] = with_values(entry, **{name: value})
        self._tell()
        return True

    def _on_remove(self) -> None:
        rows = self.table.selectionModel().selectedRows()
        entry = self._entry(rows[0].row()) if rows else None
        if entry is not None:
            self.entries.remove(entry)
            self._tell()

    def _on_row(self) -> None:
        rows = self.table.selectionModel().selectedRows()
        self.remove_button.setEnabled(bool(rows) and self._entry(rows[0].row()) is not None)

    def _on_read(self) -> None:
        self._waiting -= 1
        self._tell()

    def _on_project(self) -> None:
        self._tell()

    def _on_units(self) -> None:
        self.model.refresh_headings()
        self._fit()

    def _fit(self) -> None:
        self.table.fit_columns(("☑☑", "", "8,888.88", "888.88"))
        self.table.horizontalHeader().setSectionResizeMode(_NAME, QHeaderView.ResizeMode.Stretch)

    def _tell(self) -> None:
        self.model.refresh()
        self._on_row()
        self.changed.emit()

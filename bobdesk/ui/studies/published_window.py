"""The paper's tables beside what its method and ours make of the same targets."""

from __future__ import annotations

import json
from collections.abc import Generator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QStackedWidget, QWidget

from bobdesk.progress import Progress
from bobdesk.ui.desk import Desk
from bobdesk.ui.resources import resource
from bobdesk.ui.studies.beside_window import BesideWindow
from bobdesk.ui.studies.icon_button import IconButton
from bobdesk.ui.studies.rows_table import RowsModel, RowsTable
from bobdesk.ui.studies.saving import save_file
from bobdesk.ui.studies.wrapping_row import wrapping_row
from bobdesk.ui.widgets.long_names import shortened

if TYPE_CHECKING:
    from bobdesk.track.published_study import ComparedRow

_FIRST_SIZE = QSize(1180, 720)
_SETTING = "published_plans"
TRACKS = ("Whistler", "Cesana", "Nagano", "Pyeongchang")


def _remade(files: dict[str, Path]) -> Generator[Progress, None, tuple[ComparedRow, ...]]:
    from bobdesk.files.importers.formats import read_line
    from bobdesk.files.published_tables import plan_source, read_published
    from bobdesk.track.published_study import remake

    yield Progress(0.0, "plans")
    sources = {track: plan_source(read_line(path)) for track, path in files.items()}
    return (yield from remake(read_published(resource("published", "tables.json")), sources))


class PublishedWindow(BesideWindow):
    """One row for each of the paper's; real plans take the places of stand-ins."""

    def __init__(self, desk: Desk) -> None:
        super().__init__("published_window", "", _FIRST_SIZE, desk)
        from bobdesk.ui.studies.published_columns import problem_of, published_columns

        self.setWindowTitle(self.tr("Published tables"))
        self.setAccessibleName(self.windowTitle())
        self.files: dict[str, Path] = _remembered(desk.settings.text_of(_SETTING))
        self.rows: tuple[ComparedRow, ...] = ()
        self._total = len(self._paper())
        self._made_from: dict[str, Path] | None = None
        self._ended = ""
        self.about = QLabel(
            self.tr(
                "The paper: Chen et al., arXiv 2507.08393 v2. Its coordinates are not public. Stand-in plans take"
                " their place: made lines with the published number of segments, and the plan length that follows from"
                " the published length, height difference and slopes. A real plan of your own can take the place of"
                " each. Deviations are from the actual track, in percent."
            ),
            self,
        )
        self.about.setWordWrap(True)
        self.about.setTextFormat(Qt.TextFormat.PlainText)
        self.states: dict[str, QLabel] = {}
        self.own_buttons: dict[str, QPushButton] = {}
        self.back_buttons: dict[str, QPushButton] = {}
        self.model = RowsModel(published_columns(desk.quantities), problem=problem_of, parent=self)
        self.table = RowsTable(self.tr("Published tables"), self.model, self)
        self.hint = QLabel(self.tr("Press Solve: {count} rows, some seconds.").format(count=self._total), self)
        self.hint.setProperty("kind", "muted")
        self.hint.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.hint.setWordWrap(True)
        self.stack = QStackedWidget(self)
        self.stack.addWidget(self.hint)
        self.stack.addWidget(self.table)
        self.copy_button = IconButton(
            self.tr("Copy table"), self.tr("Copy the table with tabs, for a spreadsheet"), "copy", self
        )
        self.csv_button = IconButton(
            self.tr("Save CSV…"), self.tr("Write all figures as the command line does"), "export", self
        )
        self._lay_out()
        self.bar.main_button.clicked.connect(self.solve)
        self.copy_button.clicked.connect(self.copy)
        self.csv_button.clicked.connect(self.save)
        desk.quantities.changed.connect(self._on_units)
        self._show_state()

    def question_before_stopping(self) -> tuple[str, str]:
        """Return what is asked before the work is ended."""
        return self.tr("The tables are still being made. Stop?"), self.tr("The rows that are finished stay.")

    def solve(self) -> None:
        """Make all rows."""
        if self.job is not None:
            return
        files = dict(self.files)
        self._made_from, self._ended = files, ""
        self._show_rows(())
        self.stack.setCurrentWidget(self.table)
        self.job = self.desk.runner.start(
            self.tr("Published tables"),
            lambda: _remade(files),
            done=self._show_rows,
            failed=self.desk.notices.error,
            stopped=self._on_stopped,
            progressed=self._on_progress,
        )
        self.job.ended.connect(self._on_ended)
        self.bar.show_progress(0.0)
        self._show_state()

    def ask_for_plan(self, track: str) -> None:
        """Ask for the real plan of a track."""
        from bobdesk.files.importers.formats import import_formats

        patterns = " ".join(f"*{suffix}" for known in import_formats().formats for suffix in known.extensions)
        filters = ";;".join([self.tr("Plans") + f" ({patterns})", self.tr("All files") + " (*)"])
        path = self.questions.file_to_open("coordinates", self.tr("Plan of {track}").format(track=track), filters)
        if path is not None:
            self.use_plan(track, path)

    def use_plan(self, track: str, path: Path | None) -> None:
        """Have a file take the place of a track's stand-in; None takes the stand-in again."""
        if path is None:
            self.files.pop(track, None)
        else:
            self.files[track] = path
        self.desk.settings.set_text(_SETTING, json.dumps({name: str(each) for name, each in self.files.items()}))
        self._show_state()

    def copy(self) -> None:
        """Copy the table as it is shown."""
        self.table.copy()
        self.desk.notices.note(self.tr("The table is on the clipboard."))

    def save(self) -> None:
        """Write all figures."""
        from bobdesk.files.published_tables import published_table

        rows = self.rows
        save_file(self, lambda: published_table(rows), self.tr("published") + ".csv", ".csv")

    def _paper(self) -> tuple[Any, ...]:
        from bobdesk.files.published_tables import read_published

        return read_published(resource("published", "tables.json"))

    def _lay_out(self) -> None:
        groups = []
        for track in TRACKS:
            state = QLabel(self)
            state.setTextFormat(Qt.TextFormat.PlainText)
            own = IconButton(
                self.tr("Own plan…"),
                self.tr("Use your own plan for {track}: a file of coordinates in metres").format(track=track),
                "open",
                self,
            )
            own.setAccessibleName(self.tr("Own plan for {track}").format(track=track))
            back = IconButton(
                self.tr("Stand-in"), self.tr("Use the stand-in for {track} again").format(track=track), "undo", self
            )
            back.setAccessibleName(self.tr("Stand-in for {track}").format(track=track))
            own.clicked.connect(partial(self.ask_for_plan, track))
            back.clicked.connect(partial(self.use_plan, track, None))
            self.states[track], self.own_buttons[track], self.back_buttons[track] = state, own, back
            group = QWidget(self)
            row = QHBoxLayout(group)
            row.setContentsMargins(0, 0, 18, 0)
            for widget in (state, own, back):
                row.addWidget(widget)
            groups.append(group)
        self.changed_note = QLabel(
            self.tr("! Other plans are chosen than these rows were made from. Solve again."), self
        )
        self.changed_note.setProperty("kind", "warning")
        self.changed_note.setWordWrap(True)
        self.column.addWidget(self.about)
        self.column.addWidget(wrapping_row(self, groups))
        self.column.addWidget(self.changed_note)
        self.column.addWidget(self.stack, 1)
        self.column.addWidget(wrapping_row(self, (self.copy_button, self.csv_button)))
        self.column.addWidget(self.bar)

    def _on_progress(self, step: object) -> None:
        from bobdesk.track.published_study import RemakeProgress

        if isinstance(step, RemakeProgress):
            self.bar.show_progress(step.fraction)
            if len(step.rows) > len(self.rows):
                self._add_rows(step.rows)
        self._show_state()

    def _on_stopped(self) -> None:
        from bobdesk.track.published_study import RemakeProgress

        for step in [] if self.job is None else self.job.drained():
            if isinstance(step, RemakeProgress) and len(step.rows) > len(self.rows):
                self._add_rows(step.rows)
        self._ended = self.tr("Stopped with {done} of {all} rows.").format(done=len(self.rows), all=self._total)

    def _on_ended(self) -> None:
        self.job = None
        if not self.rows:
            self.stack.setCurrentWidget(self.hint)
        self._show_state()

    def _show_rows(self, rows: tuple[ComparedRow, ...]) -> None:
        self.rows = rows
        self.model.show_rows(rows)
        self.table.fit_columns()

    def _add_rows(self, rows: tuple[ComparedRow, ...]) -> None:
        first = not self.rows
        self.model.add_rows(rows[len(self.rows) :])
        self.rows = rows
        if first:
            self.table.fit_columns()

    def _on_units(self) -> None:
        self.model.refresh()
        self.table.fit_columns()

    def _show_state(self) -> None:
        running, some = self.is_running, bool(self.rows)
        for track in TRACKS:
            path = self.files.get(track)
            shown = self.tr("stand-in") if path is None else shortened(path.name, 28)
            self.states[track].setText(f"{track}: {shown}")
            self.states[track].setToolTip("" if path is None else str(path))
            self.own_buttons[track].setEnabled(not running)
            self.back_buttons[track].setEnabled(path is not None and not running)
        self.copy_button.setEnabled(some)
        self.csv_button.setEnabled(some and not running)
        self.changed_note.setVisible(some and not running and self._made_from != self.files)
        if running:
            self.bar.show_work(
                self.tr("Solving …"), self.tr("The rows are made one after the other"), "run", enabled=False
            )
            self.bar.say(self.tr("{done} of {all} rows").format(done=len(self.rows), all=self._total))
        else:
            self.bar.show_idle(self.tr("Solve"), self.tr("Make all rows with the plans that are chosen"))
            self.bar.say(self._ended)


def _remembered(text: str) -> dict[str, Path]:
    try:
        found = json.loads(text)
        return {track: Path(found[track]) for track in TRACKS if track in found}
    except (ValueError, TypeError):
        return {}

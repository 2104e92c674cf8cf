"""The study window: what is varied at the left, the rows at the right, the work below."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QDragEnterEvent, QDropEvent, QHideEvent
from PySide6.QtWidgets import QLabel, QSplitter, QVBoxLayout, QWidget

from bobdesk.errors import InputError
from bobdesk.files.study_journal import Row
from bobdesk.files.study_run import StudyProgress
from bobdesk.progress import Progress
from bobdesk.track.study_pivot import is_failed
from bobdesk.ui.desk import Desk
from bobdesk.ui.plans import local_paths
from bobdesk.ui.studies.beside_window import BesideWindow
from bobdesk.ui.studies.icon_button import IconButton
from bobdesk.ui.studies.saving import save_file
from bobdesk.ui.studies.study_choice import SETTING, from_text, to_text
from bobdesk.ui.studies.study_form import StudyForm
from bobdesk.ui.studies.study_job import StudyOrder, study_steps
from bobdesk.ui.studies.study_results import StudyResults
from bobdesk.ui.studies.wrapping_row import wrapping_row

_FIRST_SIZE = QSize(1180, 760)
_TAKE_EVERY_S = 0.1
# Of the window's time, what rows that keep coming may take.
_SHARE = 0.1


class StudyWindow(BesideWindow):
    """Solves in the background; closing it in mid-study asks, and loses no finished row.

    Parameters
    ----------
    folder
        Where the rows of studies are kept.
    """

    def __init__(self, desk: Desk, folder: Path) -> None:
        super().__init__("study_window", "", _FIRST_SIZE, desk)
        self.setWindowTitle(self.tr("Study"))
        self.setAccessibleName(self.windowTitle())
        self.setAcceptDrops(True)
        self._folder = folder
        self._rows: dict[int, Row] = {}
        self._progress: StudyProgress | None = None
        self._kept = 0
        self._ended = ""
        self._next_take = 0.0
        self.form = StudyForm(self.desk, self.questions, self)
        self.results = StudyResults(self.desk, self)
        self.summary = QLabel(self)
        self.summary.setWordWrap(True)
        self.summary.setTextFormat(Qt.TextFormat.PlainText)
        self.summary.setContentsMargins(14, 0, 0, 0)  # as the form above it
        self.summary.setAccessibleName(self.tr("How many solves that makes"))
        self.copy_button = IconButton(
            self.tr("Copy table"), self.tr("Copy the table with tabs, for a spreadsheet"), "copy", self
        )
        self.csv_button = IconButton(
            self.tr("Save CSV…"), self.tr("Write the rows as the command line does"), "export", self
        )
        self.png_button = IconButton(
            self.tr("Save PNG…"), self.tr("Write the heat map or the curves that are shown"), "picture", self
        )
        self.svg_button = IconButton(
            self.tr("Save SVG…"), self.tr("Write the heat map or the curves that are shown"), "picture", self
        )
        self.again_button = IconButton(
            self.tr("Solve all again"), self.tr("Solve all rows, whatever was solved before"), "reset", self
        )
        self._lay_out()
        self._connect()
        self.form.show_choice(from_text(desk.settings.text_of(SETTING)))
        self._show_state()

    def question_before_stopping(self) -> tuple[str, str]:
        """Return what is asked before a study is ended."""
        return (
            self.tr("The study is still being solved. Stop it?"),
            self.tr("Finished rows are kept: the same study goes on where it stopped."),
        )

    def solve(self, *, restart: bool = False) -> None:
        """Solve what is chosen, or go on with it."""
        if self.job is not None:
            return
        try:
            wanted = self.form.wanted()
        except InputError as error:
            self.desk.notices.warn(str(error))
            return
        order = StudyOrder(self.form.plans.used(), wanted, self.form.choice().workers, self._folder, restart)
        self._remember()
        self._rows, self._progress, self._kept, self._ended = {}, None, 0, ""
        self.results.begin()
        self.job = self.desk.runner.start(
            self.tr("Study"),
            lambda: study_steps(order),
            done=self._on_done,
            failed=self._on_failed,
            stopped=self._on_stopped,
            progressed=self._on_progress,
        )
        self.job.ended.connect(self._on_ended)
        self._show_state()

    def pause_or_resume(self) -> None:
        """Let the study rest, or go on."""
        if self.job is None:
            return
        if self.job.is_paused:
            self.job.resume()
        else:
            self.job.pause()
        self._show_state()

    def copy(self) -> None:
        """Copy the table as it is shown."""
        self.results.table.copy()
        self.desk.notices.note(self.tr("The table is on the clipboard."))

    def save_table(self) -> None:
        """Write the rows."""
        from bobdesk.files.exporters.study_tables import study_table

        rows = self.results.rows
        save_file(self, lambda: study_table(rows), self.tr("study") + ".csv", ".csv")

    def save_picture(self, suffix: str) -> None:
        """Write the picture that is shown."""
        save_file(self, lambda: self.results.picture(suffix), self.tr("study") + suffix, suffix)

    def hideEvent(self, event: QHideEvent) -> None:
        """Remember what was chosen."""
        self._remember()
        super().hideEvent(event)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Take files."""
        if local_paths(event.mimeData()):
            event.setDropAction(Qt.DropAction.CopyAction)
            event.accept()

    def dropEvent(self, event: QDropEvent) -> None:
        """Add the files that were dropped as plans."""
        event.setDropAction(Qt.DropAction.CopyAction)
        event.accept()
        self.form.plans.add_files(local_paths(event.mimeData()))

    def _lay_out(self) -> None:
        left = QWidget(self)
        column = QVBoxLayout(left)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(8)
        column.addWidget(self.form, 1)
        column.addWidget(self.summary)
        right = QWidget(self)
        column = QVBoxLayout(right)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.results, 1)
        buttons = (self.copy_button, self.csv_button, self.png_button, self.svg_button, self.again_button)
        column.addWidget(wrapping_row(right, buttons))
        splitter = QSplitter(Qt.Orientation.Horizontal, self)
        splitter.addWidget(left)
        splitter.addWidget(right)
        splitter.setChildrenCollapsible(False)
        splitter.setStretchFactor(1, 1)
        splitter.setSizes([370, 800])
        self.column.addWidget(splitter, 1)
        self.column.addWidget(self.bar)

    def _connect(self) -> None:
        self.form.changed.connect(self._show_state)
        self.results.page_changed.connect(self._show_state)
        self.bar.main_button.clicked.connect(self._on_main)
        self.copy_button.clicked.connect(self.copy)
        self.csv_button.clicked.connect(self.save_table)
        self.png_button.clicked.connect(lambda: self.save_picture(".png"))
        self.svg_button.clicked.connect(lambda: self.save_picture(".svg"))
        self.again_button.clicked.connect(lambda: self.solve(restart=True))

    def _on_main(self) -> None:
        if self.job is None:
            self.solve()
        else:
            self.pause_or_resume()

    def _remember(self) -> None:
        # Files that are still being read are no part of the choice yet.
        if not self.form.plans.is_reading:
            self.desk.settings.set_text(SETTING, to_text(self.form.choice()))

    def _on_progress(self, step: object) -> None:
        now = time.perf_counter()
        if now >= self._next_take:
            self._take_steps()
            took = time.perf_counter() - now
            self._next_take = now + max(_TAKE_EVERY_S, took / _SHARE)
        if isinstance(step, Progress):
            self.bar.show_progress(step.fraction if isinstance(step, StudyProgress) else None)
        self._show_state()

    def _take_steps(self) -> None:
        """Take all rows that came since the last look."""
        new: dict[int, Row] = {}
        for step in [] if self.job is None else self.job.drained():
            if isinstance(step, StudyProgress):
                if self._progress is None:
                    self._kept = step.solved
                self._progress = step
                new |= step.rows
        if new:
            self._rows |= new
            self.results.add_rows([new[number] for number in sorted(new)])

    def _on_done(self, rows: Any) -> None:
        self._take_steps()
        self._rows = dict(enumerate(rows))
        self.results.show_rows(rows)
        failed = sum(is_failed(row) for row in rows)
        number = self.desk.quantities.number
        all_there = self.tr("All {count} rows are there.").format(count=number(len(rows), 0))
        self._ended = self.tr("The row is there.") if len(rows) == 1 else all_there
        if failed:
            self._ended += " " + self.tr("Failed, with their reason: {count}.").format(count=number(failed, 0))
        if self._kept:
            self._ended += " " + self.tr("Solved before: {count}.").format(count=number(self._kept, 0))

    def _on_stopped(self) -> None:
        self._end_early(self.tr("Stopped with {done} of {all} rows. Solve goes on from there."))

    def _on_failed(self, sentence: str) -> None:
        self.desk.notices.error(sentence)
        self._end_early(self.tr("Ended with {done} of {all} rows. Solve goes on from there."))

    def _end_early(self, sentence: str) -> None:
        self._take_steps()
        self.results.show_rows([self._rows[number] for number in sorted(self._rows)])
        total = 0 if self._progress is None else self._progress.total
        number = self.desk.quantities.number
        self._ended = sentence.format(done=number(len(self._rows), 0), all=number(total, 0)) if total else ""

    def _on_ended(self) -> None:
        self.job = None
        self._show_state()

    def _show_state(self) -> None:
        running, some = self.is_running, bool(self.results.rows)
        sentence, can_solve = self.form.summary()
        self.summary.setText(sentence)
        self.form.setEnabled(not running)
        self.copy_button.setEnabled(some)
        self.csv_button.setEnabled(some)
        self.png_button.setEnabled(self.results.has_picture)
        self.svg_button.setEnabled(self.results.has_picture)
        self.again_button.setVisible(not running and self._kept > 0)
        if not running:
            tip = self.tr("Solve every combination that is chosen; rows that were solved before are kept")
            self.bar.show_idle(self.tr("Solve"), tip, enabled=can_solve)
            self.bar.say(self._ended)
        elif self.job is not None and self.job.is_paused:
            self.bar.show_work(self.tr("Go on"), self.tr("Solve the other rows"), "run")
            self.bar.say(self.tr("Paused. {how_far}").format(how_far=self._how_far()))
        else:
            self.bar.show_work(self.tr("Pause"), self.tr("Begin no other row; nothing is lost"), "pause")
            self.bar.say(self._how_far())

    def _how_far(self) -> str:
        step = self._progress
        if step is None:
            return self.tr("Fitting the plans and finding their segments …")
        number = self.desk.quantities.number
        text = self.tr("{done} of {all} rows").format(done=number(step.solved, 0), all=number(step.total, 0))
        if step.left is not None and not (self.job is not None and self.job.is_paused):
            text += ", " + self.tr("about {time} left").format(time=self._spoken(step.left))
        return text

    def _spoken(self, seconds: float) -> str:
        number = self.desk.quantities.number
        if seconds < 90:
            return self.tr("{count} s").format(count=number(seconds, 0))
        if seconds < 5400:
            return self.tr("{count} min").format(count=number(seconds / 60, 0))
        return self.tr("{count} h").format(count=number(seconds / 3600, 1))

"""Segments in and out: the table that the commands read and write, and designers' lists to compare with."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QFileDialog, QWidget

from bobdesk.alignment.segments import Segments
from bobdesk.errors import InputError
from bobdesk.files.atomic import write_atomic
from bobdesk.project.segment_edits import shortest_by_hand
from bobdesk.sentences import listed
from bobdesk.ui.desk import Desk
from bobdesk.ui.questions import Questions
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.segments.design import design_of
from bobdesk.ui.segments.operations import operations

_MOST_NAMED = 6


class SegmentFiles(QObject):
    """Asks for a file, and says what cannot be used."""

    def __init__(self, desk: Desk, window: QWidget) -> None:
        super().__init__(window)
        self._desk = desk
        self._window = window
        self._questions = Questions(desk.settings, window)

    def ask_open(self) -> None:
        """Ask for a table of segments, and take it."""
        path = self._asked_open(self.tr("Open segments"), self.tr("Tables (*.csv *.txt *.tsv);;All files (*)"))
        if path is not None:
            self.open(path)

    def open(self, path: Path) -> bool:
        """Take the segments of a table; return whether that worked."""
        from bobdesk.files.importers.segments_csv import read_segments

        now = alignment_now(self._desk)
        value = now.known
        if value is None:
            self._desk.notices.refuse(now.problem or self.tr("Segments lie on a line: trace or open one first."))
            return False
        try:
            found = read_segments(path, length=value.line.length)
        except InputError as error:
            self._desk.notices.error(str(error))
            return False
        if not operations(self._desk).take(found, self.tr("Open segments")):
            return False
        self._say_short(found, path.name)
        return True

    def _say_short(self, found: Segments, name: str) -> None:
        """Say which segments of a file were too short to stay."""
        shortest = shortest_by_hand(self._desk.session.project)
        short = [str(number) for number, one in enumerate(found, 1) if one.length < shortest]
        if not short:
            return
        shown = listed(short[:_MOST_NAMED]) if len(short) <= _MOST_NAMED else ", ".join([*short[:_MOST_NAMED], "…"])
        text = (
            self.tr(
                "{name}: segment {numbers} is shorter than {shortest}, the shortest allowed, and joined a neighbour."
            )
            if len(short) == 1
            else self.tr(
                "{name}: {count} segments ({numbers}) are shorter than {shortest}, the shortest allowed, and joined"
                " a neighbour."
            )
        )
        unit = self._desk.quantities
        self._desk.notices.warn(text.format(name=name, count=len(short), numbers=shown, shortest=unit.length(shortest)))

    def ask_save(self) -> None:
        """Ask where, and save the table of segments."""
        path = self._questions.file_to_save("export", self.tr("Save segments"), "segments", "*.csv", ".csv")
        if path is not None:
            self.save(path)

    def save(self, path: Path) -> bool:
        """Write the table of segments; return whether that worked."""
        from bobdesk.files.exporters.tables import segments_table

        value = alignment_now(self._desk).known
        if value is None:
            self._desk.notices.refuse(self.tr("There are no segments to save yet."))
            return False
        try:
            write_atomic(path, segments_table(value.line, value.segments))
        except InputError as error:
            self._desk.notices.error(str(error))
            return False
        self._desk.notices.note(self.tr("Saved as {name}").format(name=path.name))
        return True

    def ask_design(self) -> None:
        """Ask for a designer's list, and compare with it."""
        kinds = self.tr("Lists of curves (*.json *.csv *.txt);;All files (*)")
        path = self._asked_open(self.tr("Compare with a design"), kinds)
        if path is not None:
            design_of(self._desk).read(path)

    def _asked_open(self, title: str, kinds: str) -> Path | None:
        name, _ = QFileDialog.getOpenFileName(self._window, title, self._desk.settings.folder("open"), kinds)
        if not name:
            return None
        self._desk.settings.set_folder("open", Path(name).parent)
        return Path(name)

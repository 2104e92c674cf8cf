"""The import dialog: what a file of coordinates holds and how it is read, before anything is changed."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QAbstractItemView,
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QProgressBar,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from bobdesk.sentences import ended
from bobdesk.ui.banner import Banner
from bobdesk.ui.desk import Desk
from bobdesk.ui.dialogs.guide_in_dialog import offer_guide
from bobdesk.ui.dialogs.import_coordinates.line_view import LineView
from bobdesk.ui.dialogs.import_coordinates.table_choices import TableChoices
from bobdesk.ui.newest import Newest
from bobdesk.ui.theme import colours

if TYPE_CHECKING:
    from bobdesk.files.importers.csv_points import CsvChoice
    from bobdesk.files.importers.imported_line import ImportedLine
    from bobdesk.files.importers.preview import Preview

_DEBOUNCE_MS = 250
_WIDEST_COLUMN = 180


@dataclass(frozen=True, eq=False)
class _Looked:
    found: Preview
    length: float


def _look(path: Path, choice: CsvChoice | None) -> _Looked:
    """Read the file; called on a thread."""
    import numpy as np

    from bobdesk.files.importers.preview import preview

    found = preview(path, choice=choice)
    length = 0.0
    if found.line is not None:
        steps = np.diff(found.line.polyline.vertices, axis=0)
        length = float(np.hypot(steps[:, 0], steps[:, 1]).sum())
    return _Looked(found, length)


class ImportDialog(QDialog):
    """Reads a file in the background, again whenever the user says how it is to be read.

    Parameters
    ----------
    as_actual
        The file is wanted as the actual track, so it needs elevations.
    """

    def __init__(self, path: Path, desk: Desk, *, as_actual: bool = False, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("import-coordinates")
        self.setWindowTitle(
            self.tr("Compare with {name}").format(name=path.name)
            if as_actual
            else self.tr("Import {name}").format(name=path.name)
        )
        self._path, self._desk, self._as_actual = path, desk, as_actual
        self._found: Preview | None = None
        self._is_table = False
        self._newest = Newest(desk.runner, self.tr("Reading {name}").format(name=path.name), self)
        self._newest.answered.connect(self._on_answer)
        self._newest.failed.connect(self._on_failure)
        self._pause = QTimer(self)
        self._pause.setSingleShot(True)
        self._pause.setInterval(_DEBOUNCE_MS)
        self._pause.timeout.connect(self._read)
        self._make_parts()
        self._lay_out()
        self._show_nothing()
        self._read()

    @property
    def line(self) -> ImportedLine | None:
        """What was read, or None while that is not clear."""
        return None if self._found is None else self._found.line

    @property
    def choice(self) -> CsvChoice | None:
        """What the user says of a table; None for other formats."""
        return self.choices.choice() if self._is_table else None

    @property
    def keeps_elevations(self) -> bool:
        """Whether the elevations are to be kept as the actual track."""
        has_elevations = self._found is not None and self._found.has_elevations
        return has_elevations and (self._as_actual or self.keep.isChecked())

    def done(self, result: int) -> None:
        """Leave no clock and no question behind."""
        self._pause.stop()
        self._newest.drop()
        super().done(result)

    def _make_parts(self) -> None:
        self.about = QLabel()
        self.about.setWordWrap(True)
        self.about.setTextFormat(Qt.TextFormat.PlainText)
        self.choices = TableChoices()
        self.choices.changed.connect(self._on_choice)
        self.picture = LineView()
        self.rows = QTableWidget()
        self.rows.setAccessibleName(self.tr("First rows of the file"))
        self.rows.setToolTip(self.tr("The first rows of the file, as they are read now"))
        self.rows.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.rows.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.rows.setTabKeyNavigation(False)
        self.rows.verticalHeader().hide()
        self.rows.verticalHeader().setDefaultSectionSize(24)
        self.notes = QLabel()
        self.notes.setProperty("kind", "muted")
        self.notes.setWordWrap(True)
        self.notes.setTextFormat(Qt.TextFormat.PlainText)
        self.problem = Banner("error")
        self._sentence = QLabel()
        self._sentence.setWordWrap(True)
        self._sentence.setTextFormat(Qt.TextFormat.PlainText)
        self._sentence.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.problem.row.addWidget(self._sentence, 1)
        self.keep = QCheckBox(self.tr("&Keep the elevations as the actual track, for comparison"))
        self.keep.setChecked(True)
        self.keep.setToolTip(self.tr("Results can then be compared with what was measured"))
        self.bar = QProgressBar()
        self.bar.setRange(0, 0)
        self.bar.setTextVisible(False)
        self.bar.setFixedHeight(8)
        self.bar.setAccessibleName(self.tr("Reading the file"))
        self.stop_button = QPushButton(self.tr("Stop"))
        self.stop_button.setToolTip(self.tr("Stop reading the file"))
        self.stop_button.setAutoDefault(False)
        self.stop_button.clicked.connect(self._on_stop)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        text = self.tr("Compare") if self._as_actual else self.tr("Import")
        self.import_button = QPushButton(text)
        self.import_button.setProperty("kind", "primary")
        self.import_button.setDefault(True)
        self.buttons.addButton(self.import_button, QDialogButtonBox.ButtonRole.AcceptRole)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        offer_guide(self, self.buttons)

    def _lay_out(self) -> None:
        left = QVBoxLayout()
        left.setSpacing(10)
        left.addWidget(self.about)
        left.addWidget(self.choices)
        left.addStretch(1)
        self._left = QWidget()
        self._left.setLayout(left)
        left.setContentsMargins(0, 0, 0, 0)
        top = QHBoxLayout()
        top.setSpacing(16)
        top.addWidget(self._left, 5)
        top.addWidget(self.picture, 6)
        reading = QHBoxLayout()
        reading.addWidget(self.bar, 1)
        reading.addWidget(self.stop_button)
        title = QLabel(self.tr("First rows"))
        title.setProperty("kind", "heading")
        column = QVBoxLayout(self)
        column.setContentsMargins(20, 16, 20, 16)
        column.setSpacing(10)
        column.addLayout(top, 3)
        column.addWidget(title)
        column.addWidget(self.rows, 2)
        column.addWidget(self.notes)
        column.addWidget(self.problem)
        column.addWidget(self.keep)
        column.addLayout(reading)
        column.addWidget(self.buttons)
        self.resize(760, 640)

    def _on_choice(self) -> None:
        self.import_button.setEnabled(False)
        self._pause.start()

    def _read(self) -> None:
        path, choice = self._path, self.choice
        self._newest.ask(lambda: _look(path, choice))
        self.import_button.setEnabled(False)
        self.bar.show()
        self.stop_button.setText(self.tr("Stop"))
        self.stop_button.setToolTip(self.tr("Stop reading the file"))
        self.stop_button.show()

    def _on_stop(self) -> None:
        if self.bar.isVisible():
            self._newest.drop()
            self.bar.hide()
            self.stop_button.setText(self.tr("Read again"))
            self.stop_button.setToolTip(self.tr("Read the file from its beginning"))
        else:
            self._read()

    def _on_answer(self, looked: _Looked) -> None:
        found = looked.found
        self._found = found
        self._is_table = found.separator is not None
        self._end_reading()
        self.choices.setVisible(self._is_table)
        if self._is_table:
            self.choices.show_preview(found)
        self.about.setText(self._about(looked))
        self.picture.show_line(found.thumbnail)
        self._show_rows(found)
        self._say_notes(found.notes)
        self.keep.setVisible(found.has_elevations and not self._as_actual)
        problem = found.problem or ""
        if problem and self._is_table and found.chosen is None:
            problem = self.tr("{problem}. Choose the columns x and y above.").format(problem=problem)
        if not problem and self._as_actual and not found.has_elevations:
            problem = self.tr("There are no elevations in this file, so there is nothing to compare with.")
        self._say(problem)
        self.import_button.setEnabled(not problem)

    def _on_failure(self, sentence: str) -> None:
        self._show_nothing()
        self._end_reading()
        self._say(sentence)

    def _end_reading(self) -> None:
        self.bar.hide()
        self.stop_button.hide()

    def _show_nothing(self) -> None:
        self._found = None
        self.about.setText(self.tr("Reading the file…") if self._sentence.text() == "" else "")
        self.choices.setVisible(self._is_table)
        self.picture.show_line(None)
        self.rows.setRowCount(0)
        self.rows.setColumnCount(0)
        self._say_notes(())
        self._say("")
        self.keep.hide()
        self.import_button.setEnabled(False)

    def _say(self, sentence: str) -> None:
        # the folder is known; the name of the file says enough
        shown = sentence.replace(str(self._path), self._path.name)
        self._sentence.setText(ended(shown) if shown else "")
        self.problem.setVisible(bool(sentence))

    def _say_notes(self, notes: tuple[str, ...]) -> None:
        self.notes.setText("\n".join(f"• {note[:1].upper()}{note[1:]}." for note in notes))
        self.notes.setVisible(bool(notes))

    def _about(self, looked: _Looked) -> str:
        found, show = looked.found, self._desk.quantities
        lines = [self.tr("Format: {format}").format(format=found.format)]
        if found.count:
            what = self.tr("{count} points, {length} in plan")
            lines.append(what.format(count=show.number(found.count, 0), length=show.length(looked.length)))
        if not self._is_table and found.unit == "degrees":
            lines.append(self.tr("Degrees, brought to metres"))
        if found.count:
            lines.append(self.tr("With elevations") if found.has_elevations else self.tr("Without elevations"))
        return "\n".join(lines)

    def _show_rows(self, found: Preview) -> None:
        count = max([len(found.columns), *(len(row) for row in found.rows)], default=0)
        self.rows.setRowCount(len(found.rows))
        self.rows.setColumnCount(count)
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        for column in range(count):
            title = found.columns[column] if column < len(found.columns) else ""
            use = self.choices.title_of(column) if self._is_table else ""
            header = QTableWidgetItem(f"{title}  →  {use}" if use else title)
            self.rows.setHorizontalHeaderItem(column, header)
            for row, cells in enumerate(found.rows):
                item = QTableWidgetItem(cells[column] if column < len(cells) else "")
                item.setTextAlignment(right)
                if use:
                    item.setBackground(QColor(colours().accent_soft))
                self.rows.setItem(row, column, item)
        self.rows.resizeColumnsToContents()
        widths = [min(_WIDEST_COLUMN, self.rows.columnWidth(column) + 12) for column in range(count)]
        for column, width in enumerate(widths):
            self.rows.setColumnWidth(column, width)
        # a few columns share the width, many are scrolled
        few = sum(widths) < self.rows.viewport().width() - self.rows.verticalScrollBar().sizeHint().width()
        mode = QHeaderView.ResizeMode.Stretch if few else QHeaderView.ResizeMode.Interactive
        self.rows.horizontalHeader().setSectionResizeMode(mode)

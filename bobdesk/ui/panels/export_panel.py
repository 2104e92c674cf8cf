"""The panel of step 6: the figures of the result, and the exact bytes of the file that it becomes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtGui import QFontDatabase, QGuiApplication
from PySide6.QtWidgets import QComboBox, QLabel, QPlainTextEdit, QPushButton, QWidget

from bobdesk.errors import InputError
from bobdesk.files.atomic import write_atomic
from bobdesk.files.exporters.formats import ExportFormat, export_formats
from bobdesk.project.project import Project
from bobdesk.ui.derived import DerivedLater
from bobdesk.ui.desk import Desk
from bobdesk.ui.questions import Questions
from bobdesk.ui.solve.design_rules_part import DesignRulesPart
from bobdesk.ui.solve.export_job import Written, inputs_of, write
from bobdesk.ui.solve.figures_part import FiguresPart
from bobdesk.ui.solve.report_saving import ReportSaving
from bobdesk.ui.solve.target_field import TargetField
from bobdesk.ui.widgets.panel import Panel

_FLAVOURS = ("default", "excel-european", "tab", "xyz")


class ExportPanel(Panel):
    """What is shown is what is written; saving again overwrites the file that was saved last."""

    def __init__(self, desk: Desk, parent: QWidget | None = None) -> None:
        super().__init__(desk, parent)
        self.name_it(self.tr("Export"))
        self.figures = FiguresPart(self)
        self.rules = DesignRulesPart(self)
        self._path: Path | None = None
        self._is_wanted = False
        self._questions = Questions(desk.settings, self)
        self._reports = ReportSaving(desk, self._questions, self)
        self._file, column = self.add_section(self.tr("File"))
        form = self.add_form(column)
        self.format = QComboBox(self)
        self._formats: tuple[ExportFormat, ...] = export_formats().formats
        for known in self._formats:
            self.format.addItem(known.title)
        self.add_field(form, self.tr("Format"), self.format, self.tr("What the file is to be read by"))
        self.flavour = QComboBox(self)
        self.flavour.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.flavour.setMinimumContentsLength(18)
        self.flavour.addItems(
            [
                self.tr("comma, decimal point"),
                self.tr("Excel, European: semicolon, decimal comma"),
                self.tr("tabs, decimal point"),
                self.tr("x, y, z alone, without a heading"),
            ]
        )
        self.add_field(form, self.tr("Separators"), self.flavour, self.tr("How a table is written"))
        self._flavour_label = form.labelForField(self.flavour)
        self.spacing = TargetField(self.tr("Row spacing"), self.refuse, self)
        self.spacing.setPlaceholderText(self.tr("as solved"))
        self.add_field(
            form, self.tr("Row spacing"), self.spacing,
            self.tr("Distance of the rows in plan; leave it empty for the rows that were solved for"),
        )  # fmt: skip
        self._spacing_label: Any = form.labelForField(self.spacing)
        self.transitions = QLabel(self)
        self.transitions.setAccessibleName(self.tr("Vertical transitions"))
        self.transitions.setToolTip(self.tr("Set among the settings of the method, since they change the result"))
        form.addRow(self.tr("Vertical transitions"), self.transitions)
        self._preview_section, column = self.add_section(self.tr("Exactly what will be written"))
        self.size_label = self.add_label("", "muted", column)
        self.text = QPlainTextEdit(self)
        self.text.setReadOnly(True)
        self.text.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self.text.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self.text.setAccessibleName(self.tr("Preview of the file"))
        self.text.setToolTip(self.tr("The file as it will be written; of a long one the beginning and the end"))
        self.text.setTabChangesFocus(True)
        self.text.setFixedHeight(190)
        column.addWidget(self.text)
        self.totals = self.add_label("", "", column)
        flow = self.add_buttons(column)
        self.save_button = QPushButton(self)
        self.save_button.setProperty("kind", "primary")
        self.save_button.setAutoDefault(True)
        flow.addWidget(self.save_button)
        self.save_as_button = self.button(flow, self.tr("Save as…"), self.tr("Write another file"), "save-as")
        self.copy_button = self.button(flow, self.tr("Copy"), self.tr("Copy the whole file to the clipboard"), "copy")
        self._report_section, column = self.add_section(self.tr("Report"))
        flow = self.add_buttons(column)
        self.pdf_button = self.button(
            flow, self.tr("Report as PDF…"), self.tr("Pictures, figures, settings and sources on paper"), "export"
        )
        self.html_button = self.button(
            flow, self.tr("Report as HTML…"), self.tr("Pictures, figures, settings and sources in one file"), "export"
        )
        self.column.addStretch(1)
        self.later = DerivedLater(desk, self.tr("Preparing the file"), write, inputs_of, self)
        self._connect()
        self._refresh()

    def take_focus(self) -> None:
        """Let Enter save: Ctrl+E, then Enter, repeats the last export."""
        self.save_button.setFocus(Qt.FocusReason.ShortcutFocusReason)
        self.ensureWidgetVisible(self.save_button)

    def save(self) -> None:
        """Write the file again where it was written last, or ask where; one that is still prepared is waited for."""
        if self._written() is None:
            self._is_wanted = True
        elif self._path is None:
            self.save_as()
        else:
            self._write(self._path)

    def save_as(self) -> None:
        """Ask where, and write the file."""
        found = self._written()
        if found is None:
            return
        known = self._format()
        name = (self.desk.session.project.name or self.tr("track")) + known.extension
        path = self._questions.file_to_save(
            "export", self.tr("Export"), name, f"{known.title} (*{known.extension})", known.extension
        )
        if path is not None:
            self._write(path)

    def copy(self) -> None:
        """Copy the file as text."""
        found = self._written()
        if found is not None:
            QGuiApplication.clipboard().setText(found.content.decode("utf-8-sig", errors="replace"))
            self.desk.notices.note(self.tr("The file is on the clipboard."))

    def _connect(self) -> None:
        self.format.activated.connect(lambda index: self._choose(format=self._formats[index].key))
        self.flavour.activated.connect(lambda index: self._choose(flavour=_FLAVOURS[index]))
        self.spacing.entered.connect(self._on_spacing)
        self.save_button.clicked.connect(self.save)
        self.save_as_button.clicked.connect(self.save_as)
        self.copy_button.clicked.connect(self.copy)
        self.pdf_button.clicked.connect(lambda: self._reports.save("pdf"))
        self.html_button.clicked.connect(lambda: self._reports.save("html"))
        self.later.changed.connect(self._on_written)
        self.desk.session.changed.connect(self._on_changed)
        self.desk.session.document_changed.connect(self._forget)
        self.desk.quantities.changed.connect(self._refresh)

    def _on_changed(self, before: Project, after: Project) -> None:
        if before.export.format != after.export.format:
            self._path = None
        self._refresh()

    def _forget(self) -> None:
        self._path, self._is_wanted = None, False

    def _on_written(self) -> None:
        self._show()
        if self._is_wanted and self.later.is_current:
            self._is_wanted = False
            if self._written() is not None:
                self.save()

    def _refresh(self) -> None:
        project, unit = self.desk.session.project, self.desk.quantities
        self.figures.refresh(project)
        self.rules.refresh(project)
        has_run = project.run is not None
        for section in (self._file, self._preview_section, self._report_section):
            section.setVisible(has_run)
        self.say("" if has_run else self.tr("A result comes first: solve, then export it."))
        choice = project.export
        keys = [known.key for known in self._formats]
        with QSignalBlocker(self.format), QSignalBlocker(self.flavour):
            self.format.setCurrentIndex(keys.index(choice.format) if choice.format in keys else -1)
            self.flavour.setCurrentIndex(_FLAVOURS.index(choice.flavour) if choice.flavour in _FLAVOURS else 0)
        is_table = self._format().is_table
        self.flavour.setVisible(is_table)
        self._flavour_label.setVisible(is_table)
        self._spacing_label.setText(self.tr("Row spacing") + f", {unit.length_unit}")
        self.spacing.show_value(None if choice.spacing is None else choice.spacing * unit.length_factor)
        if project.run is not None:
            solved = project.run.inputs.settings
            self.transitions.setText(
                unit.length(solved.pgd.transition, 1) if solved.method == "pgd" else self.tr("none, kinks")
            )
        self._show()

    def _show(self) -> None:
        found: Written | None = self.later.value
        ready = found is not None and self.later.is_current
        for button in (self.save_as_button, self.copy_button):
            button.setEnabled(ready)
        # Ctrl+E, then Enter, must not depend on how quick one is.
        self.save_button.setEnabled(ready or (self.later.problem is None and not self.later.is_current))
        text = self.tr("Save {title}…").format(title=self._format().extension.removeprefix(".").upper())
        if self._path is not None:
            text = self.tr("Save {name}").format(name=self._path.name)
        self.save_button.setText(text)
        self.save_button.setAccessibleName(text)
        self.save_button.setToolTip(self.tr("Write the file (Ctrl+E, then Enter)"))
        if found is None:
            self.text.setPlainText("")
            self.size_label.setText(self.later.problem or self.tr("Preparing the file …"))
            self.totals.setText("")
            return
        if self.text.toPlainText() != found.text:
            self.text.setPlainText(found.text)
        self._say(found)

    def _say(self, found: Written) -> None:
        unit = self.desk.quantities
        parts = []
        if found.totals is not None:
            parts.append(self.tr("{count} rows").format(count=unit.number(found.totals.rows, 0)))
        parts.append(self.tr("{size} kB").format(size=unit.number(len(found.content) / 1000, 1)))
        parts.append("UTF-8, BOM" if found.content.startswith(b"\xef\xbb\xbf") else "UTF-8")
        self.size_label.setText(" · ".join(parts))
        if found.totals is None:
            self.totals.setText("")
            return
        self.totals.setText(
            self.tr("Recomputed from these rows: length {length}, height difference {drop}").format(
                length=unit.length(found.totals.length, 3), drop=unit.length(found.totals.drop, 3)
            )
        )

    def _format(self) -> ExportFormat:
        key = self.desk.session.project.export.format
        return next((known for known in self._formats if known.key == key), self._formats[0])

    def _choose(self, **values: Any) -> None:
        from bobdesk.project import edits

        choice = replace(self.desk.session.project.export, **values)
        self.desk.session.apply(
            self.tr("Choose how to export"), lambda project: edits.choose_export(project, choice), key="export"
        )

    def _on_spacing(self, shown: float | None) -> None:
        self._choose(spacing=None if shown is None else shown / self.desk.quantities.length_factor)
        self._refresh()

    def _written(self) -> Written | None:
        found: Written | None = self.later.value
        return found if self.later.is_current else None

    def _write(self, path: Path) -> None:
        found = self._written()
        if found is None:
            return
        try:
            write_atomic(path, found.content)
        except InputError as error:
            self.desk.notices.error(str(error))
            return
        self._path = path
        self.desk.notices.note(self.tr("Written to {name}.").format(name=path.name))
        self._show()

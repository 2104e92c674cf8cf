"""The left side of the study: what is varied, and how many solves that makes."""

from __future__ import annotations

import os

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QCheckBox, QLineEdit, QPlainTextEdit, QSpinBox, QWidget

from bobdesk.errors import InputError
from bobdesk.ui.desk import Desk
from bobdesk.ui.questions import Questions
from bobdesk.ui.studies.method_titles import method_titles
from bobdesk.ui.studies.plans_part import PlansPart
from bobdesk.ui.studies.study_choice import StudyChoice, Wanted, wanted_of
from bobdesk.ui.widgets.panel import Panel

_KNOWN_LINES = 3
_MOST_WORKERS = 256


class StudyForm(Panel):
    """Texts are understood while they are typed; nothing is refused before it is whole.

    Signals
    -------
    changed
        Another choice.
    """

    changed = Signal()

    def __init__(self, desk: Desk, questions: Questions, parent: QWidget | None = None) -> None:
        super().__init__(desk, parent)
        self.name_it(self.tr("What is varied"))
        self.plans = PlansPart(self, questions)
        self.plans.changed.connect(self._tell)
        self.method_boxes: dict[str, QCheckBox] = {}
        self._add_fields()
        self._add_methods()
        self._add_known()
        self._add_workers()
        self.column.addStretch(1)
        self.show_choice(StudyChoice())

    def choice(self) -> StudyChoice:
        """Return what is chosen now."""
        return StudyChoice(
            counts=self.counts.text(),
            weights=self.weights.text(),
            methods=tuple(key for key, box in self.method_boxes.items() if box.isChecked()),
            known=self.known.toPlainText(),
            without_known=self.without_known.isChecked(),
            workers=self.workers.value() if self.workers.value() < self._cores else 0,
            with_project=self.plans.with_project,
            files=tuple(entry.remembered for entry in self.plans.entries),
        )

    def show_choice(self, choice: StudyChoice) -> None:
        """Show a choice; its files are read in the background."""
        with QSignalBlocker(self):
            self.counts.setText(choice.counts)
            self.weights.setText(choice.weights)
            for key, box in self.method_boxes.items():
                box.setChecked(key in choice.methods)
            self.known.setPlainText(choice.known)
            self.without_known.setChecked(choice.without_known)
            self.workers.setValue(choice.workers or self._cores)
            self.plans.with_project = choice.with_project
        self.plans.read(choice.files)
        self._tell()

    def wanted(self) -> Wanted:
        """Return what the choice means.

        Raises
        ------
        InputError
            If it cannot be read.
        """
        return wanted_of(self.choice(), len(self.plans.used()))

    def summary(self) -> tuple[str, bool]:
        """Return how many solves that makes, or what is missing; and whether it can be solved."""
        if self.plans.is_reading:
            return self.tr("Reading plans …"), False
        plans = len(self.plans.used())
        if not plans:
            return self.tr("Open a project, or add plans from files."), False
        try:
            wanted = self.wanted()
        except InputError as error:
            sentence = str(error)
            return f"{sentence[:1].upper()}{sentence[1:]}.", False
        number = self.desk.quantities.number
        count = wanted.cells_of(plans)
        return self.tr(
            "{solves} solves: plans {plans}, segment counts {counts}, methods {methods}, weights {weights},"
            " sets of known elevations {sets}."
        ).format(
            solves=number(count, 0), plans=plans, counts=len(wanted.counts), methods=len(wanted.methods),
            weights=len(wanted.weights), sets=len(wanted.sets),
        ), True  # fmt: skip

    def _add_fields(self) -> None:
        _, column = self.add_section(self.tr("Segments and weights"))
        form = self.add_form(column)
        self.counts = QLineEdit(self)
        self.counts.setPlaceholderText("10, 15, 21")
        self.add_field(
            form,
            self.tr("Numbers of segments"),
            self.counts,
            self.tr("Such as 10, 15, 21 or 10-20 or 10-30:5; auto: as they are in the plan, or found"),
        )
        self.weights = QLineEdit(self)
        self.weights.setPlaceholderText("0.5; 1; 1.5")
        self.add_field(
            form,
            self.tr("Height weights b"),
            self.weights,
            self.tr("Of the published objective, for all methods but the recommended one; such as 0.5; 1; 1.5"),
        )
        for field in (self.counts, self.weights):
            field.textChanged.connect(self._tell)

    def _add_methods(self) -> None:
        _, column = self.add_section(self.tr("Methods"))
        for key, title in method_titles().items():
            box = QCheckBox(title, self)
            box.setAccessibleName(title)
            box.setToolTip(self.tr("Solve by this method: {key} in the table").format(key=key))
            box.toggled.connect(self._tell)
            self.method_boxes[key] = box
            column.addWidget(box)

    def _add_known(self) -> None:
        _, column = self.add_section(self.tr("Known elevations"))
        self.without_known = QCheckBox(self.tr("None besides the plan's own"), self)
        self.without_known.setAccessibleName(self.without_known.text())
        self.without_known.setToolTip(self.tr("Solve with the known elevations that the plan has and no others"))
        self.without_known.toggled.connect(self._tell)
        column.addWidget(self.without_known)
        self.known = QPlainTextEdit(self)
        self.known.setTabChangesFocus(True)
        self.known.setAccessibleName(self.tr("Sets of known elevations"))
        self.known.setToolTip(
            self.tr("One set a line, STATION:ELEVATION in metres, parted by spaces; added to the plan's own")
        )
        self.known.setPlaceholderText("250:98.5\n250:98.5 600:40")
        lines = QFontMetrics(self.known.font()).lineSpacing() * _KNOWN_LINES
        self.known.setFixedHeight(lines + round(2 * self.known.document().documentMargin()) + 6)
        self.known.textChanged.connect(self._tell)
        column.addWidget(self.known)
        self.add_label(self.tr("A set a line, such as 250:98.5 600:40 (station:elevation, metres)."), "muted", column)

    def _add_workers(self) -> None:
        _, column = self.add_section(self.tr("Computer"))
        form = self.add_form(column)
        self._cores = min(os.cpu_count() or 1, _MOST_WORKERS)
        self.workers = QSpinBox(self)
        self.workers.setRange(1, _MOST_WORKERS)
        self.workers.setMinimumHeight(self.counts.sizeHint().height())
        self.add_field(form, self.tr("Processes"), self.workers, self.tr("How many cells are solved at the same time"))
        self.workers.valueChanged.connect(self._tell)

    def _tell(self) -> None:
        self.weights.setEnabled(any(box.isChecked() for key, box in self.method_boxes.items() if key != "pgd"))
        self.changed.emit()

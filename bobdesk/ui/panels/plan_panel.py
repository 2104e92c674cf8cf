"""The first step: which plan the project is made from."""

from __future__ import annotations

from pathlib import PurePath

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtGui import QFontMetrics, QTextCursor
from PySide6.QtWidgets import QLineEdit, QPlainTextEdit, QWidget

from bobdesk.project import edits
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.panels.actual_part import ActualPart
from bobdesk.ui.panels.digitised_part import DigitisedPart
from bobdesk.ui.panels.page_part import PagePart
from bobdesk.ui.panels.plan_source_part import PlanSourcePart
from bobdesk.ui.typing_undo import TAKES_EACH_LETTER
from bobdesk.ui.widgets.panel import Panel

_NOTES_LINES = 3


class PlanPanel(Panel):
    """Name, notes, picture or coordinates, digitised line, actual track.

    Signals
    -------
    picture_wanted, coordinates_wanted
        Begin with a picture, or with coordinates, from a file.
    comparison_wanted
        Take the actual track from a file.
    """

    picture_wanted = Signal()
    coordinates_wanted = Signal()
    comparison_wanted = Signal()

    def __init__(self, desk: Desk, parent: QWidget | None = None) -> None:
        super().__init__(desk, parent)
        self.name_it(self.tr("Plan"))
        form = self.add_form()
        self.name = QLineEdit(self)
        self.name.setPlaceholderText(self.tr("such as the track's name"))
        self.add_field(form, self.tr("Name"), self.name, self.tr("What the project is called"))
        self.name.setProperty(TAKES_EACH_LETTER, True)
        self.name.textEdited.connect(self._on_name)
        self.notes = QPlainTextEdit(self)
        self.notes.setTabChangesFocus(True)
        self.notes.setPlaceholderText(self.tr("Where the plan comes from, what is known of it …"))
        lines = QFontMetrics(self.notes.font()).lineSpacing() * _NOTES_LINES
        self.notes.setFixedHeight(lines + round(2 * self.notes.document().documentMargin()) + 4)
        self.add_field(form, self.tr("Notes"), self.notes, self.tr("Free text, kept in the project"))
        self.notes.setProperty(TAKES_EACH_LETTER, True)
        self.notes.textChanged.connect(self._on_notes)
        self.source = PlanSourcePart(self)
        flow = self.add_buttons()
        picture = self.button(
            flow, self.tr("New from picture…"), self.tr("Begin with a scan, drawing, PDF or aerial"), "picture"
        )
        picture.clicked.connect(self.picture_wanted)
        coordinates = self.button(
            flow, self.tr("New from coordinates…"), self.tr("Begin with CSV, DXF, GeoJSON, KML, GPX …"), "coordinates"
        )
        coordinates.clicked.connect(self.coordinates_wanted)
        self.page = PagePart(self)
        self.digitised = DigitisedPart(self)
        self.actual = ActualPart(self)
        self.actual.wanted.connect(self.comparison_wanted)
        self.column.addStretch(1)
        desk.session.changed.connect(self._on_changed)
        desk.picture.changed.connect(self._refresh)
        desk.quantities.changed.connect(self._refresh)
        self._refresh()

    def _on_changed(self, before: Project, after: Project) -> None:
        shown = ("name", "notes", "picture", "source", "extent", "actual")
        if any(getattr(before, name) is not getattr(after, name) for name in shown):
            self._refresh()

    def _refresh(self) -> None:
        project = self.desk.session.project
        has_plan = project.picture is not None or project.source is not None
        self.say(
            ""
            if has_plan
            else self.tr(
                "Nothing is open yet. Begin with a picture of the plan or with coordinates, or drop a file anywhere."
            )
        )
        # What is being typed may have a blank at its end that the project does not keep.
        if self.name.text().strip() != project.name:
            self.name.setText(project.name)
        if self.notes.toPlainText() != project.notes:
            with QSignalBlocker(self.notes):
                self.notes.setPlainText(project.notes)
                self.notes.moveCursor(QTextCursor.MoveOperation.End)
        if project.picture is not None:
            self.name.setPlaceholderText(PurePath(project.picture.name).stem)
        self.source.refresh(project)
        self.page.refresh(project)
        self.digitised.setVisible(has_plan)
        self.digitised.refresh(project)
        self.actual.setVisible(has_plan)
        self.actual.refresh(project)

    def _on_name(self, text: str) -> None:
        if text.strip() != self.desk.session.project.name:
            self.desk.session.apply(
                self.tr("Name project"), lambda project: edits.name_project(project, text), key="name"
            )

    def _on_notes(self) -> None:
        text = self.notes.toPlainText()
        if text != self.desk.session.project.notes:
            self.desk.session.apply(
                self.tr("Write notes"), lambda project: edits.write_notes(project, text), key="notes"
            )

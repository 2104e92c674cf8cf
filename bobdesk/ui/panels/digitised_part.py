"""Which line of the track was digitised, and how far from it the centreline lies."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker

from bobdesk.project import edits
from bobdesk.project.project import DigitisedLine, Project
from bobdesk.ui.widgets.calm import Chooser
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.spin import Spin

_WIDEST_M = 20.0


class DigitisedPart(Part):
    """A chooser and an offset."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Digitised line"))
        form = panel.add_form(self.column)
        self.line = Chooser(self.tr("Digitised line"), self)
        lines: tuple[tuple[DigitisedLine, str], ...] = (
            ("centre", self.tr("Centre")),
            ("left edge", self.tr("Left edge")),
            ("right edge", self.tr("Right edge")),
        )
        for value, text in lines:
            self.line.addItem(text, value)
        tip = self.tr("Which line of the track the plan shows, seen downhill")
        panel.add_field(form, self.tr("The line is the"), self.line, tip)
        self.line.activated.connect(self._on_line)
        self.offset = Spin(self.tr("Centreline lies inside by"), self)
        self.offset.setDecimals(2)
        self.offset.setSingleStep(0.05)
        tip = self.tr("From the edge to the centreline, on the ground")
        panel.add_field(form, self.tr("Centreline lies inside by"), self.offset, tip)
        self.offset.valueChanged.connect(self._on_offset)
        self._form = form

    def refresh(self, project: Project) -> None:
        """Show what a project says."""
        with QSignalBlocker(self.line):
            self.line.setCurrentIndex(self.line.findData(project.extent.digitised))
        unit = self.desk.quantities
        self._form.setRowVisible(self.offset, project.extent.digitised != "centre")
        self.offset.show_unit(unit.length_unit)
        self.offset.show_range(0.0, _WIDEST_M * unit.length_factor)
        self.offset.show_value(project.extent.offset * unit.length_factor)

    def _on_line(self) -> None:

        digitised: DigitisedLine = self.line.currentData()
        extent = self.desk.session.project.extent
        if digitised != extent.digitised:
            self.desk.session.apply(
                self.tr("Say which line was digitised"),
                lambda project: edits.say_which_line(project, digitised, extent.offset),
            )

    def _on_offset(self, shown: float) -> None:

        digitised = self.desk.session.project.extent.digitised
        offset = min(_WIDEST_M, shown / self.desk.quantities.length_factor)
        self.desk.session.apply(
            self.tr("Set distance from the edge"),
            lambda project: edits.say_which_line(project, digitised, offset),
            key="edge offset",
        )

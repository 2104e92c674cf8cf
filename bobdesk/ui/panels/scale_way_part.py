"""How pixels become metres: the way, and the number that some ways need."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QSignalBlocker

from bobdesk.project import derive, edits
from bobdesk.project.project import CalibrationWay, Project
from bobdesk.sentences import as_sentence
from bobdesk.ui.widgets.calm import Chooser
from bobdesk.ui.widgets.number_field import NumberField
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part

if TYPE_CHECKING:
    from bobdesk.plan.calibration import Calibration
    from bobdesk.project.derive import Derived


class ScaleWayPart(Part):
    """A chooser; only the ways that this plan allows can be chosen."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Where the scale comes from"))
        self.chooser = Chooser(self.tr("Where the scale comes from"), self)
        self.chooser.setToolTip(self.tr("How pixels of the plan become metres"))
        self.chooser.activated.connect(self._on_activated)
        self.column.addWidget(self.chooser)
        form = panel.add_form(self.column)
        self.number = NumberField(self.tr("Metres per pixel"), panel.refuse, self)
        panel.add_field(form, self.tr("Metres per pixel"), self.number, self.tr("Metres on the ground for one pixel"))
        self.number.entered.connect(self._on_number)
        self.one_to = NumberField(self.tr("Scale of the drawing, 1 :"), panel.refuse, self)
        panel.add_field(form, self.tr("1 :"), self.one_to, self.tr("Scale of the drawing, such as 1000 for 1 : 1000"))
        self.one_to.entered.connect(self._on_one_to)
        self._form = form
        self.sentence = panel.add_label("", "muted", self.column)

    def refresh(self, project: Project, found: Derived[Calibration] | None) -> None:
        """Show the way of a project, and what is missing."""
        ways = self._ways(project)
        with QSignalBlocker(self.chooser):
            self.chooser.clear()
            for way, text in ways:
                self.chooser.addItem(text, way)
            self.chooser.setCurrentIndex(max(0, self.chooser.findData(project.calibration.way)))
        way = project.calibration.way
        has_picture = project.source is None
        self._form.setRowVisible(self.number, has_picture and way == "scale")
        self._form.setRowVisible(self.one_to, has_picture and way == "drawing scale")
        self.number.show_value(project.calibration.metres_per_pixel, digits=8)
        self.one_to.show_value(project.calibration.one_to)
        sentence = self._sentence(project, found)
        self.sentence.setText(sentence)
        self.sentence.setVisible(bool(sentence))

    def _ways(self, project: Project) -> list[tuple[CalibrationWay, str]]:
        if project.source is not None:
            return [
                ("points", self.tr("The coordinates are metres")),
                ("unknown", self.tr("Unknown, find it from the length")),
            ]
        picture, chosen = project.picture, project.calibration.way
        ways: list[tuple[CalibrationWay, str]] = [
            ("points", self.tr("Control points or known distances")),
            ("scale", self.tr("Metres per pixel")),
        ]
        if chosen == "drawing scale" or (picture is not None and picture.file_dpi is not None):
            ways.append(("drawing scale", self.tr("Scale of the drawing, 1 : n")))
        if chosen == "world" or (picture is not None and picture.world is not None):
            ways.append(("world", self.tr("The picture's own position")))
        ways.append(("unknown", self.tr("Unknown, find it from the length")))
        return ways

    def _sentence(self, project: Project, found: Derived[Calibration] | None) -> str:
        way = project.calibration.way
        if way == "unknown":
            return self.tr("The scale factor f is solved for: the length and the drop of the track decide it.")
        if found is None:
            return ""
        if found.value is None:
            return as_sentence(found.problem)
        if way == "drawing scale" and project.picture is not None and project.picture.file_dpi is not None:
            text = self.tr("At {dpi} dpi, as the picture says.")
            return text.format(dpi=self.desk.quantities.number(project.picture.file_dpi[0], 0))
        if way == "world":
            return self.tr("From the picture's tags, or the world file that lay beside it.")
        return ""

    def _on_activated(self, index: int) -> None:

        way: CalibrationWay = self.chooser.itemData(index)
        project = self.desk.session.project
        if way == project.calibration.way:
            return
        now = derive.calibration(project).value if project.picture is not None else None
        label = self.tr("Choose where the scale comes from")
        if way == "scale" and project.calibration.metres_per_pixel is None and now is not None and now.scale_known:
            # Beginning with the scale in force changes nothing on the ground.
            value = now.metres_per_pixel
            self.desk.session.apply(label, lambda project: edits.scale_by_number(project, value))
        else:
            self.desk.session.apply(label, lambda project: edits.choose_scale_way(project, way))
        for field in (self.number, self.one_to):
            if field.isVisible():
                field.setFocus()

    def _on_number(self, value: float) -> None:

        self.desk.session.apply(self.tr("Set the scale"), lambda project: edits.scale_by_number(project, value))

    def _on_one_to(self, value: float) -> None:

        self.desk.session.apply(
            self.tr("Set the scale of the drawing"), lambda project: edits.scale_of_drawing(project, value)
        )

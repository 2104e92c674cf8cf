"""What can be set of the sled that design rules are judged by."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QVBoxLayout

from bobdesk.project.project import Project
from bobdesk.ui.widgets.number_field import NumberField
from bobdesk.ui.widgets.panel import Panel


class SledFields(QObject):
    """A field for each figure, in SI."""

    def __init__(self, panel: Panel, column: QVBoxLayout) -> None:
        super().__init__(panel)
        self._panel = panel
        form = panel.add_form(column)
        self.fields: dict[str, NumberField] = {}
        for name, text, tip in (
            ("mass", self.tr("Mass, kg"), self.tr("Of sled and crew; 630 kg is the most for four-man bobs")),
            ("drag_area", self.tr("Drag area, m²"),
             self.tr("Drag coefficient times front area; 0.12 is an assumption")),
            ("friction", self.tr("Friction"),
             self.tr("Of runners on ice; 0.0042 ± 0.0009 was measured by Poirier et al.")),
            ("start_speed", self.tr("Start speed, m/s"), self.tr("At station 0, with the crew seated")),
            ("air_density", self.tr("Air, kg/m³"), self.tr("Density of the air; 1.25 at 5 °C and sea level")),
        ):  # fmt: skip
            field = NumberField(text, panel.refuse, panel)
            field.entered.connect(lambda value, name=name: self._set(name, value))
            panel.add_field(form, text, field, tip)
            self.fields[name] = field
        panel.add_label(
            self.tr("A point that slides down the centreline, neither steered nor braked; banked curves are left out."),
            "muted",
            column,
        )

    def refresh(self, project: Project) -> None:
        """Show the sled of a project."""
        for name, field in self.fields.items():
            field.show_value(getattr(project.sled, name))

    def _set(self, name: str, value: float) -> None:
        from bobdesk.project import edits

        session = self._panel.desk.session
        sled = replace(session.project.sled, **{name: value})
        if not session.apply(self.tr("Change the sled"), lambda project: edits.set_sled(project, sled)):
            self.refresh(session.project)

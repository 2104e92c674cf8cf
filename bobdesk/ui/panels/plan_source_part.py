"""What the plan is: properties of the picture, or of the coordinates."""

from __future__ import annotations

import re

from PySide6.QtCore import Qt

from bobdesk.project import derive
from bobdesk.project.project import Picture, Project, SourceLine
from bobdesk.ui.widgets.long_names import breakable
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part


class PlanSourcePart(Part):
    """Rows of properties, and what the decoder had to say."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        facts = panel.add_facts(self.column)
        self.file = facts.add(self.tr("File"))
        self.format = facts.add(self.tr("Format"))
        self.pixels = facts.add(self.tr("Size"))
        self.resolution = facts.add(self.tr("Resolution"))
        self.pages = facts.add(self.tr("Pages"))
        self.position = facts.add(self.tr("Position"))
        self.vertices = facts.add(self.tr("Vertices"))
        self.length = facts.add(self.tr("Length"))
        # Breaks that nobody sees must not be copied.
        self.file.setTextInteractionFlags(Qt.TextInteractionFlag.NoTextInteraction)
        self._facts = facts
        self.problem = panel.add_label("", "error", self.column)
        self.notes = panel.add_label("", "muted", self.column)

    def refresh(self, project: Project) -> None:
        """Show the plan of a project."""
        self.problem.hide()
        self.notes.hide()
        self.setVisible(project.source is not None or project.picture is not None)
        if project.source is not None:
            self._show_coordinates(project, project.source)
        elif project.picture is not None:
            self._show_picture(project.picture)

    def _show_rows(self, *shown: object) -> None:
        for row in (self.format, self.pixels, self.resolution, self.pages, self.position, self.vertices, self.length):
            self._facts.show_row(row, row in shown)

    def _show_coordinates(self, project: Project, source: SourceLine) -> None:

        self.name_it(self.tr("Coordinates"))
        self._show_rows(self.position, self.vertices, self.length)
        number = self.desk.quantities.number
        self.file.setText(_breakable(source.name))
        self.vertices.setText(number(len(source.polyline.vertices), 0))
        self.length.setText(self.desk.quantities.length(derive.digitised_length(project)))
        if source.longitude is None or source.latitude is None:
            self.position.setText(self.tr("not stated"))
        else:
            text = self.tr("longitude {east}°, latitude {north}°")
            self.position.setText(text.format(east=number(source.longitude, 5), north=number(source.latitude, 5)))

    def _show_picture(self, picture: Picture) -> None:
        self.name_it(self.tr("Picture"))
        image = self.desk.picture.image
        self.file.setText(_breakable(picture.name))
        self.position.setText(
            self.tr("by the picture's tags or world file") if picture.world is not None else self.tr("not stated")
        )
        problem = self.desk.picture.problem
        if problem is not None:
            self.problem.setText(problem)
            self.problem.show()
        size = (image.width, image.height) if image is not None else picture.size_px
        self.pixels.setText(self._size(size))
        dpi = image.dpi if image is not None else picture.file_dpi
        self.resolution.setText(self._dpi(dpi))
        if image is None:
            self._show_rows(self.pixels, self.resolution, self.position)
            return
        self.format.setText(image.format)
        self.pages.setText(self.desk.quantities.number(image.pages, 0))
        rows = (self.format, self.pixels, self.resolution, self.position)
        self._show_rows(*rows, *((self.pages,) if image.pages > 1 else ()))
        self.notes.setText("\n".join(image.notes))
        self.notes.setVisible(bool(image.notes))

    def _size(self, size: tuple[int, int] | None) -> str:
        if size is None:
            return self.tr("being read …")
        number = self.desk.quantities.number
        text = self.tr("{width} × {height} px, {megapixels} megapixels")
        return text.format(
            width=number(size[0], 0), height=number(size[1], 0), megapixels=number(size[0] * size[1] / 1e6, 1)
        )

    def _dpi(self, dpi: tuple[float, float] | None) -> str:
        if dpi is None:
            return self.tr("not stated in the file")
        number = self.desk.quantities.number
        same = round(dpi[0]) == round(dpi[1])
        shown = number(dpi[0], 0) if same else f"{number(dpi[0], 0)} × {number(dpi[1], 0)}"
        return self.tr("{dpi} dpi").format(dpi=shown)


def _breakable(name: str) -> str:
    """Return a file's name that may be wrapped behind its signs."""
    return breakable(re.sub(r"([_.\-])", "\\1\u200b", name))

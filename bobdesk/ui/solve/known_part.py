"""Known elevations: the best cure for what length and drop leave open."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from PySide6.QtCore import Qt

from bobdesk.errors import InputError
from bobdesk.project.project import Project
from bobdesk.solve.targets import KnownElevation
from bobdesk.ui.questions import Questions
from bobdesk.ui.widgets.columns_model import Column, ColumnsModel
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.table import Table
from bobdesk.ui.widgets.typed_number import number_to_edit, typed_number


class KnownPart(Part):
    """A row for each known elevation; the cursor along the line says where a new one is."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        # Station of a row whose elevation is still to be typed; no made-up elevation enters the project.
        self._awaited: float | None = None
        self.name_it(self.tr("Known elevations"))
        self.model = ColumnsModel(
            self._columns(),
            lambda: len(self._known) + (self._awaited is not None),
            panel.refuse,
            stands_out=self._why_it_stands_out,
            parent=self,
        )
        self.table = Table(self.tr("Known elevations"), self.model, fewest_rows=1, most_rows=5, parent=self)
        self.table.setSelectionMode(Table.SelectionMode.SingleSelection)
        self.table.fit_columns(("88,888.88 xx", "8,888.88 xx", "888.88 xx"))
        self.column.addWidget(self.table)
        self.hint = panel.add_label(
            self.tr("None yet. One elevation that is known on the way is worth more than any setting."),
            "muted",
            self.column,
        )
        flow = panel.add_buttons(self.column)
        self.add_button = panel.button(
            flow,
            self.tr("Add"),
            self.tr(
                "Add a row for a known elevation at the cursor along the line; it counts once its elevation is typed"
            ),
            "plus",
        )
        self.remove_button = panel.button(
            flow, self.tr("Remove"), self.tr("Take the selected elevation away (Del)"), "minus"
        )
        self.load_button = panel.button(
            flow,
            self.tr("Load CSV…"),
            self.tr("Take known elevations from a table with the columns station_m, z_m and, if wanted, tolerance_m"),
            "load",
        )
        self.add_button.clicked.connect(self._on_add)
        self.remove_button.clicked.connect(self._on_remove)
        self.table.on_key(Qt.Key.Key_Delete, self.remove_button)
        self.load_button.clicked.connect(self._on_load)
        self.table.selectionModel().selectionChanged.connect(self._on_row)
        self.desk.quantities.changed.connect(self.model.refresh_headings)
        self.desk.session.document_changed.connect(lambda: self._await(None))

    @property
    def _known(self) -> tuple[KnownElevation, ...]:
        return self.desk.session.project.known_elevations

    def refresh(self, project: Project) -> None:
        """Show the elevations of a project."""
        some = bool(project.known_elevations) or self._awaited is not None
        self.model.refresh()
        self.table.setVisible(some)
        self.hint.setVisible(not some)
        self._on_row()

    def begin(self, station: float) -> None:
        """Add a row at a station of the plan, m, and let its elevation be typed."""
        self._await(round(station, 2))
        place = self.model.index(len(self._known), 1)
        self.panel.ensureWidgetVisible(self.table)
        self.table.setFocus(Qt.FocusReason.OtherFocusReason)
        self.table.setCurrentIndex(place)
        self.table.edit(place)

    def _await(self, station: float | None) -> None:
        self._awaited = station
        self.refresh(self.desk.session.project)

    def _value(self, row: int, field: str) -> float | None:
        if row < len(self._known):
            found: float = getattr(self._known[row], field)
            return found
        return self._awaited if field == "station" else None

    def _columns(self) -> tuple[Column, ...]:
        unit = self.desk.quantities

        def text(row: int, field: str) -> str:
            value = self._value(row, field)
            if value is None:
                return self.tr("type it") if field == "elevation" else ""
            return unit.number(value * factor(field), 2)

        def edited(row: int, field: str) -> str:
            value = self._value(row, field)
            return "" if value is None else number_to_edit(value * factor(field))

        def factor(field: str) -> float:
            return 1.0 if in_pixels(field) else unit.length_factor

        def in_pixels(field: str) -> bool:
            from bobdesk.project import derive

            project = self.desk.session.project
            return field == "station" and project.picture is not None and not derive.scale_is_known(project)

        def column(heading: str, tip: str, field: str) -> Column:
            return Column(
                lambda: f"{heading} {'px' if in_pixels(field) else unit.length_unit}",
                tip,
                lambda row: text(row, field),
                lambda row: edited(row, field),
                lambda row, typed: self._change(row, **{field: typed_number(typed) / factor(field)}),
            )

        return (
            column(self.tr("Station"), self.tr("Along the line in plan, from the start"), "station"),
            column(self.tr("Elevation"), self.tr("Above the lowest point of the track"), "elevation"),
            column(
                self.tr("Tolerance"), self.tr("How far the result may lie from it; 0 holds it exactly"), "tolerance"
            ),
        )

    def _why_it_stands_out(self, row: int) -> str:
        if row >= len(self._known):
            return self.tr("It counts once its elevation is typed.")
        drop = self.desk.session.project.targets.drop
        if drop is not None and self._known[row].elevation > drop + self._known[row].tolerance:
            return self.tr("This lies above the start, which is at the height difference.")
        return ""

    def _change(self, row: int, **values: Any) -> bool:
        from bobdesk.project import edits

        if row >= len(self._known):
            return self._fill(**values)
        known = replace(self._known[row], **values)
        return self.desk.session.apply(
            self.tr("Change known elevation"), lambda project: edits.change_known_elevation(project, row, known)
        )

    def _fill(self, *, station: float | None = None, elevation: float | None = None, tolerance: float = 0.0) -> bool:
        """Type into the row that waits."""
        from bobdesk.project import edits

        if station is not None or self._awaited is None or elevation is None:
            self._await(self._awaited if station is None else station)
            return station is not None
        known = KnownElevation(self._awaited, elevation, tolerance)
        self._awaited = None
        if self.desk.session.apply(
            self.tr("Add known elevation"), lambda project: edits.add_known_elevation(project, known)
        ):
            self.table.setCurrentIndex(self.model.index(self._known.index(known), 1))
            return True
        self._await(known.station)
        return False

    def _on_add(self) -> None:
        from bobdesk.project import derive

        line = derive.polyline(self.desk.session.project).value
        if line is None:
            self.panel.refuse(self.tr("A line comes first."))
            return
        from bobdesk.plan.polyline_geometry import arc_lengths

        length = float(arc_lengths(line.vertices)[-1])
        station = self.desk.selection.station
        self.begin(length / 2 if station is None else min(max(station, 0.0), length))

    def _on_remove(self) -> None:
        from bobdesk.project import edits

        rows = self.table.selectionModel().selectedRows()
        if rows and rows[0].row() >= len(self._known):
            self._await(None)
        elif rows:
            row = rows[0].row()
            self.desk.session.apply(
                self.tr("Remove known elevation"), lambda project: edits.remove_known_elevation(project, row)
            )

    def _on_load(self) -> None:
        from bobdesk.files.importers.known_elevations import read_known_elevations
        from bobdesk.project import edits

        questions = Questions(self.desk.settings, self)
        filters = self.tr("Tables") + " (*.csv *.tsv *.txt);;" + self.tr("All files") + " (*)"
        path = questions.file_to_open("known elevations", self.tr("Known elevations"), filters)
        questions.deleteLater()
        if path is None:
            return
        try:
            known = read_known_elevations(path)
        except (InputError, OSError) as error:
            self.desk.notices.error(str(error))
            return
        self.desk.session.apply(
            self.tr("Load known elevations"), lambda project: edits.set_known_elevations(project, known)
        )

    def _on_row(self) -> None:
        self.remove_button.setEnabled(bool(self.table.selectionModel().selectedRows()))

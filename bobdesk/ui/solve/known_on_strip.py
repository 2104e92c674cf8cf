"""Known elevations as diamonds on the elevation strip: dragged, and added and removed by its context menu."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QPoint
from PySide6.QtWidgets import QMenu

from bobdesk.project.project import Project
from bobdesk.solve.targets import KnownElevation
from bobdesk.ui.desk import Desk
from bobdesk.ui.icons import icon
from bobdesk.ui.strips.profile_strips import KNOWN
from bobdesk.ui.strips.strip import Strip

if TYPE_CHECKING:
    from bobdesk.ui.strips.strip_stack import StripStack


class KnownOnStrip(QObject):
    """Changes the known elevations of the project; a drag is one step of undo."""

    def __init__(self, desk: Desk, stack: StripStack) -> None:
        super().__init__(stack)
        self._desk = desk
        self._stack = stack
        strip = stack.elevation
        strip.mark_dragged.connect(self._on_dragged)
        strip.mark_dropped.connect(self._on_dropped)
        strip.mark_cancelled.connect(lambda _key: strip.follow())
        stack.add_to_menu(self._fill_menu)
        desk.session.changed.connect(self._on_changed)

    def _on_changed(self, before: Project, after: Project) -> None:
        # The number of the diamond in hand may stand for another one now.
        if before.known_elevations is not after.known_elevations:
            self._stack.elevation.cancel_mark()

    def _on_dragged(self, key: str, index: int, station: float, value: float) -> None:
        marks = self._stack.elevation.marks.get(KNOWN)
        if key != KNOWN or marks is None or not 0 <= index < len(marks.stations):
            return
        stations, values = marks.stations.copy(), marks.values.copy()
        stations[index], values[index] = self._on_line(station), max(value, 0.0)
        self._stack.elevation.set_marks(KNOWN, replace(marks, stations=stations, values=values))

    def _on_dropped(self, key: str, index: int, station: float, value: float) -> None:
        from bobdesk.project import edits

        known = self._desk.session.project.known_elevations
        if key != KNOWN or not 0 <= index < len(known):
            return
        place = self._place(station, value)
        moved = replace(known[index], station=place.station, elevation=place.elevation)
        self._desk.session.apply(
            self.tr("Drag known elevation"), lambda now: edits.change_known_elevation(now, index, moved)
        )

    def _fill_menu(self, menu: QMenu, strip: Strip, at: QPoint) -> None:
        from bobdesk.project import edits

        if strip is not self._stack.elevation or self._stack.axis.length <= 0:
            return
        index = strip.mark_at(KNOWN, at)
        session = self._desk.session
        if index is not None:
            menu.addAction(
                icon("minus"),
                self.tr("Remove this known elevation"),
                lambda: session.apply(
                    self.tr("Remove known elevation"), lambda now: edits.remove_known_elevation(now, index)
                ),
            )
        elif session.project.targets.drop is not None and strip.curves:
            place = self._place(*strip.place_at(at))
            text = self.tr("Add known elevation here: {elevation} at {station}").format(
                elevation=self._desk.quantities.length(place.elevation),
                station=self._desk.quantities.length(strip.place_at(at)[0]),
            )
            menu.addAction(
                icon("plus"),
                text,
                lambda: session.apply(
                    self.tr("Add known elevation"), lambda now: edits.add_known_elevation(now, place)
                ),
            )

    def _place(self, station: float, value: float) -> KnownElevation:
        """Return a known elevation at a place of the strip, to a centimetre; stations of a project have no scale."""
        from bobdesk.project import derive

        factor = derive.plan_factor(self._desk.session.project)
        return KnownElevation(round(self._on_line(station) / factor, 2), round(max(value, 0.0), 2))

    def _on_line(self, station: float) -> float:
        return min(max(station, 0.0), self._stack.axis.length)

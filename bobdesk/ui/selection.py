"""What is selected, and the cursor along the line: one thing across plan, strips and tables; never undone.

A selected boundary selects the two segments beside it; whoever selects other segments deselects it.
"""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QObject, Signal


class Selection(QObject):
    """Selected vertices, segments, boundary, control point and stretch, and the station under the cursor.

    Signals
    -------
    vertices_changed, segments_changed, boundary_changed, control_point_changed, station_changed,
    stretch_changed
        One of them is another one than before.
    """

    vertices_changed = Signal()
    segments_changed = Signal()
    boundary_changed = Signal()
    control_point_changed = Signal()
    station_changed = Signal()
    stretch_changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._vertices: tuple[int, ...] = ()
        self._segments: tuple[int, ...] = ()
        self._boundary: int | None = None
        self._control_point: int | None = None
        self._station: float | None = None
        self._stretch: tuple[float, float] | None = None

    @property
    def vertices(self) -> tuple[int, ...]:
        """Indices of selected vertices of the trace, ascending."""
        return self._vertices

    @vertices.setter
    def vertices(self, indices: Iterable[int]) -> None:
        found = tuple(sorted(set(indices)))
        if found != self._vertices:
            self._vertices = found
            self.vertices_changed.emit()

    @property
    def segments(self) -> tuple[int, ...]:
        """Indices of selected segments, ascending."""
        return self._segments

    @segments.setter
    def segments(self, indices: Iterable[int]) -> None:
        found = tuple(sorted(set(indices)))
        if found != self._segments:
            self._segments = found
            self.segments_changed.emit()
            self.boundary = None

    @property
    def boundary(self) -> int | None:
        """Index of the segment before the selected boundary, which the arrow keys nudge."""
        return self._boundary

    @boundary.setter
    def boundary(self, index: int | None) -> None:
        if index != self._boundary:
            self._boundary = index
            self.boundary_changed.emit()

    def select_boundary(self, index: int) -> None:
        """Select a boundary with the segments at both its sides."""
        self.segments = (index, index + 1)
        self.boundary = index

    @property
    def control_point(self) -> int | None:
        """Index of the selected control point."""
        return self._control_point

    @control_point.setter
    def control_point(self, index: int | None) -> None:
        if index != self._control_point:
            self._control_point = index
            self.control_point_changed.emit()

    @property
    def station(self) -> float | None:
        """Station on the centreline that plan, strips and tables mark together, m."""
        return self._station

    @station.setter
    def station(self, station: float | None) -> None:
        if station != self._station:
            self._station = station
            self.station_changed.emit()

    @property
    def stretch(self) -> tuple[float, float] | None:
        """First and last station of a stretch of the centreline that strips and plan mark together, m."""
        return self._stretch

    @stretch.setter
    def stretch(self, stretch: tuple[float, float] | None) -> None:
        if stretch != self._stretch:
            self._stretch = stretch
            self.stretch_changed.emit()

    def clear(self) -> None:
        """Select nothing."""
        self.vertices = ()
        self.segments = ()
        self.boundary = None
        self.control_point = None
        self.station = None
        self.stretch = None

"""A boundary under the mouse, on the plan or on a strip: previewed, then committed as one step."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject

from bobdesk.alignment import segments as alignment
from bobdesk.project.segment_edits import shortest_by_hand
from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.alignment_now import AlignmentNow, alignment_now
from bobdesk.ui.segments.operations import operations

if TYPE_CHECKING:
    from bobdesk.alignment.segment_figures import SegmentFigures
    from bobdesk.alignment.segments import Segment


class BoundaryDrag(QObject):
    """Holds one boundary at a time."""

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._now: AlignmentNow = alignment_now(desk)
        self._boundary: int | None = None
        self._station = 0.0
        self._crossings = np.empty(0)
        self.snapped = False
        desk.session.changed.connect(self._on_changed)

    @property
    def boundary(self) -> int | None:
        """The boundary that is held."""
        return self._boundary

    @property
    def station(self) -> float:
        """Where the held boundary is now, m."""
        return self._station

    def boundary_at(self, station: float, reach: float) -> int | None:
        """Return the boundary nearest to a station, if it is within `reach` metres."""
        ends = np.array([segment.end for segment in self._now.segments[:-1]])
        if not len(ends):
            return None
        nearest = int(np.abs(ends - station).argmin())
        return nearest if abs(ends[nearest] - station) <= reach else None

    def hold(self, boundary: int) -> bool:
        """Take hold of a boundary and select it; return whether it can be moved, and say so if not."""
        known = self._now.known
        if known is None or not self._now.is_current or not 0 <= boundary < len(known.segments) - 1:
            return False
        operations(self._desk).select_boundary(boundary)
        if operations(self._desk).refuse_locked(boundary):
            return False
        self._boundary, self._station = boundary, known.segments[boundary].end
        self._crossings = known.crossings()
        self.snapped = False
        return True

    def drag(self, station: float, *, snap: float) -> None:
        """Preview the boundary at a station; within `snap` metres of a crossing of the threshold it stops there."""
        known = self._now.known
        if self._boundary is None or known is None:
            return
        self.snapped = False
        if snap > 0 and len(self._crossings):
            nearest = float(self._crossings[np.abs(self._crossings - station).argmin()])
            if abs(nearest - station) <= snap:
                station, self.snapped = nearest, True
        shortest = shortest_by_hand(self._desk.session.project)
        moved = alignment.move_boundary(known.segments, self._boundary, station, shortest=shortest)
        self._station = moved[self._boundary].end
        # Where there is no room for the crossing itself, the boundary stands before it.
        self.snapped = self.snapped and self._station == station
        self._now.preview(moved)

    def drop(self) -> None:
        """Keep the boundary where it is: one step of undo."""
        boundary, self._boundary = self._boundary, None
        if boundary is None:
            return
        station = self._station
        self._now.preview(None)
        operations(self._desk).move_boundary(boundary, station)

    def cancel(self) -> bool:
        """Put the boundary back; return whether one was held."""
        if self._boundary is None:
            return False
        self._boundary = None
        self._now.preview(None)
        return True

    def _on_changed(self) -> None:
        """Let go: after another edit, or an undo, the same number may stand for another boundary."""
        self.cancel()

    def sides(self) -> tuple[tuple[Segment, SegmentFigures], ...]:
        """Return the two segments beside the held boundary with their figures."""
        if self._boundary is None:
            return ()
        pair = slice(self._boundary, self._boundary + 2)
        return tuple(zip(self._now.segments[pair], self._now.figures[pair], strict=True))

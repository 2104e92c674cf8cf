"""The designer's list that segments are compared against; it is looked at, and is no part of the project."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PySide6.QtCore import QObject, Signal

from bobdesk.alignment.segments import Segment, Segments
from bobdesk.errors import InputError
from bobdesk.files.importers.design_list import DesignCurve, DesignList, read_design_list
from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.alignment_now import alignment_now

_GRID = 0.5
_FARTHEST = 200


@dataclass(frozen=True)
class DesignPair:
    """A curve of the list beside the segment that it overlaps most, if there is one."""

    curve: DesignCurve
    index: int | None
    segment: Segment | None
    radius: float | None
    side: str


class Design(QObject):
    """Holds the list, and where its station 0 lies on the line.

    Signals
    -------
    changed
        Another list, another offset, or other segments.
    """

    changed = Signal()

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._now = alignment_now(desk)
        self._list: DesignList | None = None
        self._offset = 0.0
        self._now.changed.connect(self._on_now)
        desk.session.document_changed.connect(self.close)

    @property
    def list(self) -> DesignList | None:
        """The list, or None."""
        return self._list

    @property
    def offset(self) -> float:
        """Station of the line at which the list's station 0 lies, m."""
        return self._offset

    @offset.setter
    def offset(self, value: float) -> None:
        if value != self._offset:
            self._offset = value
            self.changed.emit()

    def read(self, path: Path) -> bool:
        """Take a list from a file; return whether that worked, and say so if not."""
        try:
            self._list = read_design_list(path)
        except InputError as error:
            self._desk.notices.error(str(error))
            return False
        self._offset = best_offset(self._list, self._now.segments)
        self.changed.emit()
        return True

    def close(self) -> None:
        """Compare with nothing."""
        if self._list is not None:
            self._list, self._offset = None, 0.0
            self.changed.emit()

    def pairs(self) -> tuple[DesignPair, ...]:
        """Return every curve of the list with the segment that it overlaps most."""
        if self._list is None:
            return ()
        segments, figures = self._now.segments, self._now.figures
        found = []
        for curve in self._list.curves:
            start, end = curve.start + self._offset, curve.end + self._offset
            shared = [min(one.end, end) - max(one.start, start) if one.kind == "curve" else 0.0 for one in segments]
            best = max(range(len(shared)), key=shared.__getitem__, default=None)
            if best is None or shared[best] <= 0:
                found.append(DesignPair(curve, None, None, None, ""))
                continue
            side = "left" if figures[best].turn >= 0 else "right"
            found.append(DesignPair(curve, best, segments[best], figures[best].radius, side))
        return tuple(found)

    def _on_now(self) -> None:
        if self._list is not None:
            self.changed.emit()


def best_offset(design: DesignList, segments: Segments) -> float:
    """Return the offset at which curves of the list lie best over curves of ours, m, to half a metre.

    Designers count from the timing start, which lies some 20 m behind the start of the line.
    """
    if not segments:
        return 0.0
    length = max(segments[-1].end, design.curves[-1].end)
    stations = np.arange(0.0, length, _GRID)
    ours, theirs = np.full(len(stations), -1.0), np.full(len(stations), -1.0)
    for segment in segments:
        if segment.kind == "curve":
            ours[(stations >= segment.start) & (stations < segment.end)] = 1.0
    for curve in design.curves:
        theirs[(stations >= curve.start) & (stations < curve.end)] = 1.0
    shifts = np.arange(-_FARTHEST, _FARTHEST + 1)
    count = len(stations)
    agree = [
        float(ours[max(s, 0) : count + min(s, 0)] @ theirs[max(-s, 0) : count + min(-s, 0)]) for s in shifts.tolist()
    ]
    return float(shifts[int(np.argmax(agree))] * _GRID) if count > _FARTHEST else 0.0


def design_of(desk: Desk) -> Design:
    """Return the one list of a window."""
    name = "design"
    found = desk.session.findChild(Design, name)
    if found is None:
        found = Design(desk, desk.session)
        found.setObjectName(name)
    return found

"""The designer's list that segments are compared against."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from bobdesk.alignment.design import DesignCurve, DesignList, best_offset
from bobdesk.alignment.segments import Segment
from bobdesk.errors import InputError
from bobdesk.files.importers.design_list import read_design_list
from bobdesk.project import edits
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.alignment_now import alignment_now


@dataclass(frozen=True)
class DesignPair:
    """A curve of the list beside the segment that it overlaps most, if there is one."""

    curve: DesignCurve
    index: int | None
    segment: Segment | None
    radius: float | None
    side: str


class Design(QObject):
    """Follows the list of the document; every change of it is a step of undo.

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
        self._now.changed.connect(self._on_now)
        desk.session.changed.connect(self._on_changed)

    @property
    def list(self) -> DesignList | None:
        """The list, or None."""
        return self._desk.session.project.design

    @property
    def offset(self) -> float:
        """Station of the line at which the list's station 0 lies, m."""
        return 0.0 if self.list is None else self.list.offset

    @offset.setter
    def offset(self, value: float) -> None:
        self._desk.session.apply(
            self.tr("Move design"), lambda project: edits.move_design(project, value), key="move design"
        )

    def read(self, path: Path) -> bool:
        """Take a list from a file; return whether that worked, and say so if not."""
        try:
            found = read_design_list(path)
        except InputError as error:
            self._desk.notices.error(str(error))
            return False
        found = replace(found, offset=best_offset(found, self._now.segments))
        return self._desk.session.apply(
            self.tr("Compare with a design"), lambda project: edits.compare_with_design(project, found)
        )

    def close(self) -> None:
        """Compare with nothing."""
        self._desk.session.apply(self.tr("Stop comparing"), edits.compare_with_no_design)

    def pairs(self) -> tuple[DesignPair, ...]:
        """Return every curve of the list with the segment that it overlaps most."""
        design = self.list
        if design is None:
            return ()
        segments, figures = self._now.segments, self._now.figures
        found = []
        for curve in design.curves:
            start, end = curve.start + design.offset, curve.end + design.offset
            shared = [min(one.end, end) - max(one.start, start) if one.kind == "curve" else 0.0 for one in segments]
            best = max(range(len(shared)), key=shared.__getitem__, default=None)
            if best is None or shared[best] <= 0:
                found.append(DesignPair(curve, None, None, None, ""))
                continue
            side = "left" if figures[best].turn >= 0 else "right"
            found.append(DesignPair(curve, best, segments[best], figures[best].radius, side))
        return tuple(found)

    def _on_now(self) -> None:
        if self.list is not None:
            self.changed.emit()

    def _on_changed(self, before: Project, after: Project) -> None:
        if before.design is not after.design:
            self.changed.emit()


def design_of(desk: Desk) -> Design:
    """Return the one list of a window."""
    name = "design"
    found = desk.session.findChild(Design, name)
    if found is None:
        found = Design(desk, desk.session)
        found.setObjectName(name)
    return found

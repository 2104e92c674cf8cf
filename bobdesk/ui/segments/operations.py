"""What can be done to segments by hand: keys, menus, buttons and the mouse all come here."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject

from bobdesk.alignment.segments import Segments, boundary_range, segment_at
from bobdesk.project import segment_edits
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.notices import Remedy
from bobdesk.ui.segments.alignment_now import alignment_now

_AT_A_BOUNDARY = 1e-6


class SegmentOperations(QObject):
    """Acts on what is selected, or else on the segment at the cursor; what is not possible is said."""

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._now = alignment_now(desk)
        self._selected_of = self._segments
        self._now.changed.connect(self._keep_selection)

    @property
    def _segments(self) -> Segments:
        """Those of the document: what is previewed has other numbers, and an edit would hit another segment."""
        known = self._now.known
        return () if known is None else known.segments

    @property
    def is_possible(self) -> bool:
        """Whether there are segments."""
        return bool(self._segments)

    def chosen(self) -> tuple[int, ...]:
        """Return the selected segments, or else the one at the cursor."""
        selection, count = self._desk.selection, len(self._segments)
        found = tuple(index for index in selection.segments if index < count)
        if not found and selection.station is not None and count:
            return (segment_at(self._segments, selection.station),)
        return found

    def boundary(self) -> int | None:
        """Return the selected boundary, or else the one nearest to the cursor."""
        selection, segments = self._desk.selection, self._segments
        if selection.boundary is not None and selection.boundary < len(segments) - 1:
            return selection.boundary
        station = selection.station
        if station is None or len(segments) < 2:
            return None
        return min(range(len(segments) - 1), key=lambda index: abs(segments[index].end - station))

    def select(self, index: int, *, station: float | None = None, add: bool = False) -> None:
        """Select a segment; with `add` all from the selected ones to it."""
        selection = self._desk.selection
        if add and selection.segments:
            first, last = min(index, selection.segments[0]), max(index, selection.segments[-1])
            selection.segments = range(first, last + 1)
        else:
            selection.segments = (index,)
        selection.boundary = None
        if station is not None:
            selection.station = station

    def select_boundary(self, boundary: int) -> None:
        """Select a boundary: both segments at it are selected with it, and the cursor goes there."""
        self._desk.selection.select_boundary(boundary)
        self._desk.selection.station = self._segments[boundary].end

    def select_nothing(self) -> bool:
        """Deselect segments and boundary; return whether any were selected."""
        selection = self._desk.selection
        had = selection.boundary is not None or bool(selection.segments)
        selection.boundary, selection.segments = None, ()
        return had

    def select_next(self, by: int) -> None:
        """Go to a following segment (`by` 1) or one before (-1)."""
        segments = self._segments
        if not segments:
            self._say_none()
            return
        chosen = self.chosen()
        at = (chosen[-1] if by > 0 else chosen[0]) + by if chosen else (0 if by > 0 else len(segments) - 1)
        at = min(max(at, 0), len(segments) - 1)
        self.select(at, station=0.5 * (segments[at].start + segments[at].end))

    def split(self) -> None:
        """Cut the segment at the cursor; the new boundary is selected."""
        station = self._desk.selection.station
        if not self.ready():
            return
        if station is None:
            self._desk.notices.refuse(self.tr("Click on a strip or on the line first: the segment is split there."))
            return
        index = segment_at(self._segments, station)
        if any(abs(one.end - station) < _AT_A_BOUNDARY for one in self._segments[:-1]):
            self._desk.notices.refuse(
                self.tr("There is a boundary here already; click inside a segment, and X splits it there.")
            )
            return
        if self.apply(self.tr("Split segment"), lambda project: segment_edits.split_segment(project, station)):
            self.select(index + 1)
            self._desk.selection.boundary = index

    def merge(self) -> None:
        """Make one of the selected neighbours, or of the selected segment and its nearer neighbour."""
        if not self.ready() or self._say_one():
            return
        chosen = self.chosen()
        if not chosen:
            self._say_select()
            return
        if chosen[-1] - chosen[0] + 1 != len(chosen):
            self._desk.notices.refuse(self.tr("Only neighbours can be merged; select segments that follow each other."))
            return
        first, last = (chosen[0], chosen[-1]) if len(chosen) > 1 else self._with_neighbour(chosen[0])
        if self.apply(self.tr("Merge segments"), lambda project: segment_edits.merge_segments(project, first, last)):
            self.select(first)

    def flip(self) -> None:
        """Turn straights into curves and curves into straights."""
        chosen = self._chosen_or_say()
        if chosen:
            self.apply(self.tr("Flip kind"), lambda project: segment_edits.flip_segments(project, chosen))

    def lock(self) -> None:
        """Lock the selected segments; unlock them if all of them are locked."""
        chosen = self._chosen_or_say()
        if chosen:
            locked = not self.all_locked(chosen)
            label = self.tr("Lock segment") if locked else self.tr("Unlock segment")
            self.apply(label, lambda project: segment_edits.lock_segments(project, chosen, locked=locked))

    def all_locked(self, indices: tuple[int, ...]) -> bool:
        """Return whether each of some segments is locked."""
        segments = self._segments
        return bool(indices) and all(segments[index].locked for index in indices)

    def set_locked(self, index: int, *, locked: bool) -> bool:
        """Lock or unlock one segment."""
        label = self.tr("Lock segment") if locked else self.tr("Unlock segment")
        return self.apply(label, lambda project: segment_edits.lock_segment(project, index, locked=locked))

    def delete_boundary(self) -> None:
        """Merge the two segments at the selected boundary, or at the one nearest to the cursor."""
        if not self.ready():
            return
        if self._say_one():
            return
        boundary = self.boundary()
        if boundary is None:
            self._desk.notices.refuse(self.tr("Select a boundary first: click its handle on the plan or on a strip."))
            return
        if self.apply(self.tr("Delete boundary"), lambda project: segment_edits.delete_boundary(project, boundary)):
            self.select(boundary)

    def move_boundary(self, boundary: int, station: float, *, key: str | None = None) -> bool:
        """Move a boundary; it stops where a segment would become too short. The cursor goes with a selected one."""
        moved = self.apply(
            self.tr("Move boundary"),
            lambda project: segment_edits.move_boundary(project, boundary, station),
            key=key,
        )
        if moved and self._desk.selection.boundary == boundary:
            self._desk.selection.station = self._segments[boundary].end
        return moved

    def boundary_range(self, boundary: int) -> tuple[float, float]:
        """Return the first and the last station that a boundary can have, m."""
        shortest = segment_edits.shortest_by_hand(self._desk.session.project)
        return boundary_range(self._segments, boundary, shortest=shortest)

    def put_boundary(self, boundary: int, station: float, typed: str) -> bool:
        """Move a boundary to where somebody has typed it; where there is no room for that, say so with numbers."""
        if not self.ready():
            return False
        first, last = self.boundary_range(boundary)
        moved = self.move_boundary(boundary, station)
        if moved and not first - _AT_A_BOUNDARY <= station <= last + _AT_A_BOUNDARY:
            unit = self._desk.quantities
            text = self.tr(
                "{typed} is out of range: the boundary between segments {before} and {behind} can lie from {first} to"
                " {last}, for no segment may be shorter than {shortest}; it is at {now} now."
            )
            self._desk.notices.warn(
                text.format(
                    typed=typed.strip(),
                    before=boundary + 1,
                    behind=boundary + 2,
                    first=unit.length(first, unit=False),
                    last=unit.length(last),
                    shortest=unit.length(segment_edits.shortest_by_hand(self._desk.session.project)),
                    now=unit.length(self._segments[boundary].end),
                )
            )
        return moved

    def nudge(self, by: float) -> bool:
        """Move the selected boundary on by so many metres; presses in a row are one step."""
        boundary, segments = self._desk.selection.boundary, self._segments
        if boundary is None or boundary >= len(segments) - 1:
            return False
        if not self.refuse_locked(boundary):
            before = segments[boundary].end
            moved = self.move_boundary(boundary, before + by, key=f"nudge boundary {boundary}")
            if moved and self._segments[boundary].end == before:
                shortest = segment_edits.shortest_by_hand(self._desk.session.project)
                self._desk.notices.refuse(
                    self.tr(
                        "The boundary can go no further: segment {number} would be shorter than {shortest}."
                    ).format(number=boundary + (2 if by > 0 else 1), shortest=self._desk.quantities.length(shortest))
                )
        return True

    def flip_one(self, index: int) -> bool:
        """Turn one segment into the other kind."""
        return self.apply(self.tr("Flip kind"), lambda project: segment_edits.flip_segment(project, index))

    def rename(self, index: int, name: str) -> bool:
        """Give a segment a name."""
        return self.apply(self.tr("Name segment"), lambda project: segment_edits.name_segment(project, index, name))

    def number_curves(self) -> None:
        """Number the curves from the start."""
        if self.ready():
            before = self._desk.session.project
            self.apply(self.tr("Number curves"), segment_edits.number_curves)
            if self._desk.session.project is before:
                self._desk.notices.refuse(self.tr("The curves are numbered already; names of your own stay."))

    def take(self, segments: Segments, label: str) -> bool:
        """Take all segments from a file."""
        self.select_nothing()
        return self.apply(label, lambda project: segment_edits.set_segments(project, segments))

    def refuse_locked(self, boundary: int) -> bool:
        """Say so if a segment beside a boundary is locked; return whether one is."""
        segments = self._segments
        locked = [index for index in (boundary, boundary + 1) if segments[index].locked]
        if locked:
            self._desk.notices.refuse(
                self.tr("Segment {number} is locked, so this boundary stays; unlock it first (L).").format(
                    number=locked[0] + 1
                ),
                Remedy(self.tr("Unlock it"), lambda: self.set_locked(locked[0], locked=False)),
            )
        return bool(locked)

    def apply(self, label: str, edit: Callable[[Project], Project], *, key: str | None = None) -> bool:
        """Do an edit if there are segments; return whether it could be done."""
        return self.ready() and self._desk.session.apply(label, edit, key=key)

    def ready(self) -> bool:
        """Return whether there are segments and none are being found, and say so if not."""
        if not self._now.is_current:
            self._desk.notices.refuse(self.tr("The segments are still being worked out; try again in a moment."))
            return False
        if not self._segments:
            self._say_none()
            return False
        return True

    def _say_none(self) -> None:
        self._desk.notices.refuse(self._now.problem or self.tr("There are no segments yet: a line comes first."))

    def _say_one(self) -> bool:
        """Return whether there is one segment only, and say so."""
        if len(self._segments) == 1:
            self._desk.notices.refuse(
                self.tr("The whole line is one segment, so there is nothing to merge; X splits it at the cursor.")
            )
        return len(self._segments) == 1

    def _say_select(self) -> None:
        self._desk.notices.refuse(self.tr("Select a segment first: click it on the plan, on a strip or in the table."))

    def _chosen_or_say(self) -> tuple[int, ...]:
        if not self.ready():
            return ()
        chosen = self.chosen()
        if not chosen:
            self._say_select()
        return chosen

    def _with_neighbour(self, index: int) -> tuple[int, int]:
        segments, station = self._segments, self._desk.selection.station
        segment = segments[index]
        before = index == len(segments) - 1
        if index and station is not None and segment.start <= station < segment.end:
            before = before or station < 0.5 * (segment.start + segment.end)
        return (max(index - 1, 0), index) if before else (index, index + 1)

    def _keep_selection(self) -> None:
        """Let the selection stay where it is on the line, though the numbers of its segments may be others."""
        if self._now.is_preview or not self._now.is_current:
            return
        before, after = self._selected_of, self._segments
        self._selected_of = after
        selection = self._desk.selection
        if len(before) == len(after) or not before or not after:
            return
        boundary = selection.boundary
        middles = [0.5 * (before[at].start + before[at].end) for at in selection.segments if at < len(before)]
        selection.segments = [segment_at(after, middle) for middle in middles if middle < after[-1].end]
        if boundary is None:
            return
        station = before[boundary].end if boundary < len(before) else None
        stayed = (index for index, one in enumerate(after[:-1]) if one.end == station)
        selection.boundary = next(stayed, None)


def operations(desk: Desk) -> SegmentOperations:
    """Return the one set of operations that all parts of a window share."""
    name = "segment operations"
    found = desk.session.findChild(SegmentOperations, name)
    if found is None:
        found = SegmentOperations(desk, desk.session)
        found.setObjectName(name)
    return found

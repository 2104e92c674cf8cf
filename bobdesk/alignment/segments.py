"""Segments of an alignment, and what a user does to them: every edit is a pure function."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from bobdesk.errors import InputError

Kind = Literal["straight", "curve"]
Segments = tuple["Segment", ...]
SHORTEST = 3.0
_ROUNDED = 2e-3
_SAME_STATION = 1e-6
_CURVE_NUMBER = re.compile(r"^\d+(?:\s+|$)")


@dataclass(frozen=True)
class Segment:
    """One straight or curved section of the alignment.

    Attributes
    ----------
    kind
        "straight" or "curve".
    start, end
        Stations, m.
    locked
        Detecting again leaves it as it is.
    name
        Curve number or name, as the track has it; may be empty.
    by_hand
        Somebody has set its kind or its boundaries; detecting again leaves it too, editing does not.
    """

    kind: Kind
    start: float
    end: float
    locked: bool = False
    name: str = ""
    by_hand: bool = False

    @property
    def length(self) -> float:
        """Length in plan, m."""
        return self.end - self.start


def check_segments(segments: Sequence[Segment], *, length: float) -> Segments:
    """Return the segments if they cover the line from 0 to `length` in order, without gap or overlap.

    Raises
    ------
    InputError
        If they do not; the sentence names the first segment at fault.
    """
    if not segments:
        raise InputError("there are no segments in it")
    expected = 0.0
    for number, segment in enumerate(segments, 1):
        if segment.kind not in ("straight", "curve"):
            raise InputError(f"segment {number} is of the kind '{segment.kind}'; it must be straight or curve")
        if not abs(segment.start - expected) <= _SAME_STATION:
            fault = "overlaps the one before" if segment.start < expected else "leaves a gap to the one before"
            raise InputError(f"segment {number} {fault}: it begins at {segment.start:.3f} m, not {expected:.3f} m")
        if not segment.end > segment.start:
            raise InputError(
                f"segment {number} begins at {segment.start:.3f} m and ends at {segment.end:.3f} m;"
                " it must end farther on"
            )
        expected = segment.end
    if not abs(expected - length) <= max(_SAME_STATION, 1e-9 * length):
        raise InputError(f"the segments end at {expected:.3f} m, but the line is {length:.3f} m long")
    return tuple(segments)


def stretched(segments: Segments, length: float) -> Segments:
    """Return the segments brought in proportion to a line of `length`, m."""
    factor = length / segments[-1].end
    if factor == 1.0:
        return segments
    edges = [0.0, *(factor * segment.end for segment in segments[:-1]), length]
    return tuple(
        replace(segment, start=start, end=end)
        for segment, start, end in zip(segments, edges[:-1], edges[1:], strict=True)
    )


def segment_at(segments: Segments, station: float) -> int:
    """Return the index of the segment that a station lies in; a boundary belongs to the later one."""
    for index, segment in enumerate(segments):
        if station < segment.end:
            return index
    return len(segments) - 1


def in_words(segments: Sequence[Segment]) -> str:
    """Return how many segments and curves there are: "17 segments, 8 of them curves"."""
    curves = sum(segment.kind == "curve" for segment in segments)
    if len(segments) == 1:
        return f"1 segment, a {segments[0].kind}"
    of_them = {0: "none of them a curve", 1: "1 of them a curve", len(segments): "all of them curves"}
    return f"{len(segments)} segments, {of_them.get(curves, f'{curves} of them curves')}"


def split(segments: Segments, station: float, *, shortest: float = SHORTEST) -> Segments:
    """Cut the segment at a station into two of the same kind."""
    _refuse_no_number(station)
    index = segment_at(segments, station)
    segment = segments[index]
    _refuse_locked(segment, index, "split")
    if min(station - segment.start, segment.end - station) < shortest:
        raise InputError(f"a cut at {station:g} m would leave a segment shorter than {shortest:g} m; cut farther away")
    parts = (
        replace(segment, end=station, by_hand=True),
        replace(segment, start=station, name="", by_hand=True),
    )
    return segments[:index] + parts + segments[index + 1 :]


def merge(segments: Segments, first: int, last: int) -> Segments:
    """Make one segment of those from `first` to `last`; it takes kind and name of the longest."""
    if not 0 <= first < last < len(segments):
        raise InputError("two or more neighbouring segments are needed to merge")
    chosen = segments[first : last + 1]
    for index, segment in enumerate(chosen, first):
        _refuse_locked(segment, index, "merged")
    longest = max(chosen, key=lambda segment: segment.length)
    merged = replace(longest, start=chosen[0].start, end=chosen[-1].end, by_hand=True)
    return (*segments[:first], merged, *segments[last + 1 :])


def move_boundary(segments: Segments, boundary: int, station: float, *, shortest: float = SHORTEST) -> Segments:
    """Move the boundary between segments `boundary` and `boundary + 1` to a station.

    It stops `shortest` before the next boundary on either side, so that no segment vanishes.
    """
    if not 0 <= boundary < len(segments) - 1:
        raise InputError("the ends of the line are not boundaries between segments")
    _refuse_no_number(station)
    before, after = segments[boundary], segments[boundary + 1]
    _refuse_locked(before, boundary, "moved")
    _refuse_locked(after, boundary + 1, "moved")
    first, last = boundary_range(segments, boundary, shortest=shortest)
    station = min(max(station, first), last)
    if station == before.end:
        return segments
    pair = (replace(before, end=station, by_hand=True), replace(after, start=station, by_hand=True))
    return segments[:boundary] + pair + segments[boundary + 2 :]


def boundary_range(segments: Segments, boundary: int, *, shortest: float = SHORTEST) -> tuple[float, float]:
    """Return the first and the last station that a boundary can have; a segment that is too short grows only."""
    before, after = segments[boundary], segments[boundary + 1]
    room = min(shortest, before.length, after.length)
    return before.start + room, after.end - room


def flip_kind(segments: Segments, index: int) -> Segments:
    """Turn a straight into a curve, or a curve into a straight."""
    _refuse_locked(segments[index], index, "changed")
    kind: Kind = "curve" if segments[index].kind == "straight" else "straight"
    return _with(segments, index, replace(segments[index], kind=kind, by_hand=True))


def set_locked(segments: Segments, index: int, *, locked: bool) -> Segments:
    """Lock a segment against detecting again and against edits, or unlock it."""
    return _with(segments, index, replace(segments[index], locked=locked))


def rename(segments: Segments, index: int, name: str) -> Segments:
    """Give a segment a name, or take it away with an empty one."""
    return _with(segments, index, replace(segments[index], name=" ".join(name.split())))


def number_curves(segments: Segments) -> Segments:
    """Number the curves from the start, as tracks have them; straights lose a number, free names stay.

    A curve with a free name ("Kreisel") counts but keeps its name alone; "7 Kreisel" becomes "9 Kreisel"
    where it is the ninth.
    """
    numbered = []
    count = 0
    for segment in segments:
        free = _CURVE_NUMBER.sub("", segment.name)
        had_number = free != segment.name
        if segment.kind == "straight":
            numbered.append(segment if not had_number else replace(segment, name=free))
            continue
        count += 1
        name = f"{count} {free}".strip() if had_number or not free else free
        numbered.append(segment if name == segment.name else replace(segment, name=name))
    return tuple(numbered)


def is_kept(segment: Segment) -> bool:
    """Return whether detecting again leaves a segment as it is."""
    return segment.locked or segment.by_hand


def keep_corrections(detected: Segments, previous: Segments, *, shortest: float = SHORTEST) -> Segments:
    """Return the detected segments with the locked and hand-made ones of `previous` laid over them.

    What remains of a detected segment beside one that is kept, and is shorter than `shortest`, joins a
    neighbour: a detected one, or else a hand-made one; between two locked ones it stays. Names go to
    the detected segment of the same kind that lies where the named one lay.
    """
    result = list(detected)
    for kept in previous:
        if is_kept(kept):
            result = [part for segment in result for part in _without(segment, kept)]
            result.append(kept)
            result.sort(key=lambda segment: segment.start)
    return _with_names(_join_slivers(result, shortest), previous)


def keep_locked(segments: Segments, previous: Segments) -> Segments:
    """Return segments with the names and locks of those in `previous` that are locked.

    Raises
    ------
    InputError
        If a locked one is not among them, to a few millimetres.
    """
    result = list(segments)
    for index, locked in enumerate(previous):
        if not locked.locked:
            continue
        same = [
            place
            for place, one in enumerate(result)
            if one.kind == locked.kind and max(abs(one.start - locked.start), abs(one.end - locked.end)) <= _ROUNDED
        ]
        if not same:
            raise InputError(f"segment {index + 1} is locked, and the file has it otherwise; unlock it first")
        result[same[0]] = replace(result[same[0]], locked=True, name=result[same[0]].name or locked.name)
    return tuple(result)


def join_short(segments: Segments, *, shortest: float = SHORTEST) -> Segments:
    """Return segments of which each that is shorter than `shortest` has joined its longer neighbour."""
    return _join_slivers(list(segments), shortest)


def _without(segment: Segment, kept: Segment) -> list[Segment]:
    """Return the parts of a segment that lie outside one that is kept."""
    if is_kept(segment) or segment.end <= kept.start or segment.start >= kept.end:
        return [segment]
    parts = [
        replace(segment, end=min(segment.end, kept.start)),
        replace(segment, start=max(segment.start, kept.end)),
    ]
    return [part for part in parts if part.length > _SAME_STATION]


def _join_slivers(segments: list[Segment], shortest: float) -> Segments:
    index = 0
    while index < len(segments):
        segment = segments[index]
        around = [i for i in (index - 1, index + 1) if 0 <= i < len(segments) and not segments[i].locked]
        free = [i for i in around if not segments[i].by_hand] or around
        if is_kept(segment) or segment.length >= shortest or not free:
            index += 1
            continue
        other = max(free, key=lambda i: segments[i].length)
        segments[other] = replace(
            segments[other],
            start=min(segments[other].start, segment.start),
            end=max(segments[other].end, segment.end),
        )
        del segments[index]
        index = max(index - 1, 0)
    return tuple(segments)


def _with_names(segments: Segments, previous: Segments) -> Segments:
    result = list(segments)
    for named in previous:
        if not named.name or is_kept(named):
            continue
        shared = [min(one.end, named.end) - max(one.start, named.start) for one in result]
        best = max(range(len(result)), key=shared.__getitem__)
        one = result[best]
        if one.kind == named.kind and not one.name and 2 * shared[best] > named.length:
            result[best] = replace(one, name=named.name)
    return tuple(result)


def _with(segments: Segments, index: int, segment: Segment) -> Segments:
    return (*segments[:index], segment, *segments[index + 1 :])


def _refuse_no_number(station: float) -> None:
    if not math.isfinite(station):
        raise InputError("a boundary needs a station, a number of metres")


def _refuse_locked(segment: Segment, index: int, verb: str) -> None:
    if segment.locked:
        raise InputError(f"segment {index + 1} is locked; unlock it before it is {verb}")

"""What a user does to segments; the first of these by hand ends their being found automatically."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from bobdesk.alignment import segments as alignment
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segments, check_segments
from bobdesk.errors import InputError
from bobdesk.project import derive
from bobdesk.project.project import Project

SHORTEST_BY_HAND = 1.0


def shortest_by_hand(project: Project) -> float:
    """Return how short a segment may be made by hand, m: the shortest of the settings, and 1 m at least."""
    return max(SHORTEST_BY_HAND, project.segmentation.shortest)


def split_segment(project: Project, station: float) -> Project:
    """Cut the segment at a station in two."""
    shortest = shortest_by_hand(project)
    return replace(project, segments=alignment.split(_segments(project), float(station), shortest=shortest))


def merge_segments(project: Project, first: int, last: int) -> Project:
    """Make one segment of those from `first` to `last`."""
    return replace(project, segments=alignment.merge(_segments(project), first, last))


def delete_boundary(project: Project, boundary: int) -> Project:
    """Make one segment of the two at the boundary behind the segment `boundary`."""
    if not 0 <= boundary < len(_segments(project)) - 1:
        raise InputError("the ends of the line are not boundaries between segments")
    return merge_segments(project, boundary, boundary + 1)


def move_boundary(project: Project, boundary: int, station: float) -> Project:
    """Move the boundary behind the segment `boundary` to a station."""
    shortest = shortest_by_hand(project)
    found = _segments(project)
    moved = alignment.move_boundary(found, boundary, float(station), shortest=shortest)
    return project if moved is found else replace(project, segments=moved)


def flip_segment(project: Project, index: int) -> Project:
    """Turn a straight into a curve or a curve into a straight."""
    return replace(project, segments=alignment.flip_kind(_with_index(project, index), index))


def flip_segments(project: Project, indices: Sequence[int]) -> Project:
    """Turn each of several segments into the other kind."""
    for index in indices:
        project = flip_segment(project, index)
    return project


def lock_segment(project: Project, index: int, *, locked: bool = True) -> Project:
    """Keep a segment as it is when segments are detected again, or let it go."""
    return replace(project, segments=alignment.set_locked(_with_index(project, index), index, locked=locked))


def lock_segments(project: Project, indices: Sequence[int], *, locked: bool = True) -> Project:
    """Lock or unlock several segments."""
    for index in indices:
        project = lock_segment(project, index, locked=locked)
    return project


def name_segment(project: Project, index: int, name: str) -> Project:
    """Give a segment the name or number that its curve has."""
    found = _with_index(project, index)
    named = alignment.rename(found, index, name)
    return project if named == found else replace(project, segments=named)


def number_curves(project: Project) -> Project:
    """Number the curves from the start, as tracks have them."""
    found = _segments(project)
    numbered = alignment.number_curves(found)
    return project if numbered == found else replace(project, segments=numbered)


def detect_again(project: Project) -> Project:
    """Find the segments anew; locked and hand-made ones stay, and without any they are automatic again."""
    if project.segments is None:
        return project
    previous = _segments(project)
    if not any(alignment.is_kept(segment) or segment.name for segment in previous):
        return use_automatic_segments(project)
    from bobdesk.alignment.segmentation import detect_segments  # here, for it needs scipy

    line = derive.centreline(project).needed()
    found = detect_segments(line, project.segmentation, previous=previous)
    return project if found == project.segments else replace(project, segments=found)


def use_automatic_segments(project: Project) -> Project:
    """Give up all work by hand on segments."""
    return project if project.segments is None else replace(project, segments=None)


def set_segmentation(project: Project, settings: SegmentationSettings) -> Project:
    """Change threshold, wanted number, shortest segment or rule, and detect with them; corrections stay."""
    numbers = (settings.threshold or 0.0, settings.change_cost, settings.shortest)
    if not all(math.isfinite(number) for number in numbers):
        raise InputError("a setting of the segmentation is not a number")
    if settings == project.segmentation:
        return project
    return detect_again(replace(project, segmentation=settings))


def set_segments(project: Project, segments: Segments) -> Project:
    """Take all segments from a file; they count as made by hand.

    Those that are shorter than a segment may be made by hand join their longer neighbour. What is locked must be
    among them as it is.
    """
    line = derive.centreline(project).needed()
    checked = alignment.keep_locked(check_segments(segments, length=line.length), project.segments or ())
    loose = tuple(replace(segment, by_hand=False) for segment in checked)
    checked = alignment.join_short(loose, shortest=shortest_by_hand(project))
    return replace(project, segments=tuple(replace(segment, by_hand=True) for segment in checked))


def _segments(project: Project) -> Segments:
    return derive.segments(project).needed()


def _with_index(project: Project, index: int) -> Segments:
    segments = _segments(project)
    if not 0 <= index < len(segments):
        raise InputError(f"there is no segment {index + 1}")
    return segments

"""What a user does to segments; the first of these by hand ends their being found automatically."""

from __future__ import annotations

import math
from dataclasses import replace

from bobdesk.alignment import segments as alignment
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segments, check_segments
from bobdesk.errors import InputError
from bobdesk.project import derive
from bobdesk.project.project import Project


def split_segment(project: Project, station: float) -> Project:
    """Cut the segment at a station in two."""
    return replace(project, segments=alignment.split(_segments(project), float(station)))


def merge_segments(project: Project, first: int, last: int) -> Project:
    """Make one segment of those from `first` to `last`."""
    return replace(project, segments=alignment.merge(_segments(project), first, last))


def move_boundary(project: Project, boundary: int, station: float) -> Project:
    """Move the boundary behind the segment `boundary` to a station."""
    return replace(project, segments=alignment.move_boundary(_segments(project), boundary, float(station)))


def flip_segment(project: Project, index: int) -> Project:
    """Turn a straight into a curve or a curve into a straight."""
    return replace(project, segments=alignment.flip_kind(_with_index(project, index), index))


def lock_segment(project: Project, index: int, *, locked: bool = True) -> Project:
    """Keep a segment as it is when segments are detected again, or let it go."""
    return replace(project, segments=alignment.set_locked(_with_index(project, index), index, locked=locked))


def name_segment(project: Project, index: int, name: str) -> Project:
    """Give a segment the name or number that its curve has."""
    return replace(project, segments=alignment.rename(_with_index(project, index), index, name))


def detect_again(project: Project) -> Project:
    """Find the segments anew; locked ones stay, and with none locked they are automatic again."""
    if project.segments is None:
        return project
    previous = _segments(project)
    if not any(segment.locked for segment in previous):
        return use_automatic_segments(project)
    from bobdesk.alignment.segmentation import detect_segments  # here, for it needs scipy

    line = derive.centreline(project).needed()
    return replace(project, segments=detect_segments(line, project.segmentation, previous=previous))


def use_automatic_segments(project: Project) -> Project:
    """Give up all work by hand on segments."""
    return replace(project, segments=None)


def set_segmentation(project: Project, settings: SegmentationSettings) -> Project:
    """Change threshold, wanted number, shortest segment or rule, and detect with them; locked ones stay."""
    numbers = (settings.threshold or 0.0, settings.change_cost, settings.shortest)
    if not all(math.isfinite(number) for number in numbers):
        raise InputError("a setting of the segments is no number")
    return detect_again(replace(project, segmentation=settings))


def set_segments(project: Project, segments: Segments) -> Project:
    """Take all segments from a file."""
    line = derive.centreline(project).needed()
    return replace(project, segments=check_segments(segments, length=line.length))


def _segments(project: Project) -> Segments:
    return derive.segments(project).needed()


def _with_index(project: Project, index: int) -> Segments:
    segments = _segments(project)
    if not 0 <= index < len(segments):
        raise InputError(f"there is no segment {index + 1}")
    return segments

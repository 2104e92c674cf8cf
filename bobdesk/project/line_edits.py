"""What a user does to the digitised line: vertices, direction, start and finish, smoothing."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from bobdesk.alignment.fit_settings import WAVELENGTH_OF_CLICKS, WAVELENGTH_OF_TRACES, FitSettings
from bobdesk.alignment.segments import Segment, Segments, segment_at
from bobdesk.errors import InputError
from bobdesk.plan import trace_vertices as vertices
from bobdesk.plan.polyline import Polyline
from bobdesk.plan.traced_line import Trace
from bobdesk.project.derive import digitised_length, polyline
from bobdesk.project.project import DigitisedLine, Extent, Project

_SHORTEST_SEGMENT = 1e-3


def take_trace(project: Project, trace: Trace) -> Project:
    """Take the line that was traced in the picture, and smooth it as suits a trace."""
    vertices.checked_vertices(trace.points)
    return replace(project, trace=trace, extent=Extent(), segments=None, fit=_smoothed(project, clicks=False))


def draw_line(project: Project, points: npt.ArrayLike) -> Project:
    """Take a line clicked by hand, (n, 2), pixels, and smooth it as suits clicks."""
    trace = vertices.drawn_trace(points)
    return replace(project, trace=trace, extent=Extent(), segments=None, fit=_smoothed(project, clicks=True))


def delete_line(project: Project) -> Project:
    """Take the whole line away."""
    return replace(project, trace=None, extent=Extent(), segments=None)


def move_vertex(project: Project, index: int, x_px: float, y_px: float) -> Project:
    """Drag one vertex to another pixel."""
    return replace(project, trace=vertices.with_vertices_moved(_trace(project), [index], to=(x_px, y_px)))


def move_vertices(project: Project, indices: Sequence[int], to: npt.ArrayLike) -> Project:
    """Nudge several vertices to the pixels `to`, (k, 2)."""
    return replace(project, trace=vertices.with_vertices_moved(_trace(project), indices, to=to))


def insert_vertex(project: Project, after: int, x_px: float, y_px: float) -> Project:
    """Put a vertex behind the one with the index `after`; -1 puts it before the first."""
    return replace(project, trace=vertices.with_vertex_inserted(_trace(project), after, at=(x_px, y_px)))


def delete_vertices(project: Project, indices: Sequence[int]) -> Project:
    """Take vertices away."""
    return replace(project, trace=vertices.without_vertices(_trace(project), indices))


def redraw_stretch(
    project: Project, first: int, last: int, points: npt.ArrayLike, confidence: npt.ArrayLike | None = None
) -> Project:
    """Put other vertices in the place of those from `first` up to but not with `last`; prolongs at the ends."""
    trace = vertices.with_stretch_replaced(_trace(project), first, last, by=points, confidence=confidence)
    return replace(project, trace=trace)


def reverse_line(project: Project) -> Project:
    """Let the line run the other way: start and finish, edges, segments and known stations change sides."""
    whole = digitised_length(project)
    if whole is None:
        raise InputError("there is no line to reverse")
    extent = project.extent
    other: dict[DigitisedLine, DigitisedLine] = {"left edge": "right edge", "right edge": "left edge"}
    end = whole if extent.end is None else extent.end
    turned = replace(
        extent,
        start=max(0.0, whole - end),
        finish=None if extent.start == 0 else whole - extent.start,
        cut_off=None,
        digitised=other.get(extent.digitised, extent.digitised),
    )
    length = _plan_length(project)
    segments = project.segments
    if segments is not None:
        total = segments[-1].end
        segments = tuple(
            replace(segment, start=total - segment.end, end=total - segment.start) for segment in reversed(segments)
        )
    known = project.known_elevations
    if length is not None:
        known = tuple(replace(item, station=length - item.station) for item in reversed(known))
    source = project.source
    if source is not None:
        source = replace(source, polyline=Polyline(source.polyline.vertices[::-1]))
    return replace(
        project,
        trace=None if project.trace is None else vertices.turned_round(project.trace),
        source=source,
        extent=turned,
        segments=segments,
        known_elevations=known,
    )


def set_start(project: Project, at: float) -> Project:
    """Put the start flag at a distance along the digitised line (pixels of a trace, metres of a source)."""
    return _with_extent(project, replace(project.extent, start=_on_line(project, at)))


def set_finish(project: Project, at: float | None) -> Project:
    """Put the finish flag; None puts it at the line's end."""
    return _with_extent(project, replace(project.extent, finish=None if at is None else _on_line(project, at)))


def cut_final_climb(project: Project, at: float) -> Project:
    """Cut the line where it begins to climb for good, so that it ends at its lowest point."""
    return _with_extent(project, replace(project.extent, cut_off=_on_line(project, at)))


def keep_final_climb(project: Project) -> Project:
    """Take the cut of the final climb back."""
    return _with_extent(project, replace(project.extent, cut_off=None))


def say_which_line(project: Project, digitised: DigitisedLine, offset: float = 0.0) -> Project:
    """Say which line of the track was followed, and how far the centreline lies from it, m."""
    if not (math.isfinite(offset) and 0 <= offset <= 20):
        raise InputError(f"the centreline lies between 0 and 20 m from an edge, not {offset:g} m")
    return replace(project, extent=replace(project.extent, digitised=digitised, offset=float(offset)))


def set_spacing(project: Project, spacing: float) -> Project:
    """Set the distance between stations, m."""
    return replace(project, fit=replace(project.fit, spacing=_finite(spacing, "the spacing")))


def set_smoothing(project: Project, wavelength: float) -> Project:
    """Set the wavelength below which waves are taken for noise, m."""
    return replace(project, fit=replace(project.fit, wavelength=_finite(wavelength, "the smoothing wavelength")))


def _trace(project: Project) -> Trace:
    if project.trace is None:
        raise InputError("there is no line yet; draw or trace it first")
    return project.trace


def _smoothed(project: Project, *, clicks: bool) -> FitSettings:
    """Return the fit with the wavelength that suits the line, unless the user has set another."""
    suits, suited = WAVELENGTH_OF_TRACES, WAVELENGTH_OF_CLICKS
    if clicks:
        suits, suited = suited, suits
    return replace(project.fit, wavelength=suits) if project.fit.wavelength == suited else project.fit


def _finite(value: float, what: str) -> float:
    if not math.isfinite(value):
        raise InputError(f"{what} must be a number of metres")
    return float(value)


def _on_line(project: Project, at: float) -> float:
    whole = digitised_length(project)
    if whole is None:
        raise InputError("there is no line yet; draw or trace it first")
    if not (math.isfinite(at) and 0 <= at <= whole * (1 + 1e-9)):
        raise InputError("that place does not lie on the line")
    return float(min(at, whole))


def _plan_length(project: Project) -> float | None:
    line = polyline(project).value
    return None if line is None else float(np.hypot(*np.diff(line.vertices, axis=0).T).sum())


def _with_extent(project: Project, extent: Extent) -> Project:
    """Cut the line elsewhere; segments and known stations stay on their places on the ground."""
    whole = digitised_length(project)
    if whole is None:
        raise InputError("there is no line yet; draw or trace it first")
    old = project.extent
    old_end, new_end = (whole if one.end is None else min(one.end, whole) for one in (old, extent))
    if new_end <= extent.start:
        raise InputError("the finish must lie behind the start")
    changed = replace(project, extent=extent)
    before, after = _plan_length(project), _plan_length(changed)
    per_unit = None if before is None or old_end <= old.start else before / (old_end - old.start)
    if project.segments is not None and old_end > old.start:
        ratio = project.segments[-1].end / (old_end - old.start)
        changed = replace(
            changed,
            segments=_cut(
                project.segments, begin=(extent.start - old.start) * ratio, length=(new_end - extent.start) * ratio
            ),
        )
    if per_unit is not None and after is not None and extent.start != old.start:
        shift = (extent.start - old.start) * per_unit
        known = tuple(replace(item, station=item.station - shift) for item in project.known_elevations)
        changed = replace(changed, known_elevations=known)
    return changed


def _cut(segments: Segments, *, begin: float, length: float) -> Segments:
    """Return the segments of the line that begins at `begin` and is `length` long; the outer ones reach its ends."""
    parts: list[Segment] = []
    for index, segment in enumerate(segments):
        start = 0.0 if index == 0 else max(segment.start - begin, 0.0)
        end = length if index == len(segments) - 1 else min(segment.end - begin, length)
        if end - start > _SHORTEST_SEGMENT:
            parts.append(replace(segment, start=start, end=end))
    if not parts:  # the line is hardly there
        parts = [segments[segment_at(segments, begin + length / 2)]]
    parts[0] = replace(parts[0], start=0.0)
    parts[-1] = replace(parts[-1], end=length)
    return tuple(parts)

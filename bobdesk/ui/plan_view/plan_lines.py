"""The centreline and its segments brought back to plan units; called on threads, with a project that never changes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bobdesk.arrays import FloatArray, frozen
from bobdesk.project.project import Project

if TYPE_CHECKING:
    from bobdesk.alignment.segments import Segments


@dataclass(frozen=True, eq=False)
class LineInPlan:
    """The centreline in plan units.

    Attributes
    ----------
    points, stations
        (n, 2) plan units, and (n,) m along the centreline.
    segments
        In force; empty where they were not asked for.
    """

    points: FloatArray
    stations: FloatArray
    segments: Segments = ()


def line_in_plan(project: Project) -> LineInPlan:
    """Return the centreline.

    Raises
    ------
    InputError
        If there is none yet.
    """
    from bobdesk.project import derive

    line = derive.centreline(project).needed()
    metres = line.points / derive.plan_factor(project)
    if project.source is None:
        metres = derive.calibration(project).needed().to_pixels(metres)
    return LineInPlan(frozen(metres), line.stations)


def segments_in_plan(project: Project) -> LineInPlan:
    """Return the centreline with its segments.

    Raises
    ------
    InputError
        If there are none yet.
    """
    from bobdesk.project import derive

    line = line_in_plan(project)
    return LineInPlan(line.points, line.stations, derive.segments(project).needed())

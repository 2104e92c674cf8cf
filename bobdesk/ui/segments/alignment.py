"""The centreline with its curvature and segments, as one value that is worked out off the window's thread."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.project import derive
from bobdesk.project.project import Project

if TYPE_CHECKING:
    from bobdesk.alignment.centreline import Centreline
    from bobdesk.alignment.segment_figures import SegmentFigures


@dataclass(frozen=True, eq=False)
class Alignment:
    """What the window shows of a line.

    Attributes
    ----------
    line
        The centreline.
    bends, raw_bends : (n,)
        Curvature of the fitted line and of its unsmoothed stations, 1/m, left positive.
    headings : (n,)
        rad, without jumps.
    settings, threshold
        How segments are found, and the curvature that parts straight from curve, 1/m.
    segments, figures
        In force.
    """

    line: Centreline
    bends: FloatArray
    raw_bends: FloatArray
    headings: FloatArray
    settings: SegmentationSettings
    threshold: float
    segments: Segments
    figures: tuple[SegmentFigures, ...]

    def with_segments(self, segments: Segments) -> Alignment:
        """Return the same line with other segments; only the figures of new ones are worked out."""
        figures = tuple(derive.figures_of_one(self.line, segment) for segment in segments)
        return replace(self, segments=segments, figures=figures)

    def crossings(self, threshold: float | None = None) -> FloatArray:
        """Return the stations at which the curvature crosses the threshold, m."""
        above = np.abs(self.bends) - (self.threshold if threshold is None else threshold)
        at = np.flatnonzero((above[:-1] < 0) != (above[1:] < 0))
        share = above[at] / (above[at] - above[at + 1])
        stations = self.line.stations
        found: FloatArray = stations[at] + share * (stations[at + 1] - stations[at])
        return found

    def radius_at(self, station: float) -> float | None:
        """Return the radius at a station, m, positive to the left; None where the line is straight."""
        bend = float(np.interp(station, self.line.stations, self.bends))
        return None if abs(bend) < 1e-4 else 1.0 / bend


def alignment_of(project: Project) -> Alignment:
    """Work out everything about a project's line and segments.

    Raises
    ------
    InputError
        If there is no line yet, or the segments cannot be found as the settings want them.
    """
    from bobdesk.alignment.curvature import curvature, heading
    from bobdesk.alignment.segmentation import threshold_of

    line = derive.centreline(project).needed()
    segments = derive.segments(project).needed()
    settings = project.segmentation
    return Alignment(
        line,
        curvature(line),
        curvature(line, "published"),
        heading(line),
        settings,
        threshold_of(line, settings),
        segments,
        derive.segment_figures(project),
    )

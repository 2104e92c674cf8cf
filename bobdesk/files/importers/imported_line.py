"""What every importer returns, and the checks that every line passes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.plan.polyline import LARGEST_COORDINATE, Polyline, polyline_from_points
from bobdesk.plan.projection import Georeference
from bobdesk.project.project import Project

_MOST_LOOKED_AT_FOR_CROSSINGS = 200_000


@dataclass(frozen=True, eq=False)
class ImportedLine:
    """A line from a file.

    Attributes
    ----------
    polyline
        The plan, m.
    elevations : (n,) or None
        Of its vertices, m, where the file has them.
    notes
        What was changed, dropped or assumed, a sentence each.
    georeference
        Where the plan's origin lies on the Earth, if the file says so.
    segments
        Segments that the file says the line has; their stations count along it, or in proportion.
    project
        The whole project, where the file is one: targets, limits and settings go with its line.
    """

    polyline: Polyline
    elevations: FloatArray | None
    notes: tuple[str, ...]
    georeference: Georeference | None = None
    segments: Segments | None = None
    project: Project | None = None


def imported_line(
    points: FloatArray,
    elevations: FloatArray | None,
    *,
    name: str,
    notes: tuple[str, ...] = (),
    georeference: Georeference | None = None,
    segments: Segments | None = None,
) -> ImportedLine:
    """Check points, merge repeated ones, and say what there is to know about the line.

    Parameters
    ----------
    points : (n, 2)
        m.
    elevations : (n,) or None
        m.
    name
        Of the file, for the sentences.

    Raises
    ------
    InputError
        If the line cannot be used.
    """
    if elevations is not None and not (np.abs(elevations) < LARGEST_COORDINATE).all():
        index = int(np.flatnonzero(~(np.abs(elevations) < LARGEST_COORDINATE))[0])
        raise InputError(f"{name}: the elevation of point {index + 1} is not a finite number of metres")
    try:
        polyline, kept = polyline_from_points(points)
    except InputError as error:
        raise InputError(f"{name}: {error}") from error
    dropped = len(points) - len(kept)
    if dropped:
        notes = (*notes, f"{dropped} repeated point{'s were' if dropped > 1 else ' was'} left out")
    if crosses_itself(polyline):
        notes = (*notes, "the line crosses itself in plan, as at a Kreisel; look at it if there is none")
    return ImportedLine(polyline, None if elevations is None else elevations[kept], notes, georeference, segments)


def crosses_itself(polyline: Polyline) -> bool:
    """Return whether the line crosses or touches itself; lines of over 200,000 vertices are not looked at."""
    import shapely  # here, for the table of formats is shown before it is loaded

    vertices = polyline.vertices
    return len(vertices) <= _MOST_LOOKED_AT_FOR_CROSSINGS and not bool(shapely.LineString(vertices).is_simple)

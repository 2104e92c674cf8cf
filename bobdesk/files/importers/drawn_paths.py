"""From the lines that a drawing or map holds to the one that is wanted."""

from __future__ import annotations

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.files.importers.chain import Part, joined, longest_chain
from bobdesk.files.importers.imported_line import ImportedLine, imported_line
from bobdesk.plan.polyline import LARGEST_COORDINATE, MOST_VERTICES
from bobdesk.plan.projection import LARGEST_LATITUDE, Georeference, to_metres

MOST_PATHS = 100_000
_FARTHEST_M = 500_000.0
_FARTHEST_DEGREES = 30.0


def line_from_paths(
    paths: list[FloatArray],
    *,
    name: str,
    notes: tuple[str, ...] = (),
) -> ImportedLine:
    """Join paths at their common ends and take the longest line.

    Parameters
    ----------
    paths
        (n_i, 2) or (n_i, 3) each, m; a missing elevation is NaN.

    Raises
    ------
    InputError
        If there is none, or the line cannot be used.
    """
    paths = _usable(paths, name=name)
    flat = [path[:, :2] for path in paths]
    if not all(_in_range(path) for path in flat):
        raise InputError(f"{name}: a coordinate is not a finite number below 100,000 km")
    heights = [_z(path) for path in paths]
    chain = _downhill(longest_chain(flat), heights)
    points = joined(flat, chain)
    elevations, notes = _elevations(joined(heights, chain)[:, 0], notes)
    return imported_line(points, elevations, name=name, notes=notes + _told(len(paths), len(chain)))


def line_from_degrees(
    paths: list[FloatArray],
    *,
    name: str,
    notes: tuple[str, ...] = (),
    origin: Georeference | None = None,
) -> ImportedLine:
    """Bring longitudes and latitudes to local metres, and go on as `line_from_paths`.

    Parameters
    ----------
    paths
        (n_i, 2) or (n_i, 3) each: longitude and latitude in degrees, elevation in metres or NaN.
    origin
        The plan's origin; the line's first point if None.
    """
    paths = _usable(paths, name=name)
    for path in paths:
        degrees = path[:, :2]
        if not (np.isfinite(degrees).all() and (np.abs(degrees) <= (360.0, LARGEST_LATITUDE)).all()):
            raise InputError(f"{name}: a longitude or latitude is missing or out of its range")
    first = origin or _at(paths[0][0])
    heights = [_z(path) for path in paths]
    chain = _downhill(longest_chain([_projected(path, first, name=name) for path in paths]), heights)
    degrees = joined([path[:, :2] for path in paths], chain)
    georeference = origin or _at(degrees[0])
    points = _projected(degrees, georeference, name=name)
    elevations, notes = _elevations(joined(heights, chain)[:, 0], notes)
    notes += _told(len(paths), len(chain))
    return imported_line(points, elevations, name=name, notes=notes, georeference=georeference)


def georeference_at(longitude: float, latitude: float) -> Georeference | None:
    """Return a georeference if the degrees lie in their range."""
    if abs(longitude) <= 360.0 and abs(latitude) <= LARGEST_LATITUDE:
        return Georeference(_wrapped(longitude), latitude)
    return None


def _at(point: FloatArray) -> Georeference:
    return Georeference(_wrapped(float(point[0])), float(point[1]))


def _wrapped(longitude: float) -> float:
    return longitude if abs(longitude) <= 180.0 else (longitude + 180.0) % 360.0 - 180.0


def _projected(path: FloatArray, georeference: Georeference, *, name: str) -> FloatArray:
    east = np.abs(np.remainder(path[:, 0] - georeference.longitude + 180.0, 360.0) - 180.0)
    metres = to_metres(path[:, :2], georeference) if east.max() <= _FARTHEST_DEGREES else None
    if metres is None or np.abs(metres).max() > _FARTHEST_M:
        raise InputError(f"{name}: the points lie over 500 km apart; cut out the track first")
    return metres


def _usable(paths: list[FloatArray], *, name: str) -> list[FloatArray]:
    paths = [path for path in paths if len(path) >= 2]
    if not paths:
        raise InputError(f"{name}: there is no line in it")
    if len(paths) > MOST_PATHS:
        raise InputError(f"{name}: there are {len(paths):,} lines in it, over {MOST_PATHS:,}; cut out the track first")
    count = sum(len(path) for path in paths)
    if count > MOST_VERTICES + len(paths):
        raise InputError(f"{name}: the lines have {count:,} points; the most that can be used is {MOST_VERTICES:,}")
    return paths


def _in_range(path: FloatArray) -> bool:
    return bool((np.abs(path) < LARGEST_COORDINATE).all())  # False for NaN too


def _z(path: FloatArray) -> FloatArray:
    return path[:, 2:3] if path.shape[1] > 2 else np.full((len(path), 1), np.nan)


def _downhill(chain: tuple[Part, ...], heights: list[FloatArray]) -> tuple[Part, ...]:
    """Turn a line downhill whose parts are drawn in both directions; a line drawn in one stays."""
    if len({turned for _, turned in chain}) < 2:
        return chain
    z = joined(heights, chain)[:, 0]
    return tuple((path, not turned) for path, turned in reversed(chain)) if z[0] < z[-1] else chain


def _elevations(z: FloatArray, notes: tuple[str, ...]) -> tuple[FloatArray | None, tuple[str, ...]]:
    known = ~np.isnan(z)
    if not known.any():
        return None, notes
    if not known.all():
        missing = int((~known).sum())
        return None, (*notes, f"{missing:,} of {len(z):,} points have no elevation, so that of the others was left out")
    if (z == 0).all():
        return None, (*notes, "all elevations are 0, so they were taken for missing")
    return z, notes


def _told(count: int, used: int) -> tuple[str, ...]:
    notes = []
    if used > 1:
        notes.append(f"{used} lines were joined at their common ends")
    if count > used:
        others = count - used
        notes.append(f"the longest line was taken; {others:,} other{'s were' if others > 1 else ' was'} left out")
    return tuple(notes)

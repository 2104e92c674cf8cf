"""Lines from GeoJSON (RFC 7946), and from the older kind that names a projection."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.files.importers.drawn_paths import georeference_at, line_from_degrees, line_from_paths
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.importers.json_text import finite_number
from bobdesk.plan.projection import Georeference

ORIGIN = "bobdesk_origin"
TYPES = frozenset(
    {"FeatureCollection", "Feature", "GeometryCollection", "LineString", "MultiLineString"}
    | {"Point", "MultiPoint", "Polygon", "MultiPolygon"}
)
_IN_DEGREES = ("CRS84", "EPSG::4326", "EPSG:4326", "EPSG::4258", "EPSG:4258", "EPSG::4979", "EPSG::4269", "EPSG:4269")


def line_of_geojson(document: dict[str, Any], *, name: str) -> ImportedLine:
    """Return the longest line of a GeoJSON document.

    Raises
    ------
    InputError
        If there is none, or it cannot be used.
    """
    paths: list[FloatArray] = []
    left_out = 0
    for geometry in _geometries(document):
        kind, coordinates = geometry.get("type"), geometry.get("coordinates")
        if kind == "LineString":
            paths.append(_positions(coordinates, name=name))
        elif kind == "MultiLineString" and isinstance(coordinates, list):
            paths.extend(_positions(part, name=name) for part in coordinates)
        else:
            left_out += 1
    notes: tuple[str, ...] = ()
    if left_out:
        notes = (f"{left_out:,} point{'s' if left_out > 1 else ''} or area{'s' if left_out > 1 else ''} left out",)
    paths = [path for path in paths if len(path) >= 2]
    if paths and not _are_degrees(document, paths):
        notes = (*notes, "the coordinates are no degrees, so they were taken for metres")
        return line_from_paths(paths, name=name, notes=notes)
    return line_from_degrees(paths, name=name, notes=notes, origin=_origin(document))


def _geometries(document: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield the geometries that are no collections, in the order of the file."""
    stack: list[Any] = [document]
    while stack:
        item = stack.pop()
        if not isinstance(item, dict):
            continue
        for key in ("features", "geometries"):
            if isinstance(item.get(key), list):
                stack.extend(reversed(item[key]))
        if isinstance(item.get("geometry"), dict):
            stack.append(item["geometry"])
        if "coordinates" in item:
            yield item


def _positions(coordinates: object, *, name: str) -> FloatArray:
    """Return positions, (n, 2) or (n, 3); missing elevations are NaN."""
    if not isinstance(coordinates, list) or not all(isinstance(row, list) and len(row) >= 2 for row in coordinates):
        raise InputError(f"{name}: the coordinates of a line are no list of positions")
    rows = [[finite_number(cell) for cell in row[:3]] for row in coordinates]
    for number, row in enumerate(rows, 1):
        if any(cell != cell for cell in row):
            raise InputError(f"{name}: position {number:,} of a line is not made of finite numbers")
    return np.array([row if len(row) == 3 else [*row, np.nan] for row in rows]).reshape(-1, 3)


def _are_degrees(document: dict[str, Any], paths: list[FloatArray]) -> bool:
    system = document.get("crs")
    properties = system.get("properties") if isinstance(system, dict) else None
    title = properties.get("name") if isinstance(properties, dict) else None
    if isinstance(title, str) and not title.endswith(_IN_DEGREES):
        return False
    return all((np.abs(path[:, :2]) <= (360.0, 90.0)).all() for path in paths)


def _origin(document: dict[str, Any]) -> Georeference | None:
    place = document.get(ORIGIN)
    if isinstance(place, list) and len(place) == 2:
        return georeference_at(finite_number(place[0]), finite_number(place[1]))
    return None

"""Lines from JSON: GeoJSON, what Overpass answers, and BobDesk's own."""

from __future__ import annotations

from typing import Any

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.files.importers.drawn_paths import georeference_at
from bobdesk.files.importers.geojson import TYPES, line_of_geojson
from bobdesk.files.importers.imported_line import ImportedLine, imported_line
from bobdesk.files.importers.json_text import finite_number, parse_json
from bobdesk.files.importers.overpass_json import line_of_overpass

LINE_FORMAT = "bobdesk-line"
LINE_VERSION = 1


def read_json(data: bytes, *, name: str) -> ImportedLine:
    """Read a line from JSON of one of the three kinds.

    Raises
    ------
    InputError
        If it is of no such kind, damaged, or over a limit.
    """
    document = parse_json(data, name=name)
    if isinstance(document, dict):
        if document.get("format") == LINE_FORMAT:
            return _line(document, name=name)
        kind = document.get("type")
        if isinstance(kind, str) and kind in TYPES:
            return line_of_geojson(document, name=name)
        if "elements" in document:
            return line_of_overpass(document, name=name)
    raise InputError(f"{name}: this JSON is neither GeoJSON nor an answer of Overpass nor a line of BobDesk")


def _line(document: dict[str, Any], *, name: str) -> ImportedLine:
    version = document.get("version")
    if version != LINE_VERSION:
        shown = str(version)[:20]
        raise InputError(f"{name}: the line is of version {shown}; this BobDesk reads version {LINE_VERSION}")
    columns = document.get("columns")
    if not isinstance(columns, dict):
        raise InputError(f"{name}: there are no columns in it")
    x, y = (_column(columns, title, name=name) for title in ("x_m", "y_m"))
    z = _column(columns, "z_m", name=name) if "z_m" in columns else None
    if len({len(column) for column in (x, y, z) if column is not None}) > 1:
        raise InputError(f"{name}: the columns x_m, y_m and z_m have different lengths")
    place = document.get("georeference")
    georeference = None
    if isinstance(place, dict):
        georeference = georeference_at(finite_number(place.get("longitude")), finite_number(place.get("latitude")))
    return imported_line(np.column_stack([x, y]), z, name=name, georeference=georeference)


def _column(columns: dict[str, Any], title: str, *, name: str) -> FloatArray:
    values = columns.get(title)
    if not isinstance(values, list):
        raise InputError(f"{name}: there is no column {title}")
    return np.array([finite_number(value) for value in values], dtype=np.float64)

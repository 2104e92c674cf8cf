"""Lines from JSON: GeoJSON, what Overpass answers, and BobDesk's own."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from bobdesk.alignment.segments import Segment, Segments, check_segments
from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.files.importers.drawn_paths import georeference_at
from bobdesk.files.importers.geojson import TYPES, line_of_geojson
from bobdesk.files.importers.imported_line import ImportedLine, imported_line
from bobdesk.files.importers.json_text import finite_number, parse_json
from bobdesk.files.importers.overpass_json import line_of_overpass

LINE_FORMAT = "bobdesk-line"
LINE_VERSION = 1
_SAME_LENGTH = 0.05  # chords of 20 m in tight curves are a per cent shorter than the arcs that stations may count
_LONGEST_NAME = 200


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
    segments = _segments(document, np.column_stack([x, y]), name=name)
    return imported_line(np.column_stack([x, y]), z, name=name, georeference=georeference, segments=segments)


def columns_of_line(data: bytes, titles: Iterable[str], *, name: str) -> dict[str, FloatArray] | None:
    """Return columns of BobDesk's own JSON, (n,) each, or None if one is missing or it is other JSON.

    Raises
    ------
    InputError
        If it is damaged, or a value is no finite number.
    """
    document = parse_json(data, name=name)
    if not isinstance(document, dict) or document.get("format") != LINE_FORMAT:
        return None
    columns = document.get("columns")
    if not isinstance(columns, dict) or not all(isinstance(columns.get(title), list) for title in titles):
        return None
    found = {title: _column(columns, title, name=name) for title in titles}
    for title, values in found.items():
        if len(values) != len(found["x_m"]):
            raise InputError(f"{name}: the columns x_m and {title} have different lengths")
        if not np.isfinite(values).all():
            raise InputError(f"{name}: the column {title} holds something that is not a finite number")
    return found


def _segments(document: dict[str, Any], points: FloatArray, *, name: str) -> Segments | None:
    entries = document.get("segments")
    if entries is None:
        return None
    if not isinstance(entries, list) or len(entries) > len(points):
        raise InputError(f"{name}: its list of segments makes no sense")
    found = []
    for number, entry in enumerate(entries, 1):
        kind, title = (entry.get("kind"), entry.get("name", "")) if isinstance(entry, dict) else (None, "")
        if kind not in ("straight", "curve") or not isinstance(title, str):
            raise InputError(f"{name}: segment {number} is not of the kind straight or curve")
        start, end = finite_number(entry.get("from_m")), finite_number(entry.get("to_m"))
        found.append(Segment("straight" if kind == "straight" else "curve", start, end, name=title[:_LONGEST_NAME]))
    try:
        checked = check_segments(found, length=found[-1].end if found else 0.0)
    except InputError as error:
        raise InputError(f"{name}: {error}") from error
    length = float(np.hypot(*np.diff(points, axis=0).T).sum())
    if not abs(checked[-1].end - length) <= _SAME_LENGTH * length:
        raise InputError(f"{name}: its segments end at {checked[-1].end:.3f} m, but the line is {length:.3f} m long")
    return checked


def _column(columns: dict[str, Any], title: str, *, name: str) -> FloatArray:
    values = columns.get(title)
    if not isinstance(values, list):
        raise InputError(f"{name}: there is no column {title}")
    return np.array([finite_number(value) for value in values], dtype=np.float64)

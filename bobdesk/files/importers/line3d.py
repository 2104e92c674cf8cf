"""A whole 3D centreline from a file: LINE.csv as it was written, or any line with elevations."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

from bobdesk.alignment.centreline import fit_centreline
from bobdesk.alignment.curvature import plane_curvature
from bobdesk.alignment.segmentation import detect_segments
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segment, Segments, stretched
from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.files.importers.formats import FORMATS, format_of, line_in
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.importers.json_lines import columns_of_line, read_json
from bobdesk.files.importers.table import Table, read_bytes, table_from
from bobdesk.plan.polyline import LARGEST_COORDINATE
from bobdesk.plan.projection import Georeference
from bobdesk.track.centreline3d import Centreline3D, segment_gradients

_NUMBERS = ("station_m", "s_m", "x_m", "y_m", "z_m", "heading_rad", "gradient")
_CURVATURES = ("curvature_plan_per_m", "curvature_per_m")


@dataclass(frozen=True, eq=False)
class Line3D:
    """A 3D centreline from a file, its place on the Earth if the file says it, and notes, a sentence each."""

    line: Centreline3D
    georeference: Georeference | None
    notes: tuple[str, ...]


def read_line3d(path: Path) -> Line3D:
    """Read a 3D centreline.

    LINE.csv and BobDesk's own JSON give every column back as it was written. Of any other line with
    elevations the points stay as they are, and headings, curvature and segments are found from them.

    Raises
    ------
    InputError
        If the file cannot be used, or has no elevations.
    """
    data, name = read_bytes(path), str(path)
    known = format_of(data, name=name)
    if known is FORMATS[0]:
        table = table_from(data, name=name)
        if table.header is not None and {*_NUMBERS, *_CURVATURES, "segment", "kind"} <= set(table.header):
            return Line3D(_of_table(table), None, ())
    found = line_in(data, known, name=name)
    if found.segments is not None and known.read is read_json:
        columns = columns_of_line(data, (*_NUMBERS, *_CURVATURES, "segment"), name=name)
        if columns is not None:
            return Line3D(_as_written(columns, found.segments, name=name), found.georeference, found.notes)
    if found.elevations is None:
        raise InputError(f"{path}: there are no elevations (column z_m); a 3D line needs them")
    notes = found.notes
    if found.segments is None:
        notes = (*notes, "its segments were found anew, since the file names none")
    return Line3D(_from_points(found, found.elevations, name=name), found.georeference, notes)


def _of_table(table: Table) -> Centreline3D:
    header = table.header or []
    values = {title: table.column(header.index(title), title) for title in (*_NUMBERS, *_CURVATURES, "segment")}
    stations = values["station_m"]
    numbers = values["segment"]
    if len(stations) < 3:
        raise InputError(f"{table.name}: the column station_m must grow from row to row, over three rows or more")
    steps = np.diff(numbers)
    if not (numbers[0] == 1 and np.isin(steps, (0.0, 1.0)).all()):
        raise InputError(f"{table.name}: the column segment must count up from 1")
    column = header.index("kind")
    firsts = [0, *(np.flatnonzero(steps) + 1).tolist()]
    edges = [0.0, *stations[firsts[1:]].tolist(), float(stations[-1])]
    segments: list[Segment] = []
    for first, (start, end) in zip(firsts, pairwise(edges), strict=True):
        word = table.rows[first][column]
        if word not in ("straight", "curve"):
            raise InputError(
                f"{table.name}, line {table.lines[first]}, column kind holds '{word[:40]}', not straight or curve"
            )
        segments.append(Segment("straight" if word == "straight" else "curve", start, end))
    if segments[-1].start == segments[-1].end:
        # A last segment of one row has no length that could be known.
        numbers = np.minimum(numbers, len(segments) - 1)
        segments = segments[:-1]
    return _as_written(values | {"segment": numbers}, tuple(segments), name=table.name)


def _as_written(values: dict[str, FloatArray], segments: Segments, *, name: str) -> Centreline3D:
    stations, numbers = values["station_m"], values["segment"]
    for title, column in values.items():
        if not (np.abs(column) < LARGEST_COORDINATE).all():
            raise InputError(f"{name}: the column {title} holds a number that no track has")
    if len(stations) < 3 or not (np.diff(stations) > 0).all():
        raise InputError(f"{name}: the column station_m must grow from row to row, over three rows or more")
    if not np.isin(numbers, np.arange(1, len(segments) + 1)).all():
        raise InputError(f"{name}: the column segment names a segment that there is not")
    points = np.column_stack([values["x_m"], values["y_m"], values["z_m"]])
    return Centreline3D(
        stations=stations,
        slope_lengths=values["s_m"],
        points=points,
        headings=values["heading_rad"],
        gradients=values["gradient"],
        plan_curvature=values["curvature_plan_per_m"],
        curvature=values["curvature_per_m"],
        segment_of=numbers.astype(np.int64) - 1,
        segments=segments,
        segment_gradients=segment_gradients(stations, points[:, 2], segments),
    )


def _from_points(found: ImportedLine, elevations: FloatArray, *, name: str) -> Centreline3D:
    plan = found.polyline.vertices
    points = np.column_stack([plan, elevations - elevations.min()])
    stations = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(plan, axis=0).T))])
    curve = CubicSpline(stations, points)
    way, bend = curve(stations, 1), curve(stations, 2)
    bends = plane_curvature(way, bend)
    speed = np.linalg.norm(way, axis=1)
    in_space = np.linalg.norm(np.cross(way, bend), axis=1) / np.maximum(speed, 1e-12) ** 3
    try:
        segments = _segments(found, float(stations[-1]))
    except InputError as error:
        raise InputError(f"{name}: {error}") from error
    ends = np.array([segment.end for segment in segments])
    return Centreline3D(
        stations=stations,
        slope_lengths=np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]),
        points=points,
        headings=np.unwrap(np.arctan2(way[:, 1], way[:, 0])),
        gradients=-way[:, 2] / np.maximum(np.hypot(way[:, 0], way[:, 1]), 1e-12),
        plan_curvature=bends,
        curvature=np.where(bends < 0, -in_space, in_space),
        segment_of=np.minimum(np.searchsorted(ends, stations, side="right"), len(ends) - 1),
        segments=segments,
        segment_gradients=segment_gradients(stations, points[:, 2], segments),
    )


def _segments(found: ImportedLine, length: float) -> Segments:
    """Return the file's segments, or find them on the fitted line: it and the drawn one differ a little in length."""
    if found.segments is not None:
        return stretched(found.segments, length)
    fitted = fit_centreline(found.polyline)
    share = length / fitted.length
    segments = detect_segments(fitted, SegmentationSettings())
    scaled = [replace(segment, start=share * segment.start, end=share * segment.end) for segment in segments]
    return (*scaled[:-1], replace(scaled[-1], end=length))

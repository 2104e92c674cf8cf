"""Points from CSV, TSV or any other delimited text: a plan, or a line in space."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.files.importers.dialect import Dialect
from bobdesk.files.importers.imported_line import ImportedLine, imported_line
from bobdesk.files.importers.table import Table, read_bytes, table_from
from bobdesk.plan.polyline import LARGEST_COORDINATE
from bobdesk.plan.projection import LARGEST_LATITUDE, Georeference, to_metres

_X = ("x_m", "x", "easting", "east", "x [m]", "x(m)", "x (m)")
_Y = ("y_m", "y", "northing", "north", "y [m]", "y(m)", "y (m)")
_Z = ("z_m", "z", "elevation", "elevation_m", "height", "altitude", "z [m]", "z(m)", "z (m)")
_MOST_PLAIN_COLUMNS = 3
_FARTHEST_DEGREES = 4.0
CsvUnit = Literal["metres", "millimetres", "feet", "US survey feet", "degrees"]
_METRES = {"metres": 1.0, "millimetres": 0.001, "feet": 0.3048, "US survey feet": 1200 / 3937}


@dataclass(frozen=True)
class CsvChoice:
    """What a person says of a table that can be read in several ways ("1,234" is ambiguous by nature).

    Attributes
    ----------
    dialect
        Separator and decimal sign; found out if None.
    columns
        Indices of x, y and z (or None), from 0; found by their names if None.
    unit
        Of the coordinates and elevations. With degrees, x is the longitude, y the latitude, and
        elevations are metres.
    """

    dialect: Dialect | None = None
    columns: tuple[int, int, int | None] | None = None
    unit: CsvUnit = "metres"


def read_csv_points(path: Path) -> ImportedLine:
    """Read a line from delimited text with columns x and y, and z if it is there.

    Raises
    ------
    InputError
        If the file cannot be used; the sentence names file, line and column.
    """
    return line_of_csv(read_bytes(path), name=str(path))


def line_of_csv(data: bytes, *, name: str, choice: CsvChoice | None = None) -> ImportedLine:
    """Return the line in delimited text, (x, y) and z if it is there.

    Parameters
    ----------
    data, name
        The file's bytes, and its name for the sentences.
    choice
        What a person said of the table; found out if None.

    Raises
    ------
    InputError
        If the text cannot be used; the sentence names file, line and column.
    """
    table = table_from(data, name=name, dialect=None if choice is None else choice.dialect)
    return line_of_table(table, choice=choice)


def line_of_table(table: Table, *, choice: CsvChoice | None = None) -> ImportedLine:
    """Return the line in a table; see `line_of_csv`."""
    notes: list[str] = []
    choice = choice or CsvChoice()
    x, y, z = _columns(table, notes) if choice.columns is None else choice.columns
    points = np.column_stack([table.column(x, _title(table, x)), table.column(y, _title(table, y))])
    if choice.unit == "degrees":
        elevations = None if z is None else table.column(z, _title(table, z))
        return _line_of_degrees(points, elevations, name=table.name, notes=tuple(notes))
    points = points * _METRES[choice.unit]
    beyond = np.argwhere(np.abs(points) >= LARGEST_COORDINATE)
    if len(beyond):
        row, axis = beyond[0].tolist()
        raise InputError(
            f"{table.name}, line {table.lines[row]}, column {_title(table, (x, y)[axis])} holds {points[row, axis]:g};"
            " coordinates beyond 100,000 km cannot be used: are they metres?"
        )
    elevations = None if z is None else table.column(z, _title(table, z)) * _METRES[choice.unit]
    return imported_line(points, elevations, name=table.name, notes=tuple(notes))


def columns_of(table: Table) -> tuple[int, int, int | None]:
    """Return the indices of x, y and z (or None), found by their names.

    Raises
    ------
    InputError
        If they are not clear.
    """
    return _columns(table, [])


def _line_of_degrees(
    degrees: FloatArray, elevations: FloatArray | None, *, name: str, notes: tuple[str, ...]
) -> ImportedLine:
    if (np.abs(degrees) > (360.0, LARGEST_LATITUDE)).any():
        raise InputError(f"{name}: a longitude or latitude is out of its range; are the coordinates metres?")
    longitude = float(np.remainder(degrees[0, 0] + 180.0, 360.0) - 180.0)
    origin = Georeference(longitude, float(degrees[0, 1]))
    away = np.abs(np.remainder(degrees[:, 0] - longitude + 180.0, 360.0) - 180.0)
    if max(away.max(), np.ptp(degrees[:, 1])) > _FARTHEST_DEGREES:
        raise InputError(f"{name}: the points lie hundreds of kilometres apart; cut out the track first")
    return imported_line(to_metres(degrees, origin), elevations, name=name, notes=notes, georeference=origin)


def _columns(table: Table, notes: list[str]) -> tuple[int, int, int | None]:
    if table.header is None:
        width = max(len(row) for row in table.rows)
        if not 2 <= width <= _MOST_PLAIN_COLUMNS:
            raise InputError(
                f"{table.name}, line {table.lines[0]}: there is no header, and {width} columns of which x and y"
                " are not known; add a first line that names the columns x_m and y_m"
            )
        notes.append("the file has no header; its first two columns were taken for x and y")
        return 0, 1, 2 if width == _MOST_PLAIN_COLUMNS else None
    x, y, z = (_first(table.header, names) for names in (_X, _Y, _Z))
    if x is None or y is None:
        missing = " and ".join(name for name, index in (("x_m", x), ("y_m", y)) if index is None)
        found = ", ".join(name for name in table.header if name)[:120]
        raise InputError(f"{table.name}, line {table.lines[0] - 1}: there is no column {missing}; there are {found}")
    return x, y, z


def _first(header: list[str], names: tuple[str, ...]) -> int | None:
    return next((header.index(name) for name in names if name in header), None)


def _title(table: Table, index: int) -> str:
    named = table.header is not None and index < len(table.header)
    return table.header[index] if named and table.header is not None else str(index + 1)

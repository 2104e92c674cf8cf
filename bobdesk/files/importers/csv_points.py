"""Points from CSV, TSV or any other delimited text: a plan, or a line in space."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.files.importers.table import Table, read_table
from bobdesk.plan.polyline import LARGEST_COORDINATE, Polyline, polyline_from_points

_X = ("x_m", "x", "easting", "east", "x [m]", "x(m)", "x (m)")
_Y = ("y_m", "y", "northing", "north", "y [m]", "y(m)", "y (m)")
_Z = ("z_m", "z", "elevation", "elevation_m", "height", "altitude", "z [m]", "z(m)", "z (m)")
_MOST_PLAIN_COLUMNS = 3


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
        What was changed or assumed, a sentence each.
    """

    polyline: Polyline
    elevations: FloatArray | None
    notes: tuple[str, ...]


def read_csv_points(path: Path) -> ImportedLine:
    """Read a line from delimited text with columns x and y, and z if it is there.

    Raises
    ------
    InputError
        If the file cannot be used; the sentence names file, line and column.
    """
    table = read_table(path)
    notes: list[str] = []
    x, y, z = _columns(table, notes)
    points = np.column_stack([table.column(x, _title(table, x)), table.column(y, _title(table, y))])
    beyond = np.argwhere(np.abs(points) >= LARGEST_COORDINATE)
    if len(beyond):
        row, axis = beyond[0].tolist()
        raise InputError(
            f"{path}, line {table.lines[row]}, column {_title(table, (x, y)[axis])} holds {points[row, axis]:g};"
            " coordinates beyond 100,000 km cannot be used: are they metres?"
        )
    elevations = None if z is None else table.column(z, _title(table, z))
    try:
        polyline, kept = polyline_from_points(points)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    if len(kept) < len(points):
        dropped = len(points) - len(kept)
        notes.append(f"{dropped} repeated point{'s were' if dropped > 1 else ' was'} left out")
    return ImportedLine(polyline, None if elevations is None else elevations[kept], tuple(notes))


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
    return table.header[index] if table.header is not None else str(index + 1)

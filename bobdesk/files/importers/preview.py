"""What a file holds, before it is taken in: data for the window that asks how to read it."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bobdesk.arrays import FloatArray, frozen
from bobdesk.errors import InputError
from bobdesk.files.importers.csv_points import CsvChoice, columns_of, line_of_table
from bobdesk.files.importers.formats import FORMATS, format_of, line_in
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.importers.table import Table, read_bytes, table_from

_ROWS = 8
_MOST_COLUMNS = 50
_THUMBNAIL_POINTS = 200


@dataclass(frozen=True, eq=False)
class Preview:
    """What a file holds.

    Attributes
    ----------
    format
        For a person, such as "KML".
    columns
        Titles of the columns of `rows`.
    unit
        Of the coordinates in the file: "metres", "degrees", what a person said of a table, or "" if it is not known.
    separator, decimal
        Of a table, in words and as a sign; None for other formats.
    rows
        The first rows, as text.
    count
        Number of vertices of the line; 0 if there is a `problem`.
    has_elevations
        Whether there are elevations.
    thumbnail : (n, 2)
        At most 200 points of the line, m, y up.
    notes
        What was changed, dropped or assumed, a sentence each.
    problem
        Why a table cannot be read in this way; None if it can.
    line
        What would be imported, None if there is a `problem`.
    chosen
        Of a table: indices of its columns x, y and z (or None) as they are read; None if they are not clear.
    """

    format: str
    columns: tuple[str, ...]
    unit: str
    separator: str | None
    decimal: str | None
    rows: tuple[tuple[str, ...], ...]
    count: int
    has_elevations: bool
    thumbnail: FloatArray
    notes: tuple[str, ...]
    problem: str | None
    line: ImportedLine | None
    chosen: tuple[int, int, int | None] | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "thumbnail", frozen(self.thumbnail, columns=2))


def preview(path: Path, *, choice: CsvChoice | None = None) -> Preview:
    """Look at a file.

    Parameters
    ----------
    path
        The file.
    choice
        What a person said of a table; found out if None.

    Raises
    ------
    InputError
        If the file cannot be read at all. A table whose columns are not understood has a `problem`
        instead, so that a person can say which they are.
    """
    data, name = read_bytes(path), str(path)
    known = format_of(data, name=name)
    if known is FORMATS[0]:
        table = table_from(data, name=name, dialect=None if choice is None else choice.dialect)
        return _of_table(table, choice)
    line = line_in(data, known, name=name)
    rows = _rows(line)
    return Preview(
        format=known.title,
        columns=("x_m", "y_m", "z_m")[: rows.shape[1]],
        unit="metres" if line.georeference is None or _is_ours(line) else "degrees",
        separator=None,
        decimal=None,
        rows=tuple(tuple(f"{value:.3f}" for value in row) for row in rows[:_ROWS].tolist()),
        count=len(rows),
        has_elevations=line.elevations is not None,
        thumbnail=_thumbnail(line),
        notes=line.notes,
        problem=None,
        line=line,
    )


def _is_ours(line: ImportedLine) -> bool:
    """Return whether a file is BobDesk's own: those hold metres, and name the origin beside them."""
    return line.segments is not None or line.project is not None


def _of_table(table: Table, choice: CsvChoice | None) -> Preview:
    problem: str | None = None
    line: ImportedLine | None = None
    try:
        line = line_of_table(table, choice=choice)
    except InputError as error:
        problem = str(error)
    chosen = None if choice is None else choice.columns
    if chosen is None:
        with contextlib.suppress(InputError):
            chosen = columns_of(table)
    width = min(max(len(row) for row in table.rows[:_ROWS]), _MOST_COLUMNS)
    header = table.header or [str(number) for number in range(1, width + 1)]
    return Preview(
        format=FORMATS[0].title,
        columns=tuple(header[:_MOST_COLUMNS]),
        unit="metres" if choice is None else choice.unit,
        separator=table.dialect.separator_name,
        decimal=table.dialect.decimal,
        rows=tuple(tuple(cell[:80] for cell in row[:_MOST_COLUMNS]) for row in table.rows[:_ROWS]),
        count=0 if line is None else len(line.polyline.vertices),
        has_elevations=line is not None and line.elevations is not None,
        thumbnail=np.zeros((0, 2)) if line is None else _thumbnail(line),
        notes=() if line is None else line.notes,
        problem=problem,
        line=line,
        chosen=chosen,
    )


def _rows(line: ImportedLine) -> FloatArray:
    if line.elevations is None:
        return line.polyline.vertices
    return np.column_stack([line.polyline.vertices, line.elevations])


def _thumbnail(line: ImportedLine) -> FloatArray:
    vertices = line.polyline.vertices
    count = min(len(vertices), _THUMBNAIL_POINTS)
    chosen: FloatArray = vertices[np.linspace(0, len(vertices) - 1, count).round().astype(np.int64)]
    return chosen

"""A table of numbers from a text file, with errors that name line and column."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.files.atomic import reason
from bobdesk.files.importers.dialect import Dialect, cells_of, guess_dialect, number
from bobdesk.files.importers.text import decode_text
from bobdesk.plan.polyline import MOST_VERTICES

_LARGEST_FILE = 400_000_000
_COMMENT = "#"
_LONGEST_ROW = 100_000
_MOST_CELLS = 12_000_000


@dataclass(frozen=True, eq=False)
class Table:
    """Rows of text cells with what is needed to say where an error is.

    Attributes
    ----------
    name
        Of the file.
    header
        Column names in lower case, or None if the first row is numbers already.
    rows
        Cells, without comments and empty lines.
    lines
        Line number of each row in the file, from 1.
    dialect
        Separator and decimal sign.
    """

    name: str
    header: list[str] | None
    rows: list[list[str]]
    lines: list[int]
    dialect: Dialect

    def column(self, index: int, title: str) -> FloatArray:
        """Return a column of numbers, (n,).

        Raises
        ------
        InputError
            At the first cell that is no finite number; the sentence names its line and column.
        """
        values = np.empty(len(self.rows))
        for row, cells in enumerate(self.rows):
            if self.header is not None and any(cells[len(self.header) :]):
                raise InputError(
                    f"{self.name}, line {self.lines[row]}: the row has {len(cells)} cells, but the header names"
                    f" {len(self.header)} columns; are there decimal commas between commas?"
                )
            if index >= len(cells):
                raise InputError(f"{self.name}, line {self.lines[row]}: there is no column {title}")
            values[row] = number(cells[index], self.dialect)
            if not math.isfinite(values[row]):
                shown = cells[index][:40]
                fault = "is empty" if not shown else f"holds '{shown}', which is not a finite number"
                raise InputError(f"{self.name}, line {self.lines[row]}, column {title} {fault}")
        return values


def read_bytes(path: Path) -> bytes:
    """Read a file.

    Raises
    ------
    InputError
        If it is missing, a folder, unreadable, empty or too large.
    """
    try:
        if path.is_dir():
            raise InputError(f"{path}: this is a folder, not a file")
        # A device or a pipe has no size, and may never end.
        with path.open("rb") as stream:
            data = b"" if path.stat().st_size > _LARGEST_FILE else stream.read(_LARGEST_FILE + 1)
        if (not data and path.stat().st_size) or len(data) > _LARGEST_FILE:
            raise InputError(f"{path}: the file is too large; the most that is read is 400 MB")
    except FileNotFoundError:
        raise InputError(f"{path}: there is no such file") from None
    except (OSError, ValueError) as error:
        shown = str(path).replace("\0", "\\0")
        raise InputError(f"{shown}: cannot be read: {reason(error)}") from error
    if not data.strip():
        raise InputError(f"{path}: the file is empty")
    return data


def read_table(path: Path) -> Table:
    """Read a text file as a table; separator, decimal sign and encoding are found out.

    Raises
    ------
    InputError
        If it cannot be read, is no text, or has too many rows.
    """
    return table_from(read_bytes(path), name=str(path))


def table_from(data: bytes, *, name: str, dialect: Dialect | None = None) -> Table:
    """Return delimited text as a table; see `read_table`. The dialect is found out if None."""
    count = max(data.count(b"\n"), data.count(b"\r"))
    if count > MOST_VERTICES + 1000:
        raise InputError(
            f"{name}, line {MOST_VERTICES + 2:,}: the file goes on to line {count:,}, but the most that can be used"
            f" is {MOST_VERTICES:,} points; thin it out first"
        )
    text = decode_text(data, name=name)
    numbered = [
        (position, line)
        for position, line in enumerate(text.splitlines(), 1)
        if line.strip() and not line.lstrip().startswith(_COMMENT)
    ]
    if not numbered:
        raise InputError(f"{name}: the file holds no rows")
    lines = [line for _, line in numbered]
    position, longest = max(numbered, key=lambda item: len(item[1]))
    if len(longest) > _LONGEST_ROW:
        raise InputError(
            f"{name}, line {position}: the row has {len(longest):,} characters; this is no table of points"
        )
    dialect = dialect or guess_dialect(lines[1:] or lines)
    if text.count(dialect.separator) > _MOST_CELLS:
        raise InputError(f"{name}: the table has over {_MOST_CELLS:,} cells; keep the columns x_m, y_m and z_m alone")
    rows = [cells_of(line, dialect) for line in lines]
    positions = [position for position, _ in numbered]
    header: list[str] | None = None
    if not all(math.isfinite(number(cell, dialect)) for cell in rows[0] if cell):
        header = [cell.lower() for cell in rows[0]]
        rows, positions = rows[1:], positions[1:]
    if not rows:
        raise InputError(f"{name}: there is a header but no row below it")
    return Table(name, header, rows, positions, dialect)

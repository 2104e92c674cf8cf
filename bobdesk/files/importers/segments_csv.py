"""Segments from a table as `bobdesk segment` writes it."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

from bobdesk.alignment.segments import Kind, Segment, Segments, check_segments
from bobdesk.errors import InputError
from bobdesk.files.importers.table import Table, read_table
from bobdesk.sentences import are_missing

_NEAR_END = 0.002


def read_segments(path: Path, *, length: float, scale: float = 1.0) -> Segments:
    """Read segments with the columns kind, from_m and to_m, for a line of `length` metres; name and locked may be.

    The last segment may end up to 0.2 % beside the line's end, since a line that is fitted anew is
    rarely as long to the millimetre; it is moved there. The stations are multiplied by `scale`.

    Raises
    ------
    InputError
        If the file cannot be used or the segments do not cover the line.
    """
    table = read_table(path)
    header = table.header or []
    missing = [name for name in ("kind", "from_m", "to_m") if name not in header]
    if missing:
        raise InputError(f"{path}: {are_missing(missing)}; a table of segments needs kind, from_m and to_m")
    kind = header.index("kind")
    starts = scale * table.column(header.index("from_m"), "from_m")
    ends = scale * table.column(header.index("to_m"), "to_m")
    kinds: list[Kind] = []
    for row, cells in enumerate(table.rows):
        word = cells[kind].lower() if kind < len(cells) else ""
        if word not in ("straight", "curve"):
            raise InputError(
                f"{path}, line {table.lines[row]}, column kind holds '{word[:40]}'; it must be straight or curve"
            )
        kinds.append("straight" if word == "straight" else "curve")
    segments = [
        Segment(kind, float(start), float(end), _is_yes(locked, path, line), " ".join(name.removeprefix("'").split()))
        for kind, start, end, name, locked, line in zip(
            kinds, starts, ends, _texts(table, "name"), _texts(table, "locked"), table.lines, strict=True
        )
    ]
    if abs(segments[-1].end - length) <= _NEAR_END * length and segments[-1].start < length:
        segments[-1] = replace(segments[-1], end=length)
    try:
        return check_segments(_joined(segments), length=length)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def _joined(segments: list[Segment]) -> list[Segment]:
    """Close the gaps of up to a millimetre that rounding leaves between neighbours."""
    result = segments[:1]
    for segment in segments[1:]:
        start = result[-1].end if abs(segment.start - result[-1].end) <= 1.5e-3 else segment.start
        result.append(replace(segment, start=start))
    return result


def _texts(table: Table, column: str) -> list[str]:
    """Return the cells of a column of words, empty ones where there is none."""
    index = table.header.index(column) if table.header and column in table.header else math.inf
    return [cells[int(index)].strip() if index < len(cells) else "" for cells in table.rows]


def _is_yes(word: str, path: Path, line: int) -> bool:
    if word.lower() not in ("", "yes", "no"):
        raise InputError(f"{path}, line {line}, column locked holds '{word[:40]}'; it must be yes, no or empty")
    return word.lower() == "yes"

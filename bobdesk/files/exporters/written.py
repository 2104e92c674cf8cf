"""What stands in a file that was just written: figures from its own rounded rows, and how it looks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError

_HEAD, _TAIL = 6_000, 1_200


@dataclass(frozen=True)
class Totals:
    """Figures of the rows of a file: 3D length and drop, m, and how many rows there are."""

    length: float
    drop: float
    rows: int


def written_totals(content: bytes, *, name: str) -> Totals | None:
    """Return the totals of a file's rows, read again from its bytes; None where it holds no 3D line to be read.

    Parameters
    ----------
    name
        With the ending of its format.
    """
    points = _points(content, name)
    if points is None or len(points) < 2:
        return None
    length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    return Totals(length, float(points[0, 2] - points[:, 2].min()), len(points))


def _points(content: bytes, name: str) -> FloatArray | None:
    from bobdesk.files.importers.formats import format_of, line_in
    from bobdesk.files.importers.table import table_from

    try:
        if name.endswith(".csv"):
            table = table_from(content, name=name)
            header = table.header
            if header is None:
                places = [0, 1, 2]
            elif {"x_m", "y_m", "z_m"} <= set(header):
                places = [header.index(column) for column in ("x_m", "y_m", "z_m")]
            else:
                return None
            return np.column_stack([table.column(place, "xyz") for place in places])
        found = line_in(content, format_of(content, name=name), name=name)
    except InputError:
        return None
    if found.elevations is None:
        return None
    return np.column_stack([found.polyline.vertices, found.elevations])


def preview(content: bytes) -> str:
    """Return the text of a file as it will be written; of a long one the beginning and the end, whole lines each."""
    text = content.decode("utf-8-sig", errors="replace").replace("\r\n", "\n")
    if len(text) <= _HEAD + _TAIL:
        return text
    head = text[: text.rfind("\n", 0, _HEAD) + 1] or text[:_HEAD]
    start = text.find("\n", len(text) - _TAIL) + 1
    return f"{head}⋮\n{text[start:] if 0 < start < len(text) else text[-_TAIL:]}"

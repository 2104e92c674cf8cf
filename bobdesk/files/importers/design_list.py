"""A designer's list of curves (from, length, radius, direction) to compare segments against."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from bobdesk.alignment.design import MOST_CURVES, DesignCurve, DesignList
from bobdesk.errors import InputError
from bobdesk.files.importers.json_text import finite_number, parse_json
from bobdesk.files.importers.table import read_bytes, table_from
from bobdesk.sentences import are_missing, listed

_NUMBERS = ("from_m", "length_m", "radius_m")
_SIDES = {
    "": None,
    **dict.fromkeys(("left", "l", "links", "gauche", "sinistra"), "left"),
    **dict.fromkeys(("right", "r", "rechts", "droite", "destra"), "right"),
}


def read_design_list(path: Path) -> DesignList:
    """Read a list of curves from JSON (`curves`) or from a table, with from_m, length_m, radius_m and direction.

    Raises
    ------
    InputError
        If it cannot be read, lacks a column, or a curve makes no sense.
    """
    data = read_bytes(path)
    if data.lstrip()[:1] in (b"{", b"["):
        name, curves = _from_json(data, name=str(path))
    else:
        name, curves = "", _from_table(data, name=str(path))
    if not curves:
        raise InputError(f"{path}: there are no curves in it")
    ordered = tuple(sorted(curves, key=lambda curve: curve.start))
    return DesignList(name or path.name, ordered)


def _from_json(data: bytes, *, name: str) -> tuple[str, list[DesignCurve]]:
    document: Any = parse_json(data, name=name)
    found = document.get("curves") if isinstance(document, dict) else document
    if not isinstance(found, list) or not all(isinstance(entry, dict) for entry in found):
        raise InputError(f"{name}: there is no list of curves in this JSON")
    if len(found) > MOST_CURVES:
        raise InputError(f"{name}: there are more than {MOST_CURVES:,} curves in it")
    title = document.get("name") if isinstance(document, dict) else ""
    curves = [
        _curve(
            [_number(entry, key, where=f"{name}, curve {number}") for key in _NUMBERS],
            str(entry.get("direction", "")),
            str(entry.get("name", "")),
            where=f"{name}, curve {number}",
        )
        for number, entry in enumerate(found, 1)
    ]
    return title if isinstance(title, str) else "", curves


def _number(entry: dict[str, Any], key: str, *, where: str) -> float:
    if key not in entry:
        raise InputError(f"{where}: there is no {key}")
    value = finite_number(entry[key])
    if not math.isfinite(value):
        raise InputError(f"{where}: {key} is not a number")
    return value


def _from_table(data: bytes, *, name: str) -> list[DesignCurve]:
    table = table_from(data, name=name)
    header = table.header or []
    missing = [column for column in _NUMBERS if column not in header]
    if missing:
        raise InputError(f"{name}: {are_missing(missing)}; a list of curves needs {listed(_NUMBERS)}")
    if len(table.rows) > MOST_CURVES:
        raise InputError(f"{name}: there are more than {MOST_CURVES:,} curves in it")
    numbers = [table.column(header.index(column), column) for column in _NUMBERS]
    curves = []
    for row, cells in enumerate(table.rows):
        side, title = (
            cells[header.index(column)] if column in header and header.index(column) < len(cells) else ""
            for column in ("direction", "name")
        )
        where = f"{name}, line {table.lines[row]}"
        curves.append(_curve([float(column[row]) for column in numbers], side, title, where=where))
    return curves


def _curve(numbers: list[float], side: str, name: str, *, where: str) -> DesignCurve:
    start, length, radius = numbers
    word = side.strip().lower()
    if word not in _SIDES:
        raise InputError(f"{where}: the direction is '{side[:20]}'; it must be left or right")
    if not length > 0:
        raise InputError(f"{where}: the length must be more than 0 m, not {length:g} m")
    if not radius > 0:
        raise InputError(f"{where}: the radius must be more than 0 m, not {radius:g} m")
    known = _SIDES[word]
    return DesignCurve(start, length, radius, "left" if known == "left" else "right" if known else None, name.strip())

"""Known elevations from a table."""

from __future__ import annotations

from pathlib import Path

from bobdesk.errors import InputError
from bobdesk.files.importers.table import read_table
from bobdesk.solve.targets import KnownElevation

_STATIONS = ("station_m", "station", "s_m", "s")
_ELEVATIONS = ("z_m", "elevation_m", "elevation", "z")
_TOLERANCES = ("tolerance_m", "tolerance")
_MOST = 1000


def read_known_elevations(path: Path) -> tuple[KnownElevation, ...]:
    """Read the columns station_m, z_m and, where there is one, tolerance_m; without a header the first two or three.

    Raises
    ------
    InputError
        If the file cannot be used.
    """
    table = read_table(path)
    header = table.header
    if header is None:
        places: list[int | None] = [0, 1, 2 if table.rows and len(table.rows[0]) > 2 else None]
    else:
        places = [_first(header, names) for names in (_STATIONS, _ELEVATIONS, _TOLERANCES)]
    station, elevation, tolerance = places
    if station is None or elevation is None or (table.rows and len(table.rows[0]) < 2):
        raise InputError(f"{path}: known elevations need the columns station_m and z_m")
    if len(table.rows) > _MOST:
        raise InputError(f"{path}: it holds {len(table.rows):,} elevations; at most {_MOST:,} can be known")
    stations = table.column(station, "station_m").tolist()
    elevations = table.column(elevation, "z_m").tolist()
    tolerances = [0.0] * len(stations) if tolerance is None else table.column(tolerance, "tolerance_m").tolist()
    return tuple(KnownElevation(*row) for row in zip(stations, elevations, tolerances, strict=True))


def _first(header: list[str], names: tuple[str, ...]) -> int | None:
    return next((header.index(name) for name in names if name in header), None)

"""Tracks and routes from GPX, as navigation devices write it."""

from __future__ import annotations

import math

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.files.importers.drawn_paths import line_from_degrees
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.importers.xml_stream import Attributes, decimal, listen


def read_gpx(data: bytes, *, name: str) -> ImportedLine:
    """Read the longest track or route of a GPX file; the segments of a track follow each other.

    Raises
    ------
    InputError
        If it is damaged, over a limit, or holds no track or route.
    """
    found = _Gpx()
    listen(data, found, name=name)
    notes = list(found.notes)
    if found.waypoints:
        notes.append(f"{found.waypoints:,} waypoint{'s were' if found.waypoints > 1 else ' was'} left out")
    return line_from_degrees(found.paths, name=name, notes=tuple(notes))


class _Gpx:
    text_of = frozenset({"ele"})

    def __init__(self) -> None:
        self.paths: list[FloatArray] = []
        self.waypoints = 0
        self.notes: list[str] = []
        self._rows: list[tuple[float, float, float]] = []
        self._place: tuple[float, float] | None = None
        self._elevation = math.nan
        self._segments = 0

    def start(self, tag: str, attributes: Attributes) -> None:
        if tag in ("trkpt", "rtept"):
            self._place = (decimal(attributes.get("lon")), decimal(attributes.get("lat")))
            self._elevation = math.nan
        elif tag in ("trk", "rte"):
            self._rows, self._segments = [], 0
        elif tag == "trkseg":
            self._segments += 1
        elif tag == "wpt":
            self.waypoints += 1

    def end(self, tag: str, text: str) -> None:
        if tag == "ele":
            self._elevation = decimal(text)
        elif tag in ("trkpt", "rtept") and self._place is not None:
            self._rows.append((*self._place, self._elevation))
            self._place = None
        elif tag in ("trk", "rte"):
            if self._rows:
                self.paths.append(np.array(self._rows))
            if self._segments > 1:
                self.notes.append(f"a track of {self._segments} segments was taken as one line")
            self._rows = []

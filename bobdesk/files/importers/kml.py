"""Lines from KML, as Google Earth writes it."""

from __future__ import annotations

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.files.importers.drawn_paths import georeference_at, line_from_degrees
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.importers.xml_stream import Attributes, decimal, listen
from bobdesk.plan.polyline import MOST_VERTICES
from bobdesk.plan.projection import Georeference

ORIGIN = "bobdesk_origin"


def read_kml(data: bytes, *, name: str) -> ImportedLine:
    """Read the longest line of a KML file: LineString and gx:Track.

    Raises
    ------
    InputError
        If it is damaged, over a limit, or holds no line.
    """
    found = _Kml(name)
    listen(data, found, name=name)
    notes = []
    if found.points:
        notes.append(f"{found.points:,} place mark{'s were' if found.points > 1 else ' was'} left out")
    if found.areas:
        notes.append(f"{found.areas:,} area{'s were' if found.areas > 1 else ' was'} left out")
    return line_from_degrees(found.paths, name=name, notes=tuple(notes), origin=found.origin)


class _Kml:
    text_of = frozenset({"coordinates", "coord", "value"})

    def __init__(self, name: str) -> None:
        self.paths: list[FloatArray] = []
        self.origin: Georeference | None = None
        self.points = 0
        self.areas = 0
        self._name = name
        self._within = ""
        self._data_name = ""
        self._count = 0
        self._track: list[list[float]] = []

    def start(self, tag: str, attributes: Attributes) -> None:
        if tag in ("LineString", "LinearRing", "Point", "Track"):
            self._within = tag
            self.points += tag == "Point"
            self.areas += tag == "LinearRing"
        elif tag == "Data":
            self._data_name = attributes.get("name") or ""

    def end(self, tag: str, text: str) -> None:
        if tag == "coordinates" and self._within == "LineString":
            self.paths.append(_coordinates(text, name=self._name))
            self._count += len(self.paths[-1])
            if self._count > MOST_VERTICES:
                raise InputError(f"{self._name}: the lines have over {MOST_VERTICES:,} points; thin them out first")
        elif tag == "coord" and self._within == "Track":
            cells = [decimal(cell) for cell in text.split(maxsplit=4)[:3]]
            if len(cells) < 2:
                raise InputError(f"{self._name}: a point of a track holds '{text[:40]}', not longitude and latitude")
            self._track.append([*cells, np.nan][:3])
        elif tag == "Track":
            if self._track:
                self.paths.append(np.array(self._track))
            self._track = []
            self._within = ""
        elif tag == "value" and self._data_name == ORIGIN:
            place = [decimal(cell) for cell in text.split(",", 2)[:2]]
            self.origin = georeference_at(place[0], place[1]) if len(place) == 2 else None
        elif tag in ("LineString", "LinearRing", "Point"):
            self._within = ""


def _coordinates(text: str, *, name: str) -> FloatArray:
    """Return longitude, latitude and elevation, (n, 3), of "lon,lat,alt lon,lat,alt ..."."""
    # Blanks beside a comma are against the rules but not rare.
    tuples = text.replace(", ", ",").replace(" ,", ",").split(None, MOST_VERTICES)
    if len(tuples) > MOST_VERTICES:
        raise InputError(f"{name}: a line has over {MOST_VERTICES:,} points; thin it out first")
    if not tuples:
        return np.zeros((0, 3))
    width = tuples[0].count(",") + 1
    try:
        if all(cells.count(",") + 1 == width for cells in tuples):
            found = np.array([float(cell) for cell in ",".join(tuples).split(",")]).reshape(-1, width)
        else:
            rows = [[float(cell) for cell in cells.split(",")] for cells in tuples]
            found = np.array([[*row, np.nan, np.nan][:3] for row in rows])
    except ValueError:
        raise InputError(f"{name}: coordinates of a line hold something that is no number") from None
    if width == 1:
        raise InputError(f"{name}: coordinates of a line hold '{tuples[0][:40]}', not longitude and latitude")
    return np.column_stack([found, np.full((len(found), 1), np.nan)])[:, :3]

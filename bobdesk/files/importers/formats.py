"""The table of formats that lines are read from, and the one function that reads any of them."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from bobdesk.errors import InputError
from bobdesk.files.importers.csv_points import line_of_csv
from bobdesk.files.importers.dxf import read_dxf
from bobdesk.files.importers.gpx import read_gpx
from bobdesk.files.importers.imported_line import ImportedLine, imported_line
from bobdesk.files.importers.json_lines import read_json
from bobdesk.files.importers.kml import read_kml
from bobdesk.files.importers.kmz import read_kmz
from bobdesk.files.importers.osm_xml import read_osm_xml
from bobdesk.files.importers.project_plan import read_project
from bobdesk.files.importers.svg_lines import read_svg_lines
from bobdesk.files.importers.table import read_bytes
from bobdesk.files.plugins import Plugins, find_plugins
from bobdesk.files.project_archive import begins_like_a_project
from bobdesk.files.project_file import SUFFIX

IMPORTER_GROUP = "bobdesk.importers"
_LOOKED_AT = 65_536


class Importer(Protocol):
    """Makes a line of a file's bytes; raises InputError, and nothing else, with one sentence."""

    def __call__(self, data: bytes, *, name: str) -> ImportedLine:
        """Return the line in `data`; `name` is the file's, for the sentences."""


@dataclass(frozen=True)
class ImportFormat:
    """A format that lines are read from; what an entry point of the group "bobdesk.importers" must be.

    Attributes
    ----------
    key
        Short name in lower case.
    title
        For a person.
    extensions
        In lower case, with the dot.
    recognises
        Whether the first 64 kB of a file are surely of this format.
    read
        Reads it.
    """

    key: str
    title: str
    extensions: tuple[str, ...]
    recognises: Callable[[bytes], bool]
    read: Importer


def _never(head: bytes) -> bool:
    return False


def _root(tag: str) -> Callable[[bytes], bool]:
    """Return a test for XML whose first element is `tag`."""
    pattern = re.compile(rb"<(?:[A-Za-z][\w.-]{0,40}:)?([A-Za-z][\w.-]{0,40})[\s/>]")

    def recognises(head: bytes) -> bool:
        # UTF-16 has a zero byte in every second place.
        head = head.replace(b"\0", b"").lstrip(b"\xef\xbb\xbf\xff\xfe \t\r\n")
        if not head.startswith(b"<"):
            return False
        first = pattern.search(head)
        return first is not None and first[1].lower() == tag.encode()

    return recognises


def _is_json(head: bytes) -> bool:
    return head.replace(b"\0", b"").lstrip(b"\xef\xbb\xbf\xff\xfe \t\r\n")[:1] in (b"{", b"[")


def _is_dxf(head: bytes) -> bool:
    return head.startswith(b"AutoCAD Binary DXF") or bool(
        re.match(rb"(?:\xef\xbb\xbf)?(?:\s{0,9}999\r?\n[^\n]{0,400}\n){0,50}\s{0,9}0\r?\n\s{0,9}SECTION\s", head)
    )


def _is_zip(head: bytes) -> bool:
    return head.startswith(b"PK\x03\x04")


FORMATS: tuple[ImportFormat, ...] = (
    ImportFormat("csv", "CSV, TSV or other text", (".csv", ".tsv", ".txt", ".xyz", ".dat"), _never, line_of_csv),
    ImportFormat("json", "GeoJSON, Overpass or BobDesk JSON", (".geojson", ".json"), _is_json, read_json),
    ImportFormat("kml", "KML", (".kml",), _root("kml"), read_kml),
    ImportFormat("bobdesk", "BobDesk project", (SUFFIX,), begins_like_a_project, read_project),
    ImportFormat("kmz", "KMZ", (".kmz",), _is_zip, read_kmz),
    ImportFormat("gpx", "GPX", (".gpx",), _root("gpx"), read_gpx),
    ImportFormat("osm", "OpenStreetMap XML", (".osm",), _root("osm"), read_osm_xml),
    ImportFormat("dxf", "DXF", (".dxf",), _is_dxf, read_dxf),
    ImportFormat("svg", "SVG", (".svg",), _root("svg"), read_svg_lines),
)


def import_formats() -> Plugins[ImportFormat]:
    """Return the formats of this program and of its plug-ins, and why a plug-in could not be used."""
    return find_plugins(IMPORTER_GROUP, ImportFormat, built_in=FORMATS)


def format_of(data: bytes, *, name: str) -> ImportFormat:
    """Return the format by content, else by the name's ending, else delimited text."""
    formats = import_formats().formats
    head = data[:_LOOKED_AT]
    ending = Path(name).suffix.lower()
    for known in formats:
        # A project that another program packed anew begins like any ZIP.
        if known.recognises(head) and not (ending == SUFFIX and known.read is read_kmz):
            return known
    return next((known for known in formats if ending in known.extensions), FORMATS[0])


def read_line(path: Path) -> ImportedLine:
    """Read a line from a file of any known format.

    Raises
    ------
    InputError
        If the file cannot be used; one sentence that names it.
    """
    data = read_bytes(path)
    return line_in(data, format_of(data, name=str(path)), name=str(path))


def line_in(data: bytes, known: ImportFormat, *, name: str) -> ImportedLine:
    """Return the line in `data`, of a known format; a plug-in's failure is an InputError, too."""
    if known in FORMATS:
        return known.read(data, name=name)
    try:
        found = known.read(data, name=name)
        return imported_line(
            found.polyline.vertices,
            found.elevations,
            name=name,
            notes=tuple(str(note) for note in found.notes),
            georeference=found.georeference,
        )
    except InputError:
        raise
    except Exception as error:
        raise InputError(
            f"{name}: the plug-in for {known.title} failed: {type(error).__name__}: {str(error)[:200]}"
        ) from error

"""OpenStreetMap's XML, as its website, JOSM and Overpass write it."""

from __future__ import annotations

import math

from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.importers.osm_ways import Place, Way, line_of_ways
from bobdesk.files.importers.xml_stream import Attributes, decimal, listen


def read_osm_xml(data: bytes, *, name: str) -> ImportedLine:
    """Read the bobsleigh or luge track of an OSM XML file.

    Raises
    ------
    InputError
        If it is damaged, over a limit, or holds no such way.
    """
    found = _Osm()
    listen(data, found, name=name)
    return line_of_ways(found.ways, found.nodes, name=name)


class _Osm:
    text_of: frozenset[str] = frozenset()

    def __init__(self) -> None:
        self.nodes: dict[str, Place] = {}
        self.ways: list[Way] = []
        self._node: str | None = None
        self._way: Way | None = None

    def start(self, tag: str, attributes: Attributes) -> None:
        if tag == "node" and attributes.get("action") != "delete":
            self._node = attributes.get("id") or ""
            self.nodes[self._node] = _place(attributes)
        elif tag == "way":
            self._way = Way()
            if attributes.get("action") != "delete":
                self.ways.append(self._way)
        elif tag == "nd" and self._way is not None:
            if attributes.get("lat") is not None:
                self._way.points.append(_place(attributes))
            else:
                self._way.nodes.append(attributes.get("ref") or "")
        elif tag == "tag":
            key, value = attributes.get("k") or "", attributes.get("v") or ""
            if self._way is not None:
                self._way.tags[key] = value
            elif self._node is not None and key == "ele":
                longitude, latitude, _ = self.nodes[self._node]
                self.nodes[self._node] = (longitude, latitude, decimal(value))

    def end(self, tag: str, text: str) -> None:
        if tag == "node":
            self._node = None
        elif tag == "way":
            self._way = None


def _place(attributes: Attributes) -> Place:
    return decimal(attributes.get("lon")), decimal(attributes.get("lat")), math.nan

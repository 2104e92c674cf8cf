"""The JSON that Overpass answers with: OpenStreetMap's ways and nodes."""

from __future__ import annotations

import math
from typing import Any

from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.importers.json_text import finite_number
from bobdesk.files.importers.osm_ways import Place, Way, line_of_ways
from bobdesk.files.importers.xml_stream import decimal


def line_of_overpass(document: dict[str, Any], *, name: str) -> ImportedLine:
    """Return the bobsleigh or luge track of an answer (`out body` with nodes, or `out geom`).

    Raises
    ------
    InputError
        If there is none, or it cannot be used.
    """
    nodes: dict[str, Place] = {}
    ways: list[Way] = []
    elements = document.get("elements")
    for element in elements if isinstance(elements, list) else []:
        if not isinstance(element, dict):
            continue
        if element.get("type") == "node":
            nodes[str(element.get("id"))[:40]] = _place(element)
        elif element.get("type") == "way":
            ways.append(_way(element))
    return line_of_ways(ways, nodes, name=name)


def _way(element: dict[str, Any]) -> Way:
    nodes, geometry, tags = element.get("nodes"), element.get("geometry"), element.get("tags")
    return Way(
        nodes=[str(node)[:40] for node in nodes] if isinstance(nodes, list) else [],
        points=[_place(point) for point in geometry if isinstance(point, dict)] if isinstance(geometry, list) else [],
        tags={key: value for key, value in tags.items() if isinstance(value, str)} if isinstance(tags, dict) else {},
    )


def _place(element: dict[str, Any]) -> Place:
    tags = element.get("tags")
    elevation = tags.get("ele") if isinstance(tags, dict) else None
    z = decimal(elevation) if isinstance(elevation, str) else math.nan
    return finite_number(element.get("lon")), finite_number(element.get("lat")), z

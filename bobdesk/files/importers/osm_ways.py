"""The bobsleigh and luge tracks among the ways of OpenStreetMap."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.files.importers.drawn_paths import line_from_degrees
from bobdesk.files.importers.imported_line import ImportedLine

_SPORTS = frozenset({"bobsleigh", "luge", "skeleton"})
_AREAS = frozenset({"pitch", "sports_centre", "stadium", "park"})

# Longitude, latitude and elevation or NaN.
Place = tuple[float, float, float]


@dataclass
class Way:
    """A way as it is read: its nodes by number, or its points where the file gives them at once."""

    nodes: list[str] = field(default_factory=list)
    points: list[Place] = field(default_factory=list)
    tags: dict[str, str] = field(default_factory=dict)


def line_of_ways(ways: list[Way], nodes: dict[str, Place], *, name: str) -> ImportedLine:
    """Join the ways with sport=bobsleigh or luge; without such, take the only way there is.

    Raises
    ------
    InputError
        If there is no such way, or its nodes are not in the file.
    """
    chosen = [way for way in ways if _is_track(way)]
    notes: tuple[str, ...] = ()
    if chosen:
        others = len(ways) - len(chosen)
        if others:
            what = (
                "way without sport=bobsleigh or luge was"
                if others == 1
                else "ways without sport=bobsleigh or luge were"
            )
            notes = (f"{others:,} {what} left out",)
    elif len(ways) == 1:
        chosen = ways
        notes = ("the way has no sport=bobsleigh or luge, but it is the only one",)
    elif ways:
        raise InputError(
            f"{name}: none of its {len(ways):,} ways has sport=bobsleigh or luge; leave only the track in it"
        )
    paths = [_path(way, nodes) for way in chosen]
    known = [path for path in paths if len(path) >= 2]
    if chosen and not known:
        raise InputError(f"{name}: the nodes of the way are not in the file; download it with its nodes")
    missing = sum(len(way.points or way.nodes) for way in chosen) - sum(len(path) for path in paths)
    if missing:
        notes = (*notes, f"{missing:,} node{'s' if missing > 1 else ''} of the track that the file lacks left out")
    return line_from_degrees(known, name=name, notes=notes)


def _is_track(way: Way) -> bool:
    """Return whether a way is a track, not the ground or a house beside it."""
    sports = {sport.strip() for sport in re.split("[;,]", way.tags.get("sport", ""))}
    area = way.tags.get("area") == "yes" or "building" in way.tags or way.tags.get("leisure") in _AREAS
    return bool(sports & _SPORTS) and not area


def _path(way: Way, nodes: dict[str, Place]) -> FloatArray:
    places = way.points or [nodes[node] for node in way.nodes if node in nodes]
    return np.array(places, dtype=np.float64).reshape(-1, 3)

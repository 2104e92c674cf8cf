"""What the published schema of OpenDRIVE 1.6.1 asks of the elements that are written, as a table.

ASAM OpenDRIVE 1.6.1, opendrive_16_core.xsd (OpenDRIVE, header), opendrive_16_road.xsd (road, planView,
elevationProfile) and opendrive_16_lane.xsd (lanes). The schema itself may not be handed on; these are its facts.
Children stand in the order of the schema, each with how often it may come (None: any number).
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from xml.etree import ElementTree


@dataclass(frozen=True)
class Rule:
    children: tuple[tuple[str, int, int | None], ...] = ()
    required: dict[str, str] = field(default_factory=dict)
    optional: dict[str, str] = field(default_factory=dict)
    one_of: tuple[str, ...] = ()
    text: bool = False


_CUBIC = {"a": "double", "b": "double", "c": "double", "d": "double"}
_LANE = {"type": "lane type", "id": "integer"}
RULES = {
    "OpenDRIVE": Rule((("header", 1, 1), ("road", 1, None), ("controller", 0, None), ("junction", 0, None))),
    "OpenDRIVE/header": Rule(
        (("geoReference", 0, 1), ("offset", 0, 1)),
        {"revMajor": "1", "revMinor": "integer"},
        {"name": "string", "version": "string", "date": "string", "vendor": "string"}
        | dict.fromkeys(("north", "south", "east", "west"), "double"),
    ),
    "header/geoReference": Rule(text=True),
    "OpenDRIVE/road": Rule(
        (
            ("link", 0, 1),
            ("type", 0, None),
            ("planView", 1, 1),
            ("elevationProfile", 0, 1),
            ("lateralProfile", 0, 1),
            ("lanes", 1, 1),
            ("objects", 0, 1),
            ("signals", 0, 1),
            ("surface", 0, 1),
            ("railroad", 0, 1),
        ),
        {"length": "over zero", "id": "string", "junction": "string"},
        {"name": "string", "rule": "string"},
    ),
    "road/planView": Rule((("geometry", 1, None),)),
    "planView/geometry": Rule(
        required={"s": "zero or more", "x": "double", "y": "double", "hdg": "double", "length": "over zero"},
        one_of=("line", "spiral", "arc", "poly3", "paramPoly3"),
    ),
    "geometry/paramPoly3": Rule(
        required=dict.fromkeys(("aU", "bU", "cU", "dU", "aV", "bV", "cV", "dV"), "double") | {"pRange": "range"}
    ),
    "road/elevationProfile": Rule((("elevation", 0, None),)),
    "elevationProfile/elevation": Rule(required={"s": "zero or more", **_CUBIC}),
    "road/lanes": Rule((("laneOffset", 0, None), ("laneSection", 1, None))),
    "lanes/laneOffset": Rule(required={"s": "zero or more", **_CUBIC}),
    "lanes/laneSection": Rule(
        (("left", 0, 1), ("center", 1, 1), ("right", 0, 1)), {"s": "zero or more"}, {"singleSide": "boolean"}
    ),
    "laneSection/center": Rule((("lane", 1, None),)),
    "laneSection/right": Rule((("lane", 1, None),)),
    "center/lane": Rule(
        (("link", 0, 1), ("width", 0, None), ("roadMark", 0, None)),
        {"type": "lane type", "id": "0"},
        {"level": "boolean"},
    ),
    "right/lane": Rule(
        (("link", 0, 1), ("width", 0, None), ("roadMark", 0, None)),
        {"type": "lane type", "id": "below zero"},
        {"level": "boolean"},
    ),
    "lane/width": Rule(required={"sOffset": "zero or more", **_CUBIC}),
}

_DOUBLE = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")
_INTEGER = re.compile(r"[-+]?\d+")
_LANE_TYPES = {
    "driving",
    "none",
    "shoulder",
    "border",
    "restricted",
    "stop",
    "special1",
    "special2",
    "special3",
    "rail",
}


def _is(kind: str, value: str) -> bool:
    if kind == "string":
        return True
    if kind in ("0", "1"):
        return value == kind
    if kind == "boolean":
        return value in ("true", "false")
    if kind == "range":
        return value in ("arcLength", "normalized")
    if kind == "lane type":
        return value in _LANE_TYPES
    if kind in ("integer", "below zero"):
        return bool(_INTEGER.fullmatch(value)) and (kind == "integer" or int(value) < 0)
    if not _DOUBLE.fullmatch(value) or not math.isfinite(float(value)):
        return False
    return {"double": True, "zero or more": float(value) >= 0, "over zero": float(value) > 0}[kind]


def faults(content: bytes) -> list[str]:
    """Return what of a file is against the schema, and against the rules that it cannot express."""
    root = ElementTree.fromstring(content)
    if root.tag != "OpenDRIVE":
        return ["the root is no OpenDRIVE"]
    found: list[str] = []
    _check(root, "OpenDRIVE", found)
    if not found:
        for road in root.iter("road"):
            found += _road_faults(road)
        ids = [road.get("id") for road in root.iter("road")]
        found += ["two roads have one id"] if len(set(ids)) < len(ids) else []
    return found


def _check(element: ElementTree.Element, place: str, found: list[str]) -> None:
    rule = RULES.get(place)
    if rule is None:
        found.append(f"{place} is in no rule")
        return
    kinds = rule.required | rule.optional
    found += [f"{place} lacks {name}" for name in rule.required if name not in element.attrib]
    for name, value in element.attrib.items():
        if name not in kinds or not _is(kinds[name], value):
            found.append(f"{place} has {name}={value!r}")
    if (element.text or "").strip() and not rule.text:
        found.append(f"{place} holds text")
    tags = [child.tag for child in element]
    if rule.one_of:
        if len(tags) != 1 or tags[0] not in rule.one_of:
            found.append(f"{place} holds {tags}")
    else:
        order = [tag for tag, _, _ in rule.children]
        if any(tag not in order for tag in tags) or [order.index(tag) for tag in tags] != sorted(
            map(order.index, tags)
        ):
            found.append(f"{place} holds {tags[:5]} in this order")
            return
        for tag, least, most in rule.children:
            if not least <= tags.count(tag) <= (len(tags) if most is None else most):
                found.append(f"{place} holds {tags.count(tag)} {tag}")
    for child in element:
        _check(child, f"{element.tag}/{child.tag}", found)


def _road_faults(road: ElementTree.Element) -> list[str]:
    found = []
    pieces = road.findall("planView/geometry")
    starts = [float(piece.get("s", "")) for piece in pieces]
    ends = [start + float(piece.get("length", "")) for start, piece in zip(starts, pieces, strict=True)]
    length = float(road.get("length", ""))
    if starts[0] != 0 or any(abs(end - start) > 1e-9 for start, end in zip(starts[1:], ends[:-1], strict=True)):
        found.append("the pieces of the plan leave a gap or overlap")
    if abs(ends[-1] - length) > 1e-9:
        found.append("the road is not as long as its pieces")
    for cubic in road.iter("paramPoly3"):
        # 7.7.1: a piece begins at its own origin, in the direction of u.
        if [float(cubic.get(name, "")) for name in ("aU", "aV", "bV")] != [0, 0, 0] or float(cubic.get("bU", "")) <= 0:
            found.append("a cubic does not begin where its piece does")
    for series in ("elevationProfile/elevation", "lanes/laneOffset", "lanes/laneSection"):
        at = [float(element.get("s", "")) for element in road.findall(series)]
        if at and (at[0] != 0 or at != sorted(set(at)) or at[-1] >= length):
            found.append(f"{series} does not ascend from 0 within the road")
    for section in road.findall("lanes/laneSection"):
        lanes = [lane.get("id") for lane in section.iter("lane")]
        if lanes.count("0") != 1 or len(set(lanes)) < len(lanes) or len(lanes) < 2:
            found.append("a section has not one centre lane and others beside it")
    return found

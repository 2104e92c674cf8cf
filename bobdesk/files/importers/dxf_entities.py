"""The lines in a DXF drawing's model space; needs ezdxf and runs in `dxf_worker`."""

from __future__ import annotations

import io
from collections import Counter
from collections.abc import Iterable, Iterator

import numpy as np
from ezdxf import recover
from ezdxf.entities.dxfentity import DXFEntity
from ezdxf.entities.insert import Insert
from ezdxf.entities.lwpolyline import LWPolyline
from ezdxf.entities.polyline import Polyline
from ezdxf.lldxf.const import DXFError
from ezdxf.path import make_path

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError

_CURVES = frozenset({"LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE"})
_DEEPEST = 8
_MOST_ENTITIES = 200_000
_FLATNESS_M = 1e-3
_METRES = 6
# The drawing's $INSUNITS: name and metres.
_UNITS = {
    1: ("inches", 0.0254),
    2: ("feet", 0.3048),
    4: ("millimetres", 1e-3),
    5: ("centimetres", 1e-2),
    7: ("kilometres", 1e3),
    10: ("yards", 0.9144),
    14: ("decimetres", 0.1),
}


def dxf_paths(data: bytes) -> tuple[list[FloatArray], list[str]]:
    """Return the paths, (n_i, 3), m, of the model space, and what was left out or assumed.

    Curves become points at most 1 mm off. An elevation of 0 everywhere is for the caller to judge.

    Raises
    ------
    InputError
        If it is no DXF, or holds too many entities. Damaged drawings may raise anything.
    """
    # ezdxf repairs what is cut off, and would return a part of the track without a word.
    if b"EOF" not in data[-100:]:
        raise InputError("this is no DXF drawing, or it ends too early")
    try:
        document, _ = recover.read(io.BytesIO(data))
    except DXFError as error:
        raise InputError("this is no DXF drawing, or it is damaged") from error
    factor, notes = _factor(int(document.header.get("$INSUNITS", 0)))
    paths: list[FloatArray] = []
    left_out: Counter[str] = Counter()
    for number, entity in enumerate(_entities(document.modelspace(), 0)):
        if number >= _MOST_ENTITIES:
            raise InputError(f"the drawing has over {_MOST_ENTITIES:,} entities; leave only the track in it")
        if entity.dxftype() in _CURVES:
            paths.append(factor * _points(entity, _FLATNESS_M / factor))
        else:
            left_out[entity.dxftype()] += 1
    if left_out:
        kinds = ", ".join(f"{count:,} {kind}" for kind, count in left_out.most_common(4))
        notes.append(f"what is no line was left out ({kinds})")
    return [path for path in paths if len(path) >= 2], notes


def _factor(unit: int) -> tuple[float, list[str]]:
    if unit == _METRES:
        return 1.0, []
    if unit in _UNITS:
        title, metres = _UNITS[unit]
        return metres, [f"the drawing is in {title}; it was brought to metres"]
    return 1.0, ["the drawing names no unit, so metres were assumed"]


def _entities(entities: Iterable[DXFEntity], depth: int) -> Iterator[DXFEntity]:
    """Yield entities, those of blocks at the places where these are inserted."""
    for entity in entities:
        if isinstance(entity, Insert):
            if depth < _DEEPEST:
                yield from _entities(entity.virtual_entities(), depth + 1)
        else:
            yield entity


def _points(entity: DXFEntity, tolerance: float) -> FloatArray:
    """Return the points of an entity, (n, 3), in the drawing's unit."""
    if isinstance(entity, Polyline) and entity.is_3d_polyline and not entity.is_closed:
        return np.array([vertex.dxf.location.xyz for vertex in entity.vertices if not vertex.dxf.flags & 16]).reshape(
            -1, 3
        )
    if isinstance(entity, Polyline) and not (entity.is_2d_polyline or entity.is_3d_polyline):
        return np.zeros((0, 3))  # a mesh
    if isinstance(entity, LWPolyline) and not entity.has_arc and not entity.closed:
        flat = np.array(entity.get_points("xy"), dtype=np.float64).reshape(-1, 2)
        if tuple(entity.dxf.extrusion) == (0.0, 0.0, 1.0):
            return np.column_stack([flat, np.full(len(flat), float(entity.dxf.elevation))])
    path = make_path(entity)
    return np.array([point.xyz for point in path.flattening(tolerance)], dtype=np.float64).reshape(-1, 3)

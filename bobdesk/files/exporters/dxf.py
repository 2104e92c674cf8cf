"""DXF of release 12, which every CAD program reads: one 3D polyline, in metres."""

from __future__ import annotations

from bobdesk.track.centreline3d import Centreline3D

_LAYER = "CENTRELINE"
_3D_POLYLINE, _3D_VERTEX = 8, 32


def to_dxf(line: Centreline3D) -> bytes:
    """Return a line as an ASCII DXF drawing.

    Release 12 has no place for the unit; a comment at the top names it. Written by hand, since it is
    little and exporting must not depend on ezdxf.
    """
    low, high = line.points.min(axis=0).tolist(), line.points.max(axis=0).tolist()
    pairs: list[tuple[int, object]] = [
        (999, "BobDesk, unit: metre"),
        (0, "SECTION"),
        (2, "HEADER"),
        (9, "$ACADVER"),
        (1, "AC1009"),
        (9, "$EXTMIN"),
        *_place(low),
        (9, "$EXTMAX"),
        *_place(high),
        (0, "ENDSEC"),
        (0, "SECTION"),
        (2, "TABLES"),
        (0, "TABLE"),
        (2, "LAYER"),
        (70, 1),
        (0, "LAYER"),
        (2, _LAYER),
        (70, 0),
        (62, 7),
        (6, "CONTINUOUS"),
        (0, "ENDTAB"),
        (0, "ENDSEC"),
        (0, "SECTION"),
        (2, "ENTITIES"),
        (0, "POLYLINE"),
        (8, _LAYER),
        (66, 1),
        *_place([0.0, 0.0, 0.0]),
        (70, _3D_POLYLINE),
    ]
    for point in line.points.tolist():
        pairs += [(0, "VERTEX"), (8, _LAYER), *_place(point), (70, _3D_VERTEX)]
    pairs += [(0, "SEQEND"), (8, _LAYER), (0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code:3d}\r\n{value}\r\n" for code, value in pairs).encode("ascii")


def _place(point: list[float]) -> list[tuple[int, object]]:
    return [(code, f"{value:.6f}") for code, value in zip((10, 20, 30), point, strict=True)]

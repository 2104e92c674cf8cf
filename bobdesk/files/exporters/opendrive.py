"""OpenDRIVE 1.6: one road along the centreline, for driving and sled simulators."""

from __future__ import annotations

from bobdesk.files.exporters.opendrive_pieces import (
    ElevationPiece,
    PlanPiece,
    elevation_pieces,
    plan_pieces,
    stations_of_arc,
)
from bobdesk.plan.projection import Georeference
from bobdesk.track.centreline3d import Centreline3D

_WIDTH_M = 1.4  # of a bobsleigh track between its walls, roughly; the centreline does not depend on it


def to_opendrive(line: Centreline3D, *, georeference: Georeference | None = None) -> bytes:
    """Return a line as OpenDRIVE.

    The reference line is the centreline in plan, made of paramPoly3 within 1 mm of every row; the
    elevation profile passes every row within 0.1 mm. One lane of 1.4 m lies with its middle on it.

    References
    ----------
    ASAM OpenDRIVE 1.6, 7.4 (geometry), 8.4 (elevation), 9 (lanes).
    """
    stations, tangents = stations_of_arc(line)
    low, high = line.points.min(axis=0).tolist(), line.points.max(axis=0).tolist()
    length = _number(float(stations[-1]))
    rows = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        "<OpenDRIVE>",
        f'<header revMajor="1" revMinor="6" name="centreline" version="1" north="{_number(high[1])}"'
        f' south="{_number(low[1])}" east="{_number(high[0])}" west="{_number(low[0])}">',
        *_place(georeference),
        "</header>",
        f'<road name="centreline" length="{length}" id="1" junction="-1">',
        "<planView>",
        *(_geometry(piece) for piece in plan_pieces(line, stations, tangents)),
        "</planView>",
        "<elevationProfile>",
        *(_elevation(piece) for piece in elevation_pieces(line, stations)),
        "</elevationProfile>",
        "<lanes>",
        f'<laneOffset s="0" a="{_WIDTH_M / 2}" b="0" c="0" d="0"/>',
        '<laneSection s="0">',
        '<center><lane id="0" type="none" level="false"/></center>',
        f'<right><lane id="-1" type="driving" level="false"><width sOffset="0" a="{_WIDTH_M}" b="0" c="0" d="0"/>'
        "</lane></right>",
        "</laneSection>",
        "</lanes>",
        "</road>",
        "</OpenDRIVE>",
    ]
    return ("\n".join(rows) + "\n").encode()


def _place(georeference: Georeference | None) -> list[str]:
    if georeference is None:
        return []
    return [
        f"<geoReference><![CDATA[+proj=tmerc +lat_0={georeference.latitude!r} +lon_0={georeference.longitude!r}"
        " +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs]]></geoReference>"
    ]


def _geometry(piece: PlanPiece) -> str:
    u, v = ([_number(value) for value in values] for values in (piece.u, piece.v))
    return (
        f'<geometry s="{_number(piece.station)}" x="{_number(piece.x)}" y="{_number(piece.y)}"'
        f' hdg="{_number(piece.heading)}" length="{_number(piece.length)}">'
        f'<paramPoly3 aU="{u[0]}" bU="{u[1]}" cU="{u[2]}" dU="{u[3]}" aV="{v[0]}" bV="{v[1]}" cV="{v[2]}" dV="{v[3]}"'
        ' pRange="arcLength"/></geometry>'
    )


def _elevation(piece: ElevationPiece) -> str:
    a, b, c, d = (_number(value) for value in piece.coefficients)
    return f'<elevation s="{_number(piece.station)}" a="{a}" b="{b}" c="{c}" d="{d}"/>'


def _number(value: float) -> str:
    return f"{value + 0.0:.15g}"

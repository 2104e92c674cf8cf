"""One track on a slope in the Alps, written in every format that is read."""

from __future__ import annotations

import io
import json
import zipfile

import ezdxf
import numpy as np
import pyproj

from bobdesk.files.project_archive import archive_bytes
from bobdesk.files.project_encoding import encode_project
from bobdesk.plan.polyline import Polyline
from bobdesk.project import edits
from bobdesk.project.project import Project, SourceLine

# A track of 60 points with a curve to each side, about 590 m long, falling 59 m.
STATION = np.linspace(0.0, 590.0, 60)
PLAN = np.column_stack([STATION, 60 * np.sin(STATION / 90)]).round(3)
Z = (1059.0 - 0.1 * STATION).round(3)
_UTM = pyproj.Transformer.from_crs("EPSG:4326", "EPSG:25832", always_xy=True)
LON, LAT = _UTM.transform(720_000 + PLAN[:, 0], 5_160_000 + PLAN[:, 1], direction="INVERSE")
PLACES = np.column_stack([LON, LAT])


def metres_by_pyproj(degrees):
    """Project beside the first point by PROJ."""
    local = f"+proj=tmerc +lat_0={degrees[0][1]} +lon_0={degrees[0][0]} +k=1 +datum=WGS84 +units=m"
    x, y = pyproj.Transformer.from_crs("EPSG:4326", local, always_xy=True).transform(*np.transpose(degrees))
    return np.column_stack([x, y])


def kml(places=PLACES, z=Z):
    rows = "\n".join(f"{x!r},{y!r},{h!r}" for (x, y), h in zip(places.tolist(), z.tolist(), strict=True))
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n<kml xmlns="http://www.opengis.net/kml/2.2"><Document><Placemark>'
        f"<LineString><coordinates>\n{rows}\n</coordinates></LineString></Placemark></Document></kml>"
    ).encode()


def kmz(content=None, name="doc.kml"):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, kml() if content is None else content)
    return buffer.getvalue()


def gpx():
    points = "".join(
        f'<trkpt lat="{y!r}" lon="{x!r}"><ele>{h!r}</ele><time>2026-01-01T00:00:00Z</time></trkpt>'
        for (x, y), h in zip(PLACES.tolist(), Z.tolist(), strict=True)
    )
    return (
        '<?xml version="1.0"?><gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1">'
        f'<wpt lat="1" lon="2"/><trk><name>t</name><trkseg>{points}</trkseg></trk></gpx>'
    ).encode()


def geojson():
    rows = [[x, y, h] for (x, y), h in zip(PLACES.tolist(), Z.tolist(), strict=True)]
    feature = {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": rows}}
    return json.dumps({"type": "FeatureCollection", "features": [feature]}).encode()


def _osm_parts():
    """The track in three ways, the middle one drawn backwards, beside a footpath."""
    return [
        (1, list(range(20)), {"sport": "bobsleigh;luge"}),
        (2, list(range(19, 40))[::-1], {"sport": "luge", "leisure": "track"}),
        (3, list(range(39, 60)), {"sport": "bobsleigh"}),
        (4, [59, 0], {"highway": "footway"}),
        (5, [0, 10, 30, 0], {"sport": "bobsleigh", "leisure": "sports_centre"}),
    ]


def osm_xml():
    nodes = "".join(f'<node id="{i}" lat="{y!r}" lon="{x!r}" version="1"/>' for i, (x, y) in enumerate(PLACES.tolist()))
    ways = "".join(
        f'<way id="{number}">'
        + "".join(f'<nd ref="{node}"/>' for node in refs)
        + "".join(f'<tag k="{key}" v="{value}"/>' for key, value in tags.items())
        + "</way>"
        for number, refs, tags in _osm_parts()
    )
    return f'<?xml version="1.0" encoding="UTF-8"?><osm version="0.6">{nodes}{ways}</osm>'.encode()


def overpass(*, geometry=False):
    elements = (
        [] if geometry else [{"type": "node", "id": i, "lat": y, "lon": x} for i, (x, y) in enumerate(PLACES.tolist())]
    )
    for number, refs, tags in _osm_parts():
        way = {"type": "way", "id": number, "nodes": refs, "tags": tags}
        if geometry:
            way["geometry"] = [{"lat": PLACES[i, 1], "lon": PLACES[i, 0]} for i in refs]
        elements.append(way)
    return json.dumps({"version": 0.6, "elements": elements}).encode()


def svg():
    steps = " ".join(f"{x!r},{-y!r}" for x, y in PLAN.tolist())
    return (
        '<?xml version="1.0"?>\n<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN"'
        ' "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 600 100">'
        f'<rect width="3" height="3"/><path d="M{steps}"/></svg>'
    ).encode()


def csv_text():
    rows = "".join(f"{x:.3f},{y:.3f},{h:.3f}\n" for (x, y), h in zip(PLAN.tolist(), Z.tolist(), strict=True))
    return ("x_m,y_m,z_m\n" + rows).encode()


def dxf(*, units=6):
    drawing = ezdxf.new("R2010")
    drawing.header["$INSUNITS"] = units
    scale = {6: 1.0, 4: 1000.0}[units]
    points = scale * np.column_stack([PLAN, Z])
    space = drawing.modelspace()
    space.add_polyline3d(points[:30])
    space.add_polyline3d(points[29:])
    space.add_text("START")
    stream = io.StringIO()
    drawing.write(stream)
    return stream.getvalue().encode()


def bobdesk():
    source = SourceLine("plan.csv", Polyline(PLAN), LON[0], LAT[0])
    project = edits.set_length(edits.open_coordinates(Project(name="Made"), source), 620.0)
    return archive_bytes(encode_project(edits.set_drop(project, 55.0)))


ALL = {
    "csv": csv_text,
    "kml": kml,
    "kmz": kmz,
    "gpx": gpx,
    "geojson": geojson,
    "osm": osm_xml,
    "json": overpass,
    "svg": svg,
    "dxf": dxf,
    "bobdesk": bobdesk,
}

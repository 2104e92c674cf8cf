"""GeoJSON (RFC 7946): one LineString in longitude, latitude and elevation."""

from __future__ import annotations

import json

from bobdesk.files.importers.geojson import ORIGIN
from bobdesk.plan.projection import Georeference, to_degrees
from bobdesk.track.centreline3d import Centreline3D
from bobdesk.track.figures import figures

DEGREE_DECIMALS = 11  # a micrometre, as LINE.csv has


def to_geojson(line: Centreline3D, *, georeference: Georeference) -> bytes:
    """Return a line as GeoJSON; elevations count from the lowest point.

    The plan's origin goes with it in a foreign member, so that reading it gives the same x and y.
    """
    degrees = to_degrees(line.points[:, :2], georeference).tolist()
    coordinates = [
        [round(longitude, DEGREE_DECIMALS), round(latitude, DEGREE_DECIMALS), round(z, 6)]
        for (longitude, latitude), z in zip(degrees, line.elevations.tolist(), strict=True)
    ]
    found = figures(line)
    document = {
        "type": "FeatureCollection",
        ORIGIN: [georeference.longitude, georeference.latitude],
        "features": [
            {
                "type": "Feature",
                "properties": {
                    "name": "centreline",
                    "length_m": round(found.length, 6),
                    "drop_m": round(found.drop, 6),
                    "elevations": "metres above the lowest point",
                },
                "geometry": {"type": "LineString", "coordinates": coordinates},
            }
        ],
    }
    return (json.dumps(document, allow_nan=False) + "\n").encode()

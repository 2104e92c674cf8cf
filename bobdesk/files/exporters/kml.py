"""KML for Google Earth: one LineString, shown on the ground."""

from __future__ import annotations

from bobdesk.files.exporters.geojson import DEGREE_DECIMALS
from bobdesk.files.importers.kml import ORIGIN
from bobdesk.plan.projection import Georeference, to_degrees
from bobdesk.track.centreline3d import Centreline3D

_DOCUMENT = """<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2">
<Document>
<name>centreline</name>
<Placemark>
<name>centreline</name>
<description>Elevations are metres above the lowest point.</description>
<ExtendedData><Data name="{key}"><value>{longitude!r},{latitude!r}</value></Data></ExtendedData>
<LineString>
<altitudeMode>clampToGround</altitudeMode>
<tessellate>1</tessellate>
<coordinates>
{coordinates}
</coordinates>
</LineString>
</Placemark>
</Document>
</kml>
"""


def to_kml(line: Centreline3D, *, georeference: Georeference) -> bytes:
    """Return a line as KML.

    Elevations count from the lowest point, so Google Earth is told to lay the line on the ground;
    they stand in the coordinates all the same.
    """
    degrees = to_degrees(line.points[:, :2], georeference).tolist()
    rows = [
        f"{longitude:.{DEGREE_DECIMALS}f},{latitude:.{DEGREE_DECIMALS}f},{z:.6f}"
        for (longitude, latitude), z in zip(degrees, line.elevations.tolist(), strict=True)
    ]
    text = _DOCUMENT.format(
        key=ORIGIN,
        longitude=georeference.longitude,
        latitude=georeference.latitude,
        coordinates="\n".join(rows),
    )
    return text.encode()

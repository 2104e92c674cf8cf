"""Control points in QGIS's `.points` text, read and written."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from bobdesk.errors import InputError
from bobdesk.plan.control_points import ControlPoint

# QGIS counts columns from the picture's left edge and rows, as negative numbers, from its top edge, so
# the centre of the top left pixel is (0.5, -0.5); ours is (0, 0). See QGIS's sources: qgsgcplist.cpp
# (saveGcps, loadGcps: the columns, comma or tab, enable optional) and qgsgcptransformer.cpp, which hands
# x and -y to GDAL as pixel and line. Those count from the corner of the top left pixel (GDAL, "Raster Data
# Model", affine geotransform).
_HALF = 0.5
_OLD_X, _NEW_X = "pixelx", "sourcex"
_CRS = "#CRS:"


@dataclass(frozen=True)
class QgisPoints:
    """The `points` of a file, and its coordinate system `crs` as text ("" in files of old QGIS)."""

    points: tuple[ControlPoint, ...]
    crs: str


def parse_qgis_points(text: str, *, name: str) -> QgisPoints:
    """Return the control points in the text of a `.points` file, old (pixelX) or new (sourceX).

    Parameters
    ----------
    text
        The whole file.
    name
        What to call it in a sentence.

    Raises
    ------
    InputError
        If it is no such file, its positions are not in metres, or its picture had a position of its
        own, since pixels are then not what it counts in.
    """
    crs = ""
    heading: list[str] | None = None
    points: list[ControlPoint] = []
    for number, line in enumerate(text.lstrip("\ufeff").splitlines(), start=1):
        if line.startswith(_CRS):
            crs = line[len(_CRS) :].strip()
        elif heading is None and line.strip() and not line.startswith("#"):
            heading = _heading(line, name=name, number=number)
        elif line.strip() and not line.startswith("#"):
            points.append(_point(line, name=name, number=number, count=len(points) + 1))
    if heading is None:
        raise InputError(f"{name} is not a QGIS .points file: it has no line that names the columns.")
    _check_metres(crs, name=name)
    # A click a little above the picture is positive too, hence most of them.
    above = sum(1 for point in points if point.y_px + _HALF < 0)
    if points and above * 2 > len(points):
        raise InputError(
            f"{name} counts upwards, not in pixels from the top: the picture already had a position when the "
            "points were set in QGIS; set them on the picture without it."
        )
    return QgisPoints(tuple(points), crs)


def format_qgis_points(points: Sequence[ControlPoint], *, crs: str = "") -> str:
    """Return the text of a `.points` file as QGIS 3.26 and later write it.

    The residuals are written as 0: QGIS computes its own when it opens the file.

    Parameters
    ----------
    points
        Control points; those not used are written as not enabled.
    crs
        Coordinate system as QGIS writes it, for example the `crs` of a file read before.
    """
    lines = [f"{_CRS} {crs}", "mapX,mapY,sourceX,sourceY,enable,dX,dY,residual"]
    for point in points:
        source_x, source_y = point.x_px + _HALF, -(point.y_px + _HALF)
        lines.append(f"{point.x_m!r},{point.y_m!r},{source_x!r},{source_y!r},{int(point.used)},0,0,0")
    return "\n".join(lines) + "\n"


def _cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.split("," if "," in line else "\t")]


def _heading(line: str, *, name: str, number: int) -> list[str]:
    heading = [cell.lower() for cell in _cells(line)]
    if heading[:2] != ["mapx", "mapy"] or heading[2:3] not in ([_OLD_X], [_NEW_X]):
        raise InputError(
            f"{name}, line {number}: a QGIS .points file begins with mapX,mapY,sourceX,sourceY, not with {line[:40]!r}."
        )
    return heading


def _point(line: str, *, name: str, number: int, count: int) -> ControlPoint:
    cells = _cells(line)
    if len(cells) < 4:
        raise InputError(f"{name}, line {number}: a control point has four numbers, not {len(cells)}.")
    try:
        x_m, y_m, source_x, source_y = (float(cell) for cell in cells[:4])
        used = len(cells) < 5 or bool(int(float(cells[4])))
        return ControlPoint(source_x - _HALF, -source_y - _HALF, x_m, y_m, name=str(count), used=used)
    except (ValueError, OverflowError, InputError):
        raise InputError(f"{name}, line {number}: {line[:60]!r} is not a control point in numbers.") from None


def _check_metres(crs: str, *, name: str) -> None:
    if crs.startswith(("GEOGCS", "GEOGCRS", "GEODCRS", "GEODETICCRS", "EPSG:4326", "OGC:CRS84")):
        raise InputError(
            f"{name} gives longitude and latitude in degrees; set the points in QGIS in a system that counts "
            "metres, such as UTM."
        )
    if "Pseudo-Mercator" in crs or crs.startswith("EPSG:3857"):
        raise InputError(
            f"{name} is in Web Mercator, whose metres are longer than metres on the ground (by half in the "
            "Alps); set the points in QGIS in a system such as UTM."
        )

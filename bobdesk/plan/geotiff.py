"""The tags of a GeoTIFF that place it in the world."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from bobdesk.errors import InputError
from bobdesk.plan.world import PixelToWorld, checked_world

PIXEL_SCALE, TIE_POINTS, TRANSFORMATION, GEO_KEYS = 33550, 33922, 34264, 34735

# GeoTIFF key numbers and values, OGC 19-008r4 sections 7.4 and 7.5
_MODEL_TYPE, _RASTER_TYPE, _PROJECTED_SYSTEM, _LINEAR_UNIT = 1024, 1025, 3072, 3076
_GEOGRAPHIC, _PIXEL_IS_POINT, _WEB_MERCATOR = 2, 2, 3857
_METRES_PER_UNIT = {9001: 1.0, 9002: 0.3048, 9003: 1200 / 3937}


def geotiff_world(tags: Mapping[int, Any], *, name: str) -> PixelToWorld | None:
    """Return where the picture lies in metres, or None if its tags do not say.

    Parameters
    ----------
    tags
        TIFF tags by number, values as numbers or tuples of numbers.
    name
        What to call the file in a sentence.

    Raises
    ------
    InputError
        If the tags give degrees, Web Mercator (whose metres are not metres on the ground), an unknown
        unit, or no sense.

    References
    ----------
    OGC 19-008r4, GeoTIFF 1.1: ModelPixelScaleTag, ModelTiepointTag, ModelTransformationTag,
    GTRasterTypeGeoKey.
    """
    try:
        world = _placed(tags)
        keys = _geo_keys(tags)
    except (TypeError, ValueError, IndexError, OverflowError):
        raise InputError(f"{name} has GeoTIFF tags that make no sense, so they are not used.") from None
    if world is None:
        return None
    if keys.get(_MODEL_TYPE) == _GEOGRAPHIC:
        raise InputError(
            f"{name} is placed in degrees of longitude and latitude, not in metres; save it in a projected "
            "coordinate system such as UTM, or calibrate it by control points."
        )
    if keys.get(_PROJECTED_SYSTEM) == _WEB_MERCATOR:
        raise InputError(
            f"{name} is in Web Mercator, whose metres are longer than metres on the ground (by half in the "
            "Alps); save it in a system such as UTM, or calibrate it by control points."
        )
    unit = keys.get(_LINEAR_UNIT, 9001)
    if unit not in _METRES_PER_UNIT:
        raise InputError(f"{name} is placed in a unit of length that BobDesk does not know (EPSG {unit}).")
    # Tags count from the top left pixel's corner unless they say "pixel is point".
    half = 0.0 if keys.get(_RASTER_TYPE) == _PIXEL_IS_POINT else 0.5
    x_origin, y_origin = world.at(half, half)
    metres = _METRES_PER_UNIT[unit]
    a, b, _, d, e, _ = world.coefficients
    return checked_world(
        PixelToWorld(a * metres, b * metres, x_origin * metres, d * metres, e * metres, y_origin * metres),
        name=name,
    )


def _placed(tags: Mapping[int, Any]) -> PixelToWorld | None:
    """Return the position by the tags' own counting of pixels."""
    if TRANSFORMATION in tags:
        matrix = [float(number) for number in tags[TRANSFORMATION]]
        if len(matrix) != 16:
            raise ValueError("a transformation has 16 numbers")
        return PixelToWorld(matrix[0], matrix[1], matrix[3], matrix[4], matrix[5], matrix[7])
    if PIXEL_SCALE not in tags or TIE_POINTS not in tags:
        return None
    scale_x, scale_y = (float(number) for number in tags[PIXEL_SCALE][:2])
    column, row, _, x, y, _ = (float(number) for number in tags[TIE_POINTS][:6])
    if not all(map(math.isfinite, (scale_x, scale_y, column, row, x, y))):
        raise ValueError("not finite")
    return PixelToWorld(scale_x, 0.0, x - scale_x * column, 0.0, -scale_y, y + scale_y * row)


def _geo_keys(tags: Mapping[int, Any]) -> dict[int, int]:
    """Return the GeoKeys whose value is a short number, by key."""
    directory = [int(number) for number in tags.get(GEO_KEYS, ())]
    entries = [directory[at : at + 4] for at in range(4, len(directory) - 3, 4)]
    return {key: value for key, location, _, value in entries if location == 0}

"""Resolution and turn of a raster picture, as its own tags say them."""

from __future__ import annotations

import math
import struct
from typing import Any

from PIL import ExifTags, ImageFile
from PIL.JpegImagePlugin import JpegImageFile
from PIL.TiffImagePlugin import TiffImageFile

_BAD_TAG = (KeyError, TypeError, ValueError, SyntaxError, OverflowError, ZeroDivisionError, struct.error)
_INCH_PER_UNIT = {2: 1.0, 3: 2.54}  # TIFF ResolutionUnit: inch, centimetre


def orientation(picture: ImageFile.ImageFile) -> int:
    """Return the EXIF orientation, 1 to 8; 1 where there is none or it cannot be read."""
    try:
        value = int(picture.getexif().get(ExifTags.Base.Orientation, 1))
    except (*_BAD_TAG, OSError):
        return 1
    return value if 1 <= value <= 8 else 1


def file_dpi(picture: ImageFile.ImageFile) -> tuple[float, float] | None:
    """Return pixels per inch along x and y as stored, or None where the file does not say.

    Pillow alone is not asked: it makes up 72 dpi for a JPEG with broken EXIF and 1 dpi for a TIFF
    without the tags.
    """
    if isinstance(picture, TiffImageFile):
        return _from_exif(picture.tag_v2, default_unit=2)  # TIFF 6.0: the unit is the inch if not given
    if isinstance(picture, JpegImageFile):
        density = picture.info.get("jfif_density")
        unit = {1: 1.0, 2: 2.54}.get(picture.info.get("jfif_unit", 0))
        if density is not None and unit is not None:
            return _plausible(density[0] * unit, density[1] * unit)
    elif "dpi" in picture.info:
        try:
            return _plausible(*picture.info["dpi"])
        except _BAD_TAG:
            return None
    try:
        return _from_exif(picture.getexif(), default_unit=None)
    except (*_BAD_TAG, OSError):
        return None


def _from_exif(tags: Any, *, default_unit: int | None) -> tuple[float, float] | None:
    unit = _INCH_PER_UNIT.get(tags.get(ExifTags.Base.ResolutionUnit, default_unit))
    across, along = tags.get(ExifTags.Base.XResolution), tags.get(ExifTags.Base.YResolution)
    if unit is None or across is None or along is None:
        return None
    try:
        return _plausible(float(across) * unit, float(along) * unit)
    except _BAD_TAG:
        return None


def _plausible(across: float, along: float) -> tuple[float, float] | None:
    """Return the two numbers, or None where no scanner or printer can have meant them."""
    across, along = float(across), float(along)
    good = all(math.isfinite(number) and 5 <= number <= 25_000 for number in (across, along))
    # PNG stores whole pixels per metre: 300 dpi comes back as 299.9994.
    return (_whole(across), _whole(along)) if good else None


def _whole(dpi: float) -> float:
    return float(round(dpi)) if abs(dpi - round(dpi)) < 0.013 else dpi

"""From a picture that Pillow holds to read-only arrays: bool, grey or RGB."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, cast

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageFile

from bobdesk.errors import InputError
from bobdesk.plan.image import Pixels

_STRIP_PIXELS = 2_000_000  # work in strips of this size, so that conversions never hold a second picture
_WHITE = 255


def pixels_of(picture: ImageFile.ImageFile, *, name: str) -> tuple[Pixels, list[str]]:
    """Return the pixels of `picture` and one sentence for each thing that was changed.

    Grey stays grey, 1-bit stays bool; a palette of greys becomes grey; transparent parts become white.
    """
    picture.load()
    mode = picture.mode
    notes: list[str] = []
    if picture.has_transparency_data:
        pixels, transparent = _on_white(picture)
        if transparent:
            notes.append("Transparent parts were laid on white.")
        return pixels, notes
    if mode.startswith("I") or mode == "F":
        return _scaled(picture, name=name)
    if mode == "LAB":
        raise InputError(f"{name} stores its colours as CIE Lab; save it as RGB or grey.")
    if mode == "CMYK":
        notes.append("Its printing colours (CMYK) were converted to screen colours and may look different.")
    target = {"1": "1", "L": "L", "P": _palette_target(picture)}.get(mode, "RGB")
    return _filled(picture, target), notes


def is_deep_colour(picture: ImageFile.ImageFile) -> bool:
    """Tell whether a picture that is not loaded yet has 16 bits per colour, which Pillow reduces to 8."""
    return not picture.mode.startswith("I") and any(";16" in str(tile[3]) for tile in picture.tile)


def turned_pixels(pixels: Pixels, orientation: int) -> Pixels:
    """Return `pixels` turned and mirrored as the EXIF `orientation` (1 to 8) asks."""
    across = cast(Any, pixels)  # numpy's stubs lose the union of bool and uint8
    if orientation in (5, 6, 7, 8):
        across = across.swapaxes(0, 1)
    # After the swap: 5 as it is, 6 mirrored, 7 both, 8 upside down.
    if orientation in (2, 3, 6, 7):
        across = across[:, ::-1]
    if orientation in (3, 4, 7, 8):
        across = across[::-1]
    return cast(Pixels, np.ascontiguousarray(across))


def _strips(picture: Image.Image) -> Iterator[tuple[slice, Image.Image]]:
    width, height = picture.size
    rows = max(1, _STRIP_PIXELS // width)
    for top in range(0, height, rows):
        bottom = min(height, top + rows)
        yield slice(top, bottom), picture.crop((0, top, width, bottom))


def _filled(picture: Image.Image, target: str) -> Pixels:
    width, height = picture.size
    shape = (height, width, 3) if target == "RGB" else (height, width)
    pixels: Pixels = np.empty(shape, dtype=np.uint8)
    if target == "1":
        pixels = pixels.view(np.bool_)
    for rows, strip in _strips(picture):
        pixels[rows] = np.asarray(strip if strip.mode == target else strip.convert(target))
    return pixels


def _palette_target(picture: Image.Image) -> str:
    """Return "L" if every colour of the palette is a grey, else "RGB"."""
    colours = picture.getpalette("RGB") if picture.mode == "P" else None
    if colours is None:
        return "RGB"
    table = np.array(colours).reshape(-1, 3)
    return "L" if bool((table == table[:, :1]).all()) else "RGB"


def _on_white(picture: Image.Image) -> tuple[Pixels, bool]:
    """Return the picture on white, and whether any of it was transparent."""
    grey = picture.mode in ("1", "L", "LA", "La", "I;16", "I")
    mode = "LA" if grey else "RGBA"
    width, height = picture.size
    pixels = np.empty((height, width) if grey else (height, width, 3), dtype=np.uint8)
    transparent = False
    for rows, strip in _strips(picture):
        values = np.asarray(strip if strip.mode == mode else strip.convert(mode))
        alpha = values[..., -1]
        colour = values[..., 0] if grey else values[..., :3]
        if int(alpha.min()) == _WHITE:
            pixels[rows] = colour
            continue
        transparent = True
        share = alpha.astype(np.uint16) if grey else alpha[..., None].astype(np.uint16)
        pixels[rows] = (colour * share + _WHITE * (_WHITE - share) + _WHITE // 2) // _WHITE
    return pixels, transparent


def _scaled(picture: Image.Image, *, name: str) -> tuple[Pixels, list[str]]:
    """Return deep grey (16 or 32 bits, or floating point) as 8 bits."""
    low, high = np.inf, -np.inf
    for _, strip in _strips(picture):
        values = _finite(strip)
        if values.size:
            low, high = min(low, float(values.min())), max(high, float(values.max()))
    if not low <= high:
        raise InputError(f"{name} holds no brightness: none of its values is a number.")
    if low >= 0 and high <= 65535 and picture.mode != "F":
        # The smallest usual depth that holds the brightest pixel, so 12-bit scans do not come out black.
        low, high = 0.0, float(next(top for top in (255, 1023, 4095, 16383, 65535) if high <= top))
        notes = [f"Its grey levels from 0 to {high:.0f} were reduced to 256."]
    else:
        notes = [f"Its values from {low:g} to {high:g} were spread over 256 grey levels."]
    width, height = picture.size
    pixels = np.empty((height, width), dtype=np.uint8)
    factor = _WHITE / (high - low) if high > low else 0.0
    for rows, strip in _strips(picture):
        values = np.nan_to_num(np.asarray(strip).astype(np.float32), nan=low, posinf=high, neginf=low)
        pixels[rows] = np.clip((values - low) * factor + 0.5, 0, _WHITE)
    return pixels, notes


def _finite(strip: Image.Image) -> npt.NDArray[Any]:
    values = np.asarray(strip)
    return values[np.isfinite(values)] if values.dtype.kind == "f" else values.ravel()

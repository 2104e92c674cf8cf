"""Pixels of a plan as numbers: checks, area-average copies, Lab colours, sampling between pixels.

Pixels are a read-only array: (h, w) bool (True is white), (h, w) uint8 or uint16 grey, (h, w, 3) uint8
RGB or (h, w, 4) uint8 RGBA, which is seen over white.  Grey pictures keep one channel (L) all the way:
a scan costs a third of a colour picture.
"""

from __future__ import annotations

from collections.abc import Generator
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError

Pixels = npt.NDArray[Any]
Float32Array = npt.NDArray[np.float32]

# Values a strip may hold: some 10 ms of work and 8 MB, so that a caller can stop in time.
_STRIP_VALUES = 2_000_000
_SMALLEST_SIDE = 8


def check_pixels(pixels: Pixels) -> None:
    """Raise InputError unless `pixels` is one of the five layouts this package reads."""
    grey = pixels.ndim == 2 and pixels.dtype in (np.bool_, np.uint8, np.uint16)
    colour = pixels.ndim == 3 and pixels.shape[2] in (3, 4) and pixels.dtype == np.uint8
    if not (grey or colour):
        raise InputError(
            f"The picture has the layout {pixels.shape} of {pixels.dtype}; 1-bit, 8 and 16-bit grey, "
            "RGB and RGBA pictures can be traced."
        )
    if min(pixels.shape[:2]) < _SMALLEST_SIDE:
        height, width = pixels.shape[:2]
        raise InputError(f"The picture is only {width} x {height} pixels large, too small to trace a line.")


def grey_range(pixels: Pixels) -> tuple[float, float]:
    """Return the values of black and white: for 16 bits the range in use, seen on every 7th pixel.

    A 16-bit scan often fills a small part of its range; the others use all of theirs.
    """
    if pixels.dtype == np.uint16:
        sample = pixels[::7, ::7]
        low, high = float(sample.min()), float(sample.max())
        return (low, high) if high > low else (0.0, 65535.0)
    return (0.0, 1.0) if pixels.dtype == np.bool_ else (0.0, 255.0)


def channels_of(pixels: Pixels) -> int:
    """Return 3 for a colour picture and 1 for a grey one."""
    return 1 if pixels.ndim == 2 else 3


def to_channels(values: npt.NDArray[Any], *, black: float, white: float) -> Float32Array:
    """Turn picture values (..., 1, 3 or 4) over white into sRGB or grey 0 to 255 (..., 1 or 3)."""
    numbers = values.astype(np.float32)
    if values.shape[-1] == 4:
        opaque = numbers[..., 3:] / np.float32(255.0)
        over: Float32Array = numbers[..., :3] * opaque + np.float32(255.0) * (1 - opaque)
        return over
    if (black, white) != (0.0, 255.0):
        numbers -= np.float32(black)
        numbers *= np.float32(255.0 / (white - black))
        np.clip(numbers, 0, 255, out=numbers)
    return numbers


def _linear_table() -> Float32Array:
    """The sRGB transfer curve at 0, 0.25 … 255 (IEC 61966-2-1)."""
    value = np.arange(1021) / 1020
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4).astype(np.float32)


_LINEAR = _linear_table()
# Rows: X/Xn, Y/Yn, Z/Zn of linear sRGB for D65.
_XYZ = np.array(
    [[0.433953, 0.376219, 0.189828], [0.212671, 0.715160, 0.072169], [0.017758, 0.109477, 0.872766]],
    dtype=np.float32,
)


def lab(colours: Float32Array) -> Float32Array:
    """Return CIE L*a*b* of sRGB (..., 3), or L* of grey (..., 1), values 0 to 255.

    References
    ----------
    CIE 15:2004; IEC 61966-2-1 for sRGB; D65 white.
    """
    index = np.clip(colours * np.float32(4.0) + np.float32(0.5), 0, 1020).astype(np.int16)
    linear = _LINEAR[index]
    relative = linear if colours.shape[-1] == 1 else linear @ _XYZ.T
    root = np.where(relative > 0.008856, np.cbrt(relative), np.float32(7.787) * relative + np.float32(16 / 116))
    if colours.shape[-1] == 1:
        return np.asarray(116 * root - 16, dtype=np.float32)
    x, y, z = root[..., 0], root[..., 1], root[..., 2]
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1).astype(np.float32)


def copy_size(height: int, width: int, *, megapixels: float) -> tuple[int, int]:
    """Return (height, width) of the copy with at most `megapixels`, never larger than the picture."""
    factor = min(1.0, (megapixels * 1e6 / (height * width)) ** 0.5)
    return max(1, round(height * factor)), max(1, round(width * factor))


def _averaged(strip: Pixels, *, rows: int, columns: int, top: float, bottom: float) -> npt.NDArray[Any]:
    """Area average of the rows `top` to `bottom` (may be fractions) of `strip` as `rows` x `columns`."""
    box = (0.0, top, float(strip.shape[1]), bottom)
    if strip.dtype == np.uint16:
        picture = Image.fromarray(strip.astype(np.float32))
    elif strip.dtype == np.bool_:
        picture = Image.fromarray(strip.astype(np.uint8) * np.uint8(255))
    elif strip.ndim == 3 and strip.shape[2] == 4:
        # Over white first: the colour of what is transparent must not bleed into its neighbours.
        over = to_channels(strip, black=0.0, white=255.0)
        picture = Image.fromarray((over + np.float32(0.5)).astype(np.uint8))
    else:
        picture = Image.fromarray(strip)
    return np.asarray(picture.resize((columns, rows), Image.Resampling.BOX, box=box))


def area_average(pixels: Pixels, *, height: int, width: int) -> Generator[float, None, Float32Array]:
    """Area-average copy, (height, width, 1 or 3) sRGB or grey 0 to 255; yields the fraction done.

    Works in strips, so that neither memory nor the time between two yields grows with the picture.
    """
    black, white = grey_range(pixels)
    if pixels.dtype == np.bool_:
        white = 255.0
    full_height, full_width = pixels.shape[:2]
    copy = np.empty((height, width, channels_of(pixels)), dtype=np.float32)
    per_row = full_width * (1 if pixels.ndim == 2 else pixels.shape[2]) * max(1, full_height / height)
    rows = max(1, int(_STRIP_VALUES / per_row))
    for first in range(0, height, rows):
        last = min(height, first + rows)
        top, bottom = first * full_height / height, last * full_height / height
        upper, lower = int(top), min(full_height, int(np.ceil(bottom)))
        strip = np.ascontiguousarray(pixels[upper:lower])
        averaged = _averaged(strip, rows=last - first, columns=width, top=top - upper, bottom=bottom - upper)
        copy[first:last] = to_channels(averaged.reshape(last - first, width, -1), black=black, white=white)
        yield last / height
    return copy


def halved(pixels: Pixels) -> Generator[float, None, Pixels]:
    """Return the picture at half the size (2 x 2 means, an odd last row or column left out).

    1-bit pictures become 8-bit grey; the others keep their type.  Yields the fraction done.
    """
    height, width = pixels.shape[0] // 2, pixels.shape[1] // 2
    tail = pixels.shape[2:]
    kind = np.uint8 if pixels.dtype == np.bool_ else pixels.dtype
    half = np.empty((height, width, *tail), dtype=kind)
    rows = max(1, _STRIP_VALUES // (4 * max(1, width) * (tail[0] if tail else 1)))
    for first in range(0, height, rows):
        last = min(height, first + rows)
        strip = pixels[2 * first : 2 * last, : 2 * width]
        if pixels.dtype == np.bool_:
            strip = strip.astype(np.uint8) * np.uint8(255)
        total = strip[::2, ::2].astype(np.uint32)
        for part in (strip[1::2, ::2], strip[::2, 1::2], strip[1::2, 1::2]):
            total += part
        half[first:last] = (total + 2) // 4
        yield last / height
    return half


def halving_pyramid(pixels: Pixels, *, smallest: int = 1024) -> Generator[float, None, tuple[Pixels, ...]]:
    """Return the picture and its halves, quarters … until the longer side is at most `smallest` pixels."""
    levels = [pixels]
    yield 0.0
    while max(levels[-1].shape[:2]) > smallest and min(levels[-1].shape[:2]) >= 2:
        level = yield from halved(levels[-1])
        level.flags.writeable = False
        levels.append(level)
    return tuple(levels)


def sample(pixels: Pixels, x: FloatArray, y: FloatArray) -> Float32Array:
    """Bilinear colours at (x, y), arrays of one shape: (..., 1 or 3) sRGB or grey 0 to 255.

    Outside the picture its edge is repeated.
    """
    height, width = pixels.shape[:2]
    black, white = grey_range(pixels)
    x = np.clip(x, 0, width - 1)
    y = np.clip(y, 0, height - 1)
    left = np.minimum(x.astype(np.int32), width - 2)
    upper = np.minimum(y.astype(np.int32), height - 2)
    right_share = (x - left).astype(np.float32)[..., None]
    lower_share = (y - upper).astype(np.float32)[..., None]

    def at(rows: npt.NDArray[np.int32], columns: npt.NDArray[np.int32]) -> Float32Array:
        values = pixels[rows, columns]
        return to_channels(values.reshape(*x.shape, -1), black=black, white=white)

    above = at(upper, left) * (1 - right_share) + at(upper, left + 1) * right_share
    below = at(upper + 1, left) * (1 - right_share) + at(upper + 1, left + 1) * right_share
    return np.asarray(above * (1 - lower_share) + below * lower_share, dtype=np.float32)

"""PNG, JPEG, TIFF, WebP, BMP and GIF become pixels, by Pillow."""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from PIL import Image, ImageFile
from PIL.BmpImagePlugin import BmpImageFile
from PIL.GifImagePlugin import GifImageFile
from PIL.JpegImagePlugin import JpegImageFile
from PIL.PngImagePlugin import PngImageFile
from PIL.TiffImagePlugin import TiffImageFile
from PIL.WebPImagePlugin import WebPImageFile

from bobdesk.errors import InputError
from bobdesk.plan.geotiff import geotiff_world
from bobdesk.plan.image import BeforeDecoding, PictureHeader, PlanImage, check_size
from bobdesk.plan.picture_tags import file_dpi, orientation
from bobdesk.plan.pillow_pixels import is_deep_colour, pixels_of, turned_pixels
from bobdesk.plan.webp_size import webp_size
from bobdesk.plan.world import PixelToWorld, turned_world

# Opening by the plugin's class, not by Image.open, keeps every other of Pillow's seventy formats out
# (one of them starts Ghostscript). Multi-picture JPEGs of cameras open as their first picture.
_OPENERS: dict[str, Callable[[io.BytesIO], ImageFile.ImageFile]] = {
    "PNG": PngImageFile,
    "JPEG": JpegImageFile,
    "TIFF": TiffImageFile,
    "WEBP": WebPImageFile,
    "BMP": BmpImageFile,
    "GIF": GifImageFile,
}

# Pillow would warn from 89 megapixels and refuse from 179; a 400-megapixel scan is what people have.
Image.MAX_IMAGE_PIXELS = None


def decode_raster(
    data: bytes,
    kind: str,
    *,
    name: str,
    page: int,
    limit_megapixels: float,
    world: PixelToWorld | None,
    before_decoding: BeforeDecoding,
) -> PlanImage:
    """Return the picture in `data`, which is of the format `kind`; see `decode_picture`."""
    with _sentences(name, kind):
        if kind == "WEBP":
            # Its decoder takes the memory at once, so the size is read first.
            check_size(*webp_size(data, name=name), name=name, limit_megapixels=limit_megapixels)
        picture = _OPENERS[kind](io.BytesIO(data))
        frames = int(getattr(picture, "n_frames", 1))
    pages = frames if kind == "TIFF" else 1
    if page > pages:
        raise InputError(f"{name} has {pages} page{'s' if pages > 1 else ''}; there is no page {page}.")
    notes: list[str] = []
    if kind != "TIFF" and frames > 1:
        notes.append("The picture moves; its first frame is shown.")
    with _sentences(name, kind):
        if page > 1:
            picture.seek(page - 1)
    check_size(*picture.size, name=name, limit_megapixels=limit_megapixels)
    deep = is_deep_colour(picture)
    if isinstance(picture, TiffImageFile):
        # The file's own tags go before a world file, as in GIS programs.
        with _sentences(name, kind):
            tags = dict(picture.tag_v2)
        try:
            world = geotiff_world(tags, name=name) or world
        except InputError as reason:
            notes.append(str(reason))
    before_decoding(PictureHeader(kind, *picture.size, memory_bytes=_memory(picture, kind)))
    with _sentences(name, kind):
        # Not earlier: to find a PNG's EXIF, Pillow decodes the picture. Not later: it forgets a TIFF's.
        turn = orientation(picture)
        width, height = _stored_size(picture, turn)
        dpi = file_dpi(picture)
        pixels, changes = pixels_of(picture, name=name)
        if kind != "TIFF":  # Pillow has turned a TIFF itself when it was loaded
            pixels = turned_pixels(pixels, turn)
    notes.extend(changes)
    if deep:
        notes.append("Its 16 bits per colour were reduced to 8.")
    if turn != 1:
        notes.append("The picture was turned as its camera or scanner noted.")
        world = world and turned_world(world, orientation=turn, width=width, height=height)
        dpi = (dpi[1], dpi[0]) if dpi and turn >= 5 else dpi
    if dpi and abs(dpi[0] / dpi[1] - 1) > 0.01:
        notes.append(
            f"The file says its pixels are not square ({dpi[0]:g} × {dpi[1]:g} dpi), so distances across "
            "and along the picture differ; save it with square pixels first."
        )
    return PlanImage(pixels, dpi, pages, kind, tuple(notes), world)


def _stored_size(picture: ImageFile.ImageFile, turn: int) -> tuple[int, int]:
    """Return (width, height) as stored; Pillow gives a TIFF's size as it will be turned."""
    width, height = picture.size
    return (height, width) if isinstance(picture, TiffImageFile) and turn >= 5 else (width, height)


def _memory(picture: ImageFile.ImageFile, kind: str) -> int:
    """Return an upper estimate of the bytes that decoding takes: Pillow's copy, its buffers, and ours."""
    pixels = picture.width * picture.height
    pillow = 1 if picture.mode in ("1", "L", "P") else 2 if picture.mode.startswith("I;16") else 4
    buffers = {"TIFF": 4, "WEBP": 12, "GIF": 8}.get(kind, 0)  # a TIFF may be one single strip
    ours = 1 if pillow <= 2 and picture.mode != "P" else 3
    return pixels * (2 * pillow + buffers + 2 * ours)  # twice: it may have to be turned


@contextmanager
def _sentences(name: str, kind: str) -> Iterator[None]:
    """Turn whatever Pillow raises at bad bytes into one sentence."""
    try:
        yield
    except InputError:
        raise
    except MemoryError as error:
        raise InputError(f"There is not enough memory to open {name}.") from error
    except (EOFError, struct.error, zlib.error, OSError) as error:
        raise InputError(
            f"{name} is damaged or ends too early, so it cannot be read as a {kind} picture; copy or export it again."
        ) from error
    except SyntaxError as error:
        raise InputError(
            f"{name} begins like a {kind} picture but is damaged, cut off or of a rare kind; copy it again "
            "or save it as an ordinary PNG or TIFF."
        ) from error
    except Exception as error:
        # Pillow's plugins raise nearly anything at bad bytes (KeyError, TypeError, OverflowError ...).
        raise InputError(f"{name} is damaged and cannot be read as a {kind} picture.") from error

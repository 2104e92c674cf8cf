"""An SVG drawing becomes a picture, by resvg."""

from __future__ import annotations

import io

import numpy as np
import resvg_py
from PIL.PngImagePlugin import PngImageFile

from bobdesk.errors import InputError
from bobdesk.plan.image import (
    BeforeDecoding,
    PictureHeader,
    PlanImage,
    check_page_size,
    grey_if_grey,
)
from bobdesk.plan.pillow_pixels import pixels_of
from bobdesk.plan.svg_source import read_svg


def draw_svg(
    data: bytes,
    *,
    name: str,
    dpi: float,
    limit_megapixels: float,
    before_decoding: BeforeDecoding,
) -> PlanImage:
    """Return the drawing in `data` on white at `dpi`; see `decode_picture`.

    A drawing without colours comes back grey. Sizes in pixels count 96 an inch, as CSS has it; the
    picture's dpi is None then, since no real size was meant.
    """
    source = read_svg(data, name=name, dpi=dpi)
    check_page_size(source.width_inch, source.height_inch, dpi=dpi, name=name, limit=limit_megapixels)
    width = max(1, round(source.width_inch * dpi))
    height = max(1, round(source.height_inch * dpi))
    before_decoding(PictureHeader("SVG", width, height, width * height * 16))
    try:
        png = resvg_py.svg_to_bytes(
            svg_string=source.text,
            background="#ffffff",
            dpi=96.0,
            skip_system_fonts=not source.has_text,
        )
    except (ValueError, MemoryError) as error:
        raise InputError(f"{name} cannot be drawn: the SVG is damaged or repeats its own parts without end.") from error
    pixels, _ = pixels_of(PngImageFile(io.BytesIO(png)), name=name)
    pixels = grey_if_grey(pixels.astype(np.uint8, copy=False))
    notes = []
    if source.linked_pictures:
        notes.append("Pictures that the drawing links to but does not contain are not shown.")
    drawn = (pixels.shape[1] / source.width_inch, pixels.shape[0] / source.height_inch)
    return PlanImage(pixels, drawn if source.real_size else None, 1, "SVG", tuple(notes))

"""One page of a PDF becomes a picture, by pypdfium2."""

from __future__ import annotations

import math

import numpy as np
import pypdfium2 as pdfium  # type: ignore[import-untyped]

from bobdesk.errors import InputError
from bobdesk.plan.image import BeforeDecoding, PictureHeader, PlanImage, check_page_size, grey_if_grey

_POINTS_PER_INCH = 72.0
# pdfium gives sizes without it, and has no call that tells it.
_USER_UNIT = (
    "The PDF measures its pages in a unit of its own (UserUnit), so a drawing scale and dpi alone may give a "
    "wrong size; check it by a known distance."
)
_WRONG_PASSWORD = (4, 5)  # FPDF_ERR_PASSWORD, FPDF_ERR_SECURITY


def draw_pdf_page(
    data: bytes,
    *,
    name: str,
    page: int,
    dpi: float,
    limit_megapixels: float,
    before_decoding: BeforeDecoding,
) -> PlanImage:
    """Return page `page` (from 1) of the PDF in `data`, drawn on white at `dpi`; see `decode_picture`.

    A page without colours comes back grey.
    """
    document = _opened(data, name=name)
    try:
        pages = len(document)
        if pages == 0:
            raise InputError(f"{name} is a PDF without pages.")
        if page > pages:
            raise InputError(f"{name} has {pages} page{'s' if pages > 1 else ''}; there is no page {page}.")
        try:
            sheet = document[page - 1]
            width_pt, height_pt = sheet.get_size()
        except pdfium.PdfiumError as error:
            raise InputError(f"Page {page} of {name} is damaged and cannot be drawn.") from error
        if not (math.isfinite(width_pt) and math.isfinite(height_pt) and min(width_pt, height_pt) > 0):
            raise InputError(f"Page {page} of {name} has no size.")
        scale = dpi / _POINTS_PER_INCH
        check_page_size(
            width_pt / _POINTS_PER_INCH,
            height_pt / _POINTS_PER_INCH,
            dpi=dpi,
            name=name,
            limit=limit_megapixels,
        )
        width, height = math.ceil(width_pt * scale), math.ceil(height_pt * scale)
        before_decoding(PictureHeader("PDF", width, height, width * height * 12))
        try:
            bitmap = sheet.render(scale=scale, rev_byteorder=True)
        except (pdfium.PdfiumError, MemoryError) as error:
            raise InputError(
                f"Page {page} of {name} cannot be drawn at {dpi:g} dpi; it is damaged or too large."
            ) from error
        values = bitmap.to_numpy()
        if values.ndim == 3 and values.shape[2] >= 3:
            pixels = grey_if_grey(values[..., :3])
        else:
            pixels = values.reshape(values.shape[:2])
        pixels = np.array(pixels)  # the bitmap's own memory goes with the document
        bitmap.close()
        sheet.close()
    finally:
        document.close()
    # The page fills whole pixels, so its dpi is a trace more than was asked for.
    drawn = (pixels.shape[1] / width_pt * _POINTS_PER_INCH, pixels.shape[0] / height_pt * _POINTS_PER_INCH)
    notes = (_USER_UNIT,) if b"/UserUnit" in data else ()
    return PlanImage(pixels, drawn, pages, "PDF", notes)


def _opened(data: bytes, *, name: str) -> pdfium.PdfDocument:
    try:
        return pdfium.PdfDocument(data)
    except pdfium.PdfiumError as error:
        if error.err_code in _WRONG_PASSWORD:
            raise InputError(
                f"{name} is protected by a password; save a copy without one, for example by printing it as PDF."
            ) from error
        raise InputError(f"{name} is damaged or ends too early, so it cannot be read as a PDF.") from error

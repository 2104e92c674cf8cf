"""A small picture of every kind, all of the same drawing, to decode in the process that does so for the window."""

from __future__ import annotations

import io

import numpy as np

from bobdesk.errors import InputError
from bobdesk.files.picture_process import decode_in_process
from bobdesk.progress import finish
from bobdesk.ui.selftest.record import SelfTestError

_WIDTH, _HEIGHT = 120, 80
# Left, top, right, bottom of the dark rectangle that is drawn, pixels.
_BOX = (30, 20, 90, 60)
_DARK, _LIGHT = 64, 255
_RASTERS = ("PNG", "JPEG", "TIFF", "WEBP", "BMP", "GIF")
_DPI = 72.0  # at which a point of a page is a pixel
# Of lossy and of smoothed kinds.
_TOLERANCE = 6.0


def made_pictures() -> dict[str, bytes]:
    """Return the files by the names of their formats."""
    from PIL import Image

    pixels = np.full((_HEIGHT, _WIDTH), _LIGHT, dtype=np.uint8)
    pixels[_BOX[1] : _BOX[3], _BOX[0] : _BOX[2]] = _DARK
    image = Image.fromarray(pixels)
    made = {}
    for kind in _RASTERS:
        stream = io.BytesIO()
        image.convert("RGB" if kind == "WEBP" else "L").save(stream, kind)
        made[kind] = stream.getvalue()
    made["SVG"] = _svg()
    made["PDF"] = _pdf()
    return made


def decode_made_pictures() -> dict[str, dict[str, float]]:
    """Decode each of them and return its mean grey inside and outside the rectangle.

    Raises
    ------
    SelfTestError
        If one is not decoded, or shows something else.
    """
    found = {}
    for kind, data in made_pictures().items():
        try:
            image = finish(decode_in_process(data, name=f"{kind} picture", dpi=_DPI))
        except InputError as error:
            raise SelfTestError(f"a {kind} picture cannot be decoded: {error}") from error
        if image.format != kind:
            raise SelfTestError(f"a {kind} picture is taken for {image.format}")
        found[kind] = _greys(kind, image.pixels)
    return found


def _greys(kind: str, pixels: np.ndarray) -> dict[str, float]:
    grey = pixels.astype(float) if pixels.ndim == 2 else pixels.astype(float).mean(axis=2)
    if kind != "SVG" and grey.shape != (_HEIGHT, _WIDTH):
        raise SelfTestError(f"a {kind} picture has {grey.shape[1]} × {grey.shape[0]} pixels, not {_WIDTH} × {_HEIGHT}")
    # SVG drawings count 96 pixels an inch, whatever dpi they are drawn at.
    step = grey.shape[1] / _WIDTH
    left, top, right, bottom = (round(edge * step) for edge in _BOX)
    inside = float(grey[top + 3 : bottom - 3, left + 3 : right - 3].mean())
    outside = float(grey[: top - 3].mean())
    if abs(inside - _DARK) > _TOLERANCE or abs(outside - _LIGHT) > _TOLERANCE:
        raise SelfTestError(
            f"a {kind} picture is decoded wrongly: grey {inside:.0f} and {outside:.0f}, not {_DARK} and {_LIGHT}"
        )
    return {"inside": inside, "outside": outside}


def _svg() -> bytes:
    left, top, right, bottom = _BOX
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_WIDTH}" height="{_HEIGHT}">'
        f'<rect width="{_WIDTH}" height="{_HEIGHT}" fill="#ffffff"/>'
        f'<rect x="{left}" y="{top}" width="{right - left}" height="{bottom - top}" fill="#{_DARK:02x}{_DARK:02x}'
        f'{_DARK:02x}"/></svg>'
    ).encode()


def _pdf() -> bytes:
    """Return a page with the rectangle, in the four objects that a page needs."""
    left, top, right, bottom = _BOX
    drawn = f"{_DARK / 255:.4f} g {left} {_HEIGHT - bottom} {right - left} {bottom - top} re f"
    objects = (
        "<</Type/Catalog/Pages 2 0 R>>",
        "<</Type/Pages/Kids[3 0 R]/Count 1>>",
        f"<</Type/Page/Parent 2 0 R/MediaBox[0 0 {_WIDTH} {_HEIGHT}]/Contents 4 0 R>>",
        f"<</Length {len(drawn)}>>stream\n{drawn}\nendstream",
    )
    text = "%PDF-1.4\n"
    offsets = []
    for number, content in enumerate(objects, start=1):
        offsets.append(len(text))
        text += f"{number} 0 obj{content}endobj\n"
    table = "".join(f"{offset:010d} 00000 n \n" for offset in offsets)
    return (
        f"{text}xref\n0 {len(objects) + 1}\n0000000000 65535 f \n{table}"
        f"trailer<</Root 1 0 R/Size {len(objects) + 1}>>\nstartxref\n{len(text)}\n%%EOF\n"
    ).encode()

"""The picture of a plan: bytes of any readable format become pixels."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from bobdesk.errors import InputError
from bobdesk.plan.picture_format import picture_format
from bobdesk.plan.world import PixelToWorld

Pixels = npt.NDArray[np.bool_] | npt.NDArray[np.uint8]

LIMIT_MEGAPIXELS = 400.0
LIMIT_PAGE_MEGAPIXELS = 40.0  # pages are drawn, not decoded: dpi decides, and more shows no more
LIMIT_SIDE = 100_000
DPI_RANGE = (10.0, 2400.0)


@dataclass(frozen=True)
class PictureHeader:
    """What is known of a picture before it is decoded: `width` and `height` in pixels.

    `memory_bytes` is an upper estimate of what decoding takes beside the file itself.
    """

    format: str
    width: int
    height: int
    memory_bytes: int


@dataclass(frozen=True, eq=False)
class PlanImage:
    """A picture as BobDesk holds it.

    Attributes
    ----------
    pixels
        Read-only; (h, w) bool with True = white for 1-bit scans, (h, w) uint8 for grey, or (h, w, 3)
        uint8 for colour (RGB). Row 0 is the top. 16-bit grey is brought to 8 bits: tracing and the
        screen need no more, and 12-bit scans stored in 16 bits come out as bright as they were.
    dpi
        Pixels per inch along x and y as the file says, None where it says nothing. For a PDF page, and
        an SVG drawing measured in millimetres or the like, the dpi at which it was drawn: what was asked
        for, but for filling whole pixels.
    pages
        Number of pages in the file (PDF, TIFF), else 1.
    format
        "PNG", "JPEG", "TIFF", "WEBP", "BMP", "GIF", "SVG" or "PDF".
    notes
        One sentence for each thing that was changed or could not be used.
    world
        Where the pixels lie in metres, by the file's own tags or a world file; None where neither says.
    """

    pixels: Pixels
    dpi: tuple[float, float] | None
    pages: int
    format: str
    notes: tuple[str, ...] = ()
    world: PixelToWorld | None = None

    def __post_init__(self) -> None:
        good = self.pixels.ndim == 2 and self.pixels.dtype in (np.bool_, np.uint8)
        good |= self.pixels.ndim == 3 and self.pixels.shape[2] == 3 and self.pixels.dtype == np.uint8
        if not good or self.pixels.size == 0:
            raise ValueError(f"no picture has pixels of shape {self.pixels.shape}, {self.pixels.dtype}")
        self.pixels.flags.writeable = False

    @property
    def width(self) -> int:
        """Width in pixels."""
        return int(self.pixels.shape[1])

    @property
    def height(self) -> int:
        """Height in pixels."""
        return int(self.pixels.shape[0])


BeforeDecoding = Callable[[PictureHeader], None]


def decode_picture(
    data: bytes,
    *,
    name: str,
    page: int = 1,
    dpi: float = 200.0,
    limit_megapixels: float = LIMIT_MEGAPIXELS,
    world: PixelToWorld | None = None,
    before_decoding: BeforeDecoding | None = None,
) -> PlanImage:
    """Return the picture in `data`.

    A hostile drawing (SVG, PDF) can take any time: programs call `bobdesk.files.pictures`, which runs
    this in a process with limits.

    Parameters
    ----------
    data
        The file's or the clipboard's bytes; the format is told from them, never from `name`.
    name
        What to call the picture in a sentence, for example its file name.
    page
        Page of a PDF or TIFF, from 1.
    dpi
        Pixels per inch at which a PDF page or an SVG drawing is drawn; without effect on the rest.
    limit_megapixels
        Larger pictures are refused before they are decoded.
    world
        Position of the pixels as stored, from a world file; the picture's own tags go before it.
    before_decoding
        Called once the size is known and found good, before memory is taken for the pixels.

    Raises
    ------
    InputError
        If the bytes are no picture, damaged, or over a limit.
    """
    kind = picture_format(data, name=name)
    if not DPI_RANGE[0] <= dpi <= DPI_RANGE[1]:
        raise InputError(f"A page can be drawn at {DPI_RANGE[0]:.0f} to {DPI_RANGE[1]:.0f} dpi, not at {dpi:g}.")
    if page < 1:
        raise InputError(f"Pages count from 1; {name} has no page {page}.")
    tell = before_decoding or (lambda _: None)
    page_limit = min(limit_megapixels, LIMIT_PAGE_MEGAPIXELS)
    with warnings.catch_warnings():
        # Pillow warns of odd tags and of size; the size has an own limit, and odd tags harm nobody.
        warnings.simplefilter("ignore")
        if kind == "PDF":
            from bobdesk.plan.pdf_page import draw_pdf_page

            return draw_pdf_page(data, name=name, page=page, dpi=dpi, limit_megapixels=page_limit, before_decoding=tell)
        if kind == "SVG":
            from bobdesk.plan.svg_page import draw_svg

            return draw_svg(data, name=name, dpi=dpi, limit_megapixels=page_limit, before_decoding=tell)
        from bobdesk.plan.pillow_picture import decode_raster

        return decode_raster(
            data,
            kind,
            name=name,
            page=page,
            limit_megapixels=limit_megapixels,
            world=world,
            before_decoding=tell,
        )


def check_size(width: int, height: int, *, name: str, limit_megapixels: float) -> None:
    """Raise InputError if a picture of `width` x `height` pixels is over a limit."""
    megapixels = width * height / 1e6
    if megapixels > limit_megapixels:
        raise InputError(
            f"{name} is too large: {width} × {height} pixels are {megapixels:,.0f} megapixels, "
            f"and the limit is {limit_megapixels:,.0f}; save it smaller or cut out the track."
        )
    if max(width, height) > LIMIT_SIDE:
        raise InputError(
            f"{name} is too long: {width} × {height} pixels, and no side may have more than {LIMIT_SIDE:,}."
        )


def check_page_size(width_inch: float, height_inch: float, *, dpi: float, name: str, limit: float) -> None:
    """Raise InputError, naming a dpi that fits, if a drawn page would have over `limit` megapixels."""
    megapixels = width_inch * height_inch * dpi * dpi / 1e6
    longest = max(width_inch, height_inch) * dpi
    if megapixels <= limit and longest <= LIMIT_SIDE:
        return
    fits = min((limit * 1e6 / (width_inch * height_inch)) ** 0.5, LIMIT_SIDE / max(width_inch, height_inch))
    size = f"{width_inch * 0.0254:,.2f} m × {height_inch * 0.0254:,.2f} m"
    if fits < DPI_RANGE[0]:
        raise InputError(f"{name} is too large to be drawn: its page measures {size}.")
    raise InputError(
        f"{name} measures {size} and would have {megapixels:,.0f} megapixels at {dpi:g} dpi, "
        f"where {limit:,.0f} is the limit; draw it at {int(fits)} dpi or less."
    )


def grey_if_grey(rgb: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """Return (h, w) if no pixel of `rgb` (h, w, 3) has a colour, else `rgb` itself."""
    rows = max(1, 2_000_000 // rgb.shape[1])
    for top in range(0, rgb.shape[0], rows):
        strip = rgb[top : top + rows]
        red = strip[..., 0]
        if not (np.array_equal(red, strip[..., 1]) and np.array_equal(red, strip[..., 2])):
            return rgb
    return np.ascontiguousarray(rgb[..., 0])

"""An SVG drawing is read, measured and made harmless before it is drawn."""

from __future__ import annotations

import io
import math
import re
import zlib
from dataclasses import dataclass
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from bobdesk.errors import InputError

_LIMIT_BYTES = 64_000_000
_LIMIT_DEPTH = 250
_LIMIT_COPIES = 200_000  # elements that <use> may add; resvg draws about 100,000 a second
_LENGTH = re.compile(r"\s*([+]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(px|mm|cm|in|pt|pc|Q|)\s*")
_CSS_PX_PER_INCH = 96.0
_INCH_PER_UNIT = {
    "mm": 1 / 25.4,
    "cm": 1 / 2.54,
    "in": 1.0,
    "pt": 1 / 72,
    "pc": 1 / 6,
    "Q": 1 / 101.6,
    "px": 1 / _CSS_PX_PER_INCH,
    "": 1 / _CSS_PX_PER_INCH,
}


@dataclass(frozen=True)
class SvgSource:
    """A harmless drawing: its `text`, its size in inches, and what a renderer must know.

    The text's own size is in pixels at the dpi it was read for.
    `real_size` says whether the size was given in a unit of length; pixels count 96 an inch by
    convention only.
    """

    text: str
    width_inch: float
    height_inch: float
    real_size: bool
    has_text: bool
    linked_pictures: int


def read_svg(data: bytes, *, name: str, dpi: float) -> SvgSource:
    """Return the drawing in `data`, an SVG file as text or compressed (.svgz).

    Pictures outside the file are taken out, so that a drawing sent by mail opens nothing on this
    computer. Entities outside the file are never fetched, and those inside may not multiply (expat).

    Raises
    ------
    InputError
        If it is no SVG, damaged, without a size, or multiplies itself by <use>.
    """
    root = _parsed(_unpacked(data, name=name), name=name)
    if _local(root) != "svg":
        raise InputError(f"{name} is an XML file but not an SVG drawing.")
    elements = sum(1 for _ in root.iter())
    if _drawn_elements(root) - elements > _LIMIT_COPIES:
        raise InputError(f"{name} repeats its parts more than {_LIMIT_COPIES:,} times by <use> and is not opened.")
    width, height, real_size = _size(root, name=name)
    linked = _without_links(root)
    _resize(root, width_inch=width, height_inch=height, dpi=dpi)
    has_text = any(_local(element) == "text" for element in root.iter())
    text = ElementTree.tostring(root, encoding="unicode")
    return SvgSource(text, width, height, real_size, has_text, linked)


def _unpacked(data: bytes, *, name: str) -> bytes:
    if data[:2] == b"\x1f\x8b":
        unpacker = zlib.decompressobj(wbits=31)
        try:
            data = unpacker.decompress(data, _LIMIT_BYTES + 1)
        except zlib.error as error:
            raise InputError(f"{name} is damaged: it cannot be unpacked as a compressed SVG.") from error
        if not unpacker.eof and len(data) <= _LIMIT_BYTES:
            raise InputError(f"{name} ends too early, so it cannot be unpacked as a compressed SVG.")
    if len(data) > _LIMIT_BYTES:
        raise InputError(f"{name} is too large for an SVG drawing (over {_LIMIT_BYTES // 1_000_000} MB of text).")
    return data


def _parsed(data: bytes, *, name: str) -> Element:
    depth = 0
    root: Element | None = None
    try:
        for event, element in ElementTree.iterparse(io.BytesIO(data), events=("start", "end")):
            depth += 1 if event == "start" else -1
            root = element if root is None else root
            if depth > _LIMIT_DEPTH:
                raise InputError(f"{name} nests its parts more than {_LIMIT_DEPTH} deep and is not opened.")
    except ElementTree.ParseError as error:
        message, (line, column) = str(error), error.position
        if "entity" in message or "amplification" in message:
            raise InputError(
                f"{name}, line {line}: the drawing refers to text outside the file or multiplies text "
                "(an XML entity) and is not opened."
            ) from error
        raise InputError(
            f"{name}, line {line}, column {column + 1}: the SVG drawing is damaged or ends too early."
        ) from error
    except (ValueError, LookupError) as error:
        raise InputError(f"{name} is written in an encoding that cannot be read; save it as UTF-8.") from error
    if root is None:
        raise InputError(f"{name} is an XML file but not an SVG drawing.")
    return root


def _local(element: Element) -> str:
    """Return the element's name without its namespace."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""


def _reference(element: Element) -> str:
    return element.get("href") or element.get("{http://www.w3.org/1999/xlink}href") or ""


def _drawn_elements(root: Element) -> float:
    """Return how many elements a renderer meets when it follows every <use>."""
    named = {name: element for element in root.iter() if (name := element.get("id"))}
    drawn: dict[Element, float] = {}
    entered: set[Element] = set()
    stack = [root]
    while stack:
        element = stack[-1]
        if element in drawn:
            stack.pop()
            continue
        parts = list(element)
        if _local(element) == "use" and (target := named.get(_reference(element).strip()[1:])) is not None:
            parts.append(target)
        missing = [part for part in parts if part not in drawn and part not in entered]
        if element not in entered and missing:
            entered.add(element)
            stack.extend(missing)
            continue
        # A part that is entered but not counted holds this element: a circle, which nothing draws.
        drawn[element] = min(1 + sum(drawn.get(part, 0.0) for part in parts), 1e300)
        stack.pop()
    return drawn[root]


def _length(text: str | None) -> tuple[float, bool] | None:
    """Return a length in inches and whether it was given in a unit of length; None for none or %."""
    match = _LENGTH.fullmatch(text or "")
    if match is None:
        return None
    value = float(match[1]) * _INCH_PER_UNIT[match[2]]
    return (value, match[2] not in ("px", "")) if math.isfinite(value) and value > 0 else None


def _size(root: Element, *, name: str) -> tuple[float, float, bool]:
    width, height = _length(root.get("width")), _length(root.get("height"))
    if width and height:
        return width[0], height[0], width[1] and height[1]
    try:
        numbers = [float(number) for number in re.split(r"[\s,]+", (root.get("viewBox") or "").strip())]
    except ValueError:
        numbers = []
    if len(numbers) != 4 or not all(map(math.isfinite, numbers)) or min(numbers[2:]) <= 0:
        raise InputError(f"{name} gives no size (width and height, or viewBox), so it cannot be drawn.")
    aspect = numbers[3] / numbers[2]
    if width:
        return width[0], width[0] * aspect, width[1]
    if height:
        return height[0] / aspect, height[0], height[1]
    return numbers[2] / _CSS_PX_PER_INCH, numbers[3] / _CSS_PX_PER_INCH, False


def _resize(root: Element, *, width_inch: float, height_inch: float, dpi: float) -> None:
    """Give `root` its size in pixels at `dpi`.

    Asked for a width, resvg first rounds the drawing's own size to whole pixels at 96 dpi and scales from
    that, which makes a small drawing wrong by up to a percent.
    """
    if root.get("viewBox") is None:
        root.set("viewBox", f"0 0 {width_inch * _CSS_PX_PER_INCH!r} {height_inch * _CSS_PX_PER_INCH!r}")
    root.set("width", repr(width_inch * dpi))
    root.set("height", repr(height_inch * dpi))


def _without_links(root: Element) -> int:
    """Take the references to pictures outside the file out of `root`; return how many there were."""
    linked = 0
    for element in root.iter():
        if _local(element) not in ("image", "feImage"):
            continue
        for key in ("href", "{http://www.w3.org/1999/xlink}href"):
            reference = (element.get(key) or "").strip()
            if reference and not reference.startswith(("data:", "#")):
                del element.attrib[key]
                linked += 1
    return linked

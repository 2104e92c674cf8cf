"""World files (.pgw, .tfw, .jgw, .wld ...): six lines of text beside a picture."""

from __future__ import annotations

from bobdesk.errors import InputError
from bobdesk.plan.world import PixelToWorld, checked_world


def parse_world_file(text: str, *, name: str) -> PixelToWorld:
    """Return the position that the text of a world file gives.

    A decimal comma is understood, since there is one number a line and no thousands separator.

    Parameters
    ----------
    text
        The whole file.
    name
        What to call it in a sentence.

    Raises
    ------
    InputError
        If there are not six numbers, or they cannot place a picture in metres.
    """
    lines = [line.strip().lstrip("\ufeff") for line in text.splitlines()]
    filled = [(number, line) for number, line in enumerate(lines, start=1) if line]
    if len(filled) != 6:
        raise InputError(f"{name} is not a world file: it has {len(filled)} lines of text where six belong.")
    numbers: list[float] = []
    for number, line in filled:
        try:
            numbers.append(float(line.replace(",", ".")))
        except ValueError:
            raise InputError(
                f"{name}, line {number}: {line[:40]!r} is not a number, so the picture gets no position from it."
            ) from None
    a, d, b, e, c, f = numbers
    return checked_world(PixelToWorld(a, b, c, d, e, f), name=name)


def format_world_file(world: PixelToWorld) -> str:
    """Return the text of a world file for `world`."""
    a, b, c, d, e, f = world.coefficients
    return "".join(f"{number!r}\n" for number in (a, d, b, e, c, f))


def world_file_names(picture_name: str) -> tuple[str, ...]:
    """Return the names that a world file of the picture `picture_name` may have, likeliest first.

    GIS programs write the first and last letter of the extension and a w (.png: .pgw), the extension
    and a w (.pngw), or .wld; old programs write the extension in capitals.
    """
    stem, dot, extension = picture_name.rpartition(".")
    if not dot or not stem:
        return (f"{picture_name}.wld",)
    endings = [f"{extension[:1]}{extension[-1:]}w", f"{extension}w", "wld"]
    if extension.lower() == "tiff":
        endings.insert(1, "tifw")
    if extension.lower() == "jpeg":
        endings.insert(1, "jpgw")
    both = [variant for ending in endings for variant in (ending.lower(), ending.upper())]
    return tuple(dict.fromkeys(f"{stem}.{ending}" for ending in both))

"""The flavours of CSV: separator, decimal sign, byte order mark, header."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

_FORMULA_SIGNS = ("=", "+", "-", "@", "\t", "\r")


@dataclass(frozen=True)
class Flavour:
    """How a table is written; numbers follow the flavour, never the computer's settings."""

    separator: str = ","
    decimal: str = "."
    byte_order_mark: bool = False
    header: bool = True
    line_end: str = "\n"


FLAVOURS: dict[str, Flavour] = {
    "default": Flavour(),
    "excel-european": Flavour(separator=";", decimal=",", byte_order_mark=True, line_end="\r\n"),
    "tab": Flavour(separator="\t"),
    "xyz": Flavour(header=False),
}


def to_csv(header: Sequence[str], rows: Iterable[Sequence[str]], flavour: Flavour) -> bytes:
    """Return a table as bytes; the cells are written already, with a dot as the decimal sign."""
    lines = [flavour.separator.join(header)] if flavour.header else []
    if flavour.decimal == ".":
        lines.extend(flavour.separator.join(row) for row in rows)
    else:
        lines.extend(flavour.separator.join(row).replace(".", flavour.decimal) for row in rows)
    text = flavour.line_end.join(lines) + flavour.line_end
    return text.encode("utf-8-sig" if flavour.byte_order_mark else "utf-8")


def text_cell(text: str, flavour: Flavour) -> str:
    """Return free text as a cell that no spreadsheet takes for a formula or for two cells."""
    if text.startswith(_FORMULA_SIGNS):
        text = "'" + text
    if any(sign in text for sign in (flavour.separator, '"', "\n", "\r")):
        text = '"' + text.replace('"', '""') + '"'
    return text

"""Which separator and which decimal sign a table of numbers uses."""

from __future__ import annotations

import csv
import math
import re
from dataclasses import dataclass

SEPARATORS = (",", ";", "\t", "|", " ")
_SAMPLE = 400
_LARGEST_SAMPLE = 200_000
_SPACES = re.compile(r"[ \t]+")


@dataclass(frozen=True)
class Dialect:
    """Separator of columns and decimal sign of numbers."""

    separator: str
    decimal: str

    @property
    def separator_name(self) -> str:
        """The separator in words."""
        names = {",": "comma", ";": "semicolon", "\t": "tab", "|": "bar", " ": "space"}
        return names[self.separator]


def guess_dialect(lines: list[str]) -> Dialect:
    """Score five separators and two decimal signs by the rows that give two finite numbers or more.

    Among equals the one that gives the more even table wins, then the more usual one: "1,234" alone
    is ambiguous by nature.
    """
    sample = lines[: max(1, min(_SAMPLE, _LARGEST_SAMPLE // max(map(len, lines[:_SAMPLE]))))]
    quoted = any('"' in line for line in sample)
    best, best_score = Dialect(",", "."), (-1.0, -1.0, -1.0)
    for rank, separator in enumerate(SEPARATORS):
        for decimal in (".", ","):
            if separator == decimal and not quoted:
                continue
            dialect = Dialect(separator, decimal)
            rows = [[number(cell, dialect) for cell in cells_of(line, dialect)] for line in sample]
            finite = [sum(math.isfinite(value) for value in row) for row in rows]
            good = sum(count >= 2 for count in finite)
            clean = sum(count >= 2 and count == len(row) for count, row in zip(finite, rows, strict=True))
            score = (float(good), float(clean), -float(rank) - 0.5 * (decimal == ","))
            if score > best_score:
                best, best_score = dialect, score
    return best


def cells_of(line: str, dialect: Dialect) -> list[str]:
    """Cut a line into its cells, without blanks and quotes around them."""
    if dialect.separator == " ":
        return [cell.strip('"') for cell in _SPACES.split(line.strip())]
    if '"' in line:
        try:
            row = next(csv.reader([line.rstrip("\r\n")], delimiter=dialect.separator, skipinitialspace=True))
        except csv.Error:
            row = line.split(dialect.separator)
        return [cell.strip().strip('"').strip() for cell in row]
    return [cell.strip().strip('"').strip() for cell in line.rstrip("\r\n").split(dialect.separator)]


def number(cell: str, dialect: Dialect) -> float:
    """Return the number in a cell, NaN if there is none."""
    text = cell.strip().strip('"').replace("\u2212", "-").replace("\u00a0", "")
    if dialect.decimal == ",":
        if "." in text:
            return math.nan
        text = text.replace(",", ".")
    if "_" in text:
        return math.nan
    try:
        return float(text)
    except ValueError:
        return math.nan

"""A table as text that spreadsheets of the same country take: tabs between cells, numbers they can calculate with."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QLocale


def table_text(rows: Iterable[Iterable[str]]) -> str:
    """Return rows of cells as lines of cells parted by tabs; a cell that would end early is quoted."""
    return "".join("\t".join(_cell(text) for text in row) + "\n" for row in rows)


def plain_number(text: str) -> str:
    """Return a number of the screen without groups and with a plain minus; any other text as it is."""
    locale = QLocale()
    plain = text.replace("−", "-")
    return plain.replace(locale.groupSeparator(), "") if locale.toDouble(plain.removeprefix("+"))[1] else text


def _cell(text: str) -> str:
    return '"' + text.replace('"', '""') + '"' if text.startswith('"') or set(text) & set("\t\n\r") else text

"""How sentences for a person begin and end, and how things are counted in them."""

from __future__ import annotations

from collections.abc import Sequence

_ENDS = ".!?…"


def as_sentence(text: str | None) -> str:
    """Return a text with a large first letter and a full stop, unless it ends otherwise; "" for none."""
    text = (text or "").strip()
    return text and text[0].upper() + ended(text[1:])


def ended(text: str) -> str:
    """Return a text with a full stop, unless it ends otherwise."""
    return text if text.endswith(tuple(_ENDS)) else f"{text}."


def counted(count: int, noun: str) -> str:
    """Return "1 segment", "2 segments"."""
    return f"{count:,} {noun}" if count == 1 else f"{count:,} {noun}s"


def listed(words: Sequence[str]) -> str:
    """Return "a", "a and b", "a, b and c"."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def are_missing(columns: Sequence[str]) -> str:
    """Return "the column a is missing", "the columns a and b are missing"."""
    return f"the column {columns[0]} is missing" if len(columns) == 1 else f"the columns {listed(columns)} are missing"

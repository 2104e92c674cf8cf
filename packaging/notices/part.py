"""A work of others that is in the packages."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Part:
    """A work of others.

    Attributes
    ----------
    name, version, licence, address
        "" where not known.
    texts
        Name and text of each of its licence files.
    packaged
        Whether it is a package of PyPI that the program imports.
    """

    name: str
    version: str
    licence: str
    address: str
    texts: tuple[tuple[str, str], ...]
    packaged: bool = False


def text_of(path: Path) -> str:
    """Return a licence's text; old ones are not in UTF-8."""
    content = path.read_bytes()
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError:
        return content.decode("latin-1")

"""The pages of the user's guide: Markdown files in resources/guide, in the order of their first page."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

FIRST_PAGE = "index.md"
FIRST_TRACK_PAGE = "first-track.md"
KEYS_PAGE = "keys.md"
_HEADING = re.compile(r"^## +(.+?)\s*$")
_ENTRY = re.compile(r"^\s*[-*] +\[([^\]]+)\]\(([\w-]+\.md)\)")
_TITLE = re.compile(r"^# +(.+?)\s*$", re.MULTILINE)
# What must be told by the program itself, such as the keys in force, stands in the pages as {{name}}.
_MADE = re.compile(r"\{\{(\w+)\}\}")

_BEFORE_UNIT = re.compile(r"(?<=\d) (?=(?:%|m|px|pixels?|MB)\b|%)")


@dataclass(frozen=True)
class Page:
    """A page of the guide.

    Attributes
    ----------
    name
        Of its file; links name it so.
    title
        Its first heading.
    group
        Heading of the first page under which it is listed; "" for the first page itself.
    text
        Markdown.
    """

    name: str
    title: str
    group: str
    text: str


def read_pages(folder: Path, made: Mapping[str, Callable[[], str]]) -> tuple[Page, ...]:
    """Return the pages, the first one first, then those that it lists; none if the folder is not there.

    Parameters
    ----------
    folder
        Where the Markdown files lie.
    made
        Returns the text that stands in the place of {{name}}.

    Raises
    ------
    OSError
        If a page that is listed cannot be read.
    """
    first = folder / FIRST_PAGE
    if not first.is_file():
        return ()
    found = [_page(first, "", made)]
    group = ""
    for line in found[0].text.splitlines():
        heading, entry = _HEADING.match(line), _ENTRY.match(line)
        if heading:
            group = heading[1]
        elif entry:
            found.append(_page(folder / entry[2], group, made))
    return tuple(found)


def keep_units(text: str) -> str:
    """Return a text in which no line ends between a number and its unit; nothing changes its place."""
    return _BEFORE_UNIT.sub("\u00a0", text)


def slug(heading: str) -> str:
    """Return the name by which a link reaches a heading: "Known elevations" as "known-elevations"."""
    return re.sub(r"[\s-]+", "-", re.sub(r"[^\w\s-]", "", heading.casefold())).strip("-")


def split_link(link: str) -> tuple[str, str]:
    """Return page and heading of a link such as "solve.md#known-elevations"."""
    page, _, heading = link.partition("#")
    return page, heading


def _page(path: Path, group: str, made: Mapping[str, Callable[[], str]]) -> Page:
    text = _MADE.sub(lambda found: made[found[1]](), path.read_text(encoding="utf-8"))
    title = _TITLE.search(text)
    return Page(path.name, title[1] if title else path.stem, group, text)

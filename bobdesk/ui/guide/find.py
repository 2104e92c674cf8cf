"""Finds words in all pages of the guide."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtGui import QTextDocument

from bobdesk.ui.guide.pages import Page

_AROUND = 46


@dataclass(frozen=True)
class Hit:
    """A paragraph in which all words are found.

    Attributes
    ----------
    page
        Name of the page.
    heading
        The heading above it.
    block, at
        Number of the paragraph as Qt counts them, and where in it the first word begins.
    excerpt
        The words and what stands around them.
    """

    page: str
    heading: str
    block: int
    at: int
    excerpt: str


class GuideFinder:
    """The pages' plain text, by paragraph."""

    def __init__(self, pages: tuple[Page, ...]) -> None:
        self._paragraphs = [
            (page.name, heading, number, text) for page in pages for heading, number, text in _paragraphs_of(page)
        ]

    def find(self, words: tuple[str, ...]) -> tuple[Hit, ...]:
        """Return the paragraphs with all words, those with a word in the heading first, else in the guide's order."""
        wanted = [word.casefold() for word in words]
        if not wanted:
            return ()
        found = []
        for page, heading, number, text in self._paragraphs:
            folded = text.casefold()
            if all(word in folded for word in wanted):
                at = folded.index(wanted[0])
                found.append((text != heading, Hit(page, heading, number, at, _excerpt(text, at))))
        return tuple(hit for _is_text, hit in sorted(found, key=lambda one: one[0]))


def words_of(typed: str) -> tuple[str, ...]:
    """Return the words of what was typed; a single letter is none."""
    return tuple(word for word in typed.split() if len(word) > 1)


def _paragraphs_of(page: Page) -> list[tuple[str, int, str]]:
    document = QTextDocument()
    document.setMarkdown(page.text)
    heading, found = page.title, []
    block = document.begin()
    while block.isValid():
        if block.blockFormat().headingLevel():
            heading = block.text()
        if block.text().strip("\ufffc "):
            found.append((heading, block.blockNumber(), block.text()))
        block = block.next()
    return found


def _excerpt(text: str, at: int) -> str:
    first = max(0, at - _AROUND // 2)
    if first:
        # Begin with a whole word.
        first = text.find(" ", first) + 1 if " " in text[first:at] else first
    last = min(len(text), at + _AROUND)
    if last < len(text):
        # End with a whole word.
        last = max(text.rfind(" ", at, last), at + 1)
    return ("… " if first else "") + text[first:last].strip() + (" …" if last < len(text) else "")

"""XML element by element, never as a tree: no entity is expanded, and size and number are limited."""

from __future__ import annotations

import math
from typing import Protocol
from xml.sax import SAXException, SAXParseException
from xml.sax.handler import ContentHandler, feature_external_ges
from xml.sax.xmlreader import AttributesImpl

from defusedxml.common import DefusedXmlException  # type: ignore[import-untyped]
from defusedxml.expatreader import create_parser  # type: ignore[import-untyped]

from bobdesk.errors import InputError

_LIMIT_BYTES = 64_000_000
_LIMIT_ELEMENTS = 1_500_000
_LIMIT_DEPTH = 500
_MOST_CHARACTERS_OF_A_NUMBER = 60


class Attributes(Protocol):
    """The attributes of an element."""

    def get(self, name: str, /) -> str | None:
        """Return the value of an attribute, None if it is not there."""


class Listener(Protocol):
    """What a format does at each element; tags come without their namespace.

    Attributes
    ----------
    text_of
        The tags whose text is wanted.
    """

    text_of: frozenset[str]

    def start(self, tag: str, attributes: Attributes) -> None:
        """Take the start of an element."""

    def end(self, tag: str, text: str) -> None:
        """Take the end of an element and its own text."""


def listen(data: bytes, listener: Listener, *, name: str) -> None:
    """Call the listener for every element in `data`.

    Raises
    ------
    InputError
        If the XML is damaged or over a limit, or defines entities.
    """
    if len(data) > _LIMIT_BYTES:
        raise InputError(
            f"{name}: the file holds {len(data) / 1e6:,.0f} MB of XML; the most that is read is"
            f" {_LIMIT_BYTES // 1_000_000} MB"
        )
    # A DOCTYPE may name a file elsewhere (SVG 1.1 does): it is passed over, never fetched.
    parser = create_parser(forbid_external=False)
    parser.setFeature(feature_external_ges, False)
    parser.setContentHandler(_Handler(listener, name))
    try:
        # In one piece: handed over in small ones, expat before 2.6 reads a long token again for each.
        parser.feed(data)
        parser.close()
    except DefusedXmlException as error:
        raise InputError(
            f"{name}: the file defines text replacements (XML entities), as hostile files do, and is not read;"
            " save it without them"
        ) from error
    except SAXParseException as error:
        raise InputError(
            f"{name}, line {error.getLineNumber()}: the XML is damaged or ends too early: {error.getMessage()}"
        ) from error
    except (SAXException, ValueError, LookupError) as error:
        raise InputError(f"{name}: the XML cannot be read; save it as UTF-8") from error


def decimal(text: str | None) -> float:
    """Return the number in an attribute or element, NaN if there is none."""
    if text is None or len(text) > _MOST_CHARACTERS_OF_A_NUMBER or "_" in text:
        return math.nan
    try:
        return float(text)
    except ValueError:
        return math.nan


class _Handler(ContentHandler):
    def __init__(self, listener: Listener, name: str) -> None:
        super().__init__()
        self._listener = listener
        self._name = name
        self._count = 0
        # One entry an open element: its text so far, or None if that is not wanted.
        self._texts: list[list[str] | None] = []

    def startElement(self, name: str, attrs: AttributesImpl) -> None:  # noqa: N802 - SAX's name
        self._count += 1
        if self._count > _LIMIT_ELEMENTS:
            raise InputError(f"{self._name}: the file has over {_LIMIT_ELEMENTS:,} XML elements and is not read")
        if len(self._texts) >= _LIMIT_DEPTH:
            raise InputError(f"{self._name}: XML elements are nested over {_LIMIT_DEPTH} deep")
        tag = name.rpartition(":")[2]
        self._texts.append([] if tag in self._listener.text_of else None)
        self._listener.start(tag, attrs)

    def characters(self, content: str) -> None:
        if self._texts and (text := self._texts[-1]) is not None:
            text.append(content)

    def endElement(self, name: str) -> None:  # noqa: N802 - SAX's name
        text = self._texts.pop()
        self._listener.end(name.rpartition(":")[2], "" if text is None else "".join(text))

"""Bytes to text: the encodings that spreadsheets and editors write."""

from __future__ import annotations

import codecs

from bobdesk.errors import InputError

_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
_LOOKED_AT = 4000


def decode_text(data: bytes, *, name: str) -> str:
    """Decode by byte order mark, else UTF-16 by its zero bytes, else UTF-8, else Windows-1252.

    Raises
    ------
    InputError
        If the bytes are no text.
    """
    for mark, encoding in _MARKS:
        if data.startswith(mark):
            return _decoded(data, encoding, name)
    sample = data[:_LOOKED_AT]
    if b"\0" in sample:
        even, odd = sample[::2].count(0), sample[1::2].count(0)
        half = len(sample) // 2
        if odd > 0.8 * half and even < 0.1 * half:
            return _decoded(data, "utf-16-le", name)
        if even > 0.8 * half and odd < 0.1 * half:
            return _decoded(data, "utf-16-be", name)
        raise InputError(f"{name}: this is not a text file")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace")


def _decoded(data: bytes, encoding: str, name: str) -> str:
    try:
        return data.decode(encoding)
    except UnicodeDecodeError as error:
        raise InputError(f"{name}: the text is broken at byte {error.start:,}") from error

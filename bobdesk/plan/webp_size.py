"""The size of a WebP picture, read from its header alone."""

from __future__ import annotations

from bobdesk.errors import InputError


def webp_size(data: bytes, *, name: str) -> tuple[int, int]:
    """Return (width, height) in pixels.

    Raises
    ------
    InputError
        If the header holds no size.

    References
    ----------
    RFC 9649, sections 2.5 to 2.7 and 3.4 (VP8, VP8L and VP8X chunks).
    """
    chunk, body = data[12:16], data[20:30]
    if len(body) == 10 and chunk == b"VP8X":
        return 1 + int.from_bytes(body[4:7], "little"), 1 + int.from_bytes(body[7:10], "little")
    if len(body) == 10 and chunk == b"VP8L" and body[0] == 0x2F:
        bits = int.from_bytes(body[1:5], "little")
        return 1 + (bits & 0x3FFF), 1 + (bits >> 14 & 0x3FFF)
    if len(body) == 10 and chunk == b"VP8 " and body[3:6] == b"\x9d\x01\x2a":
        return int.from_bytes(body[6:8], "little") & 0x3FFF, int.from_bytes(body[8:10], "little") & 0x3FFF
    raise InputError(f"{name} is damaged: its WebP header holds no size.")

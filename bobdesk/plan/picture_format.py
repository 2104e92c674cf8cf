"""What kind of picture some bytes are, by their content; the file's name plays no part."""

from __future__ import annotations

from bobdesk.errors import InputError

READABLE = "PNG, JPEG, TIFF, WebP, BMP, GIF, SVG or PDF"

_SIGNATURES = (
    (b"\x89PNG\r\n\x1a\n", "PNG"),
    (b"\xff\xd8\xff", "JPEG"),
    (b"II*\x00", "TIFF"),
    (b"MM\x00*", "TIFF"),
    (b"GIF87a", "GIF"),
    (b"GIF89a", "GIF"),
    (b"BM", "BMP"),
    (b"\x1f\x8b", "SVG"),
)
# What people try, and what helps.
_ADVICE = (
    (b"AC10", "a DWG drawing; export it as PDF or DXF"),
    (b"II+\x00", "a BigTIFF picture; save it as an ordinary TIFF or as PNG"),
    (b"MM\x00+", "a BigTIFF picture; save it as an ordinary TIFF or as PNG"),
    (b"\x00\x00\x00\x0cjP  ", "a JPEG 2000 picture; save it as PNG or TIFF"),
    (b"8BPS", "a Photoshop file; save it as PNG or TIFF"),
    (b"%!PS", "a PostScript file; save it as PDF"),
    (b"PK\x03\x04", "an archive (ZIP) or an office document; take the picture out of it or save it as PDF"),
)


def picture_format(data: bytes, *, name: str) -> str:
    """Return "PNG", "JPEG", "TIFF", "WEBP", "BMP", "GIF", "SVG" or "PDF".

    Raises
    ------
    InputError
        If the bytes are none of these; where the kind is known, the sentence says what helps.
    """
    if not data:
        raise InputError(f"{name} is empty.")
    for signature, kind in _SIGNATURES:
        if data.startswith(signature):
            return kind
    if data[:4] == b"RIFF" and data[8:12] == b"WEBP":
        return "WEBP"
    # PDF readers allow some bytes before the header (ISO 32000-1, implementation note 13).
    if b"%PDF-" in data[:1024]:
        return "PDF"
    if _looks_like_svg(data[:4096]):
        return "SVG"
    for signature, advice in _ADVICE:
        if data.startswith(signature):
            raise InputError(f"{name} is {advice}.")
    if data[4:8] == b"ftyp":
        raise InputError(f"{name} is a HEIC or AVIF photo or a film; save it as JPEG or PNG.")
    raise InputError(f"{name} is not a picture that BobDesk can read ({READABLE}).")


def _looks_like_svg(head: bytes) -> bool:
    encoding = "utf-16" if head[:2] in (b"\xff\xfe", b"\xfe\xff") else "latin-1"
    text = head.decode(encoding, errors="replace").lstrip("\ufeff\xef\xbb\xbf \t\r\n")
    return text.startswith("<") and ("<svg" in text or ":svg" in text or text.startswith("<?xml"))

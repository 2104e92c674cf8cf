"""The ZIP that a project lies in: written byte for byte the same, read within limits.

Entries are stored, not packed: pictures are packed already, the rest is small, and packing gives other
bytes with each version of zlib. Packed entries are read all the same, for other programs write them.
"""

from __future__ import annotations

import io
import re
import struct
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import BinaryIO

from bobdesk.errors import InputError
from bobdesk.files.atomic import reason
from bobdesk.files.project_decoding import MOST_DOCUMENT_BYTES
from bobdesk.files.project_encoding import PICTURE, Encoded

DOCUMENT = "project.json"
_DATE = (1980, 1, 1, 0, 0, 0)
_PERMISSIONS = 0o644 << 16
_MOST_ENTRIES = 3100
_MOST_INDEX_BYTES = 400_000
_LARGEST_FILE = 2_200_000_000
_LARGEST_PICTURE = 2_000_000_000
_LARGEST_TABLE = 20_000_000
_LARGEST_UNPACKED = 400_000_000
_HIGHEST_RATIO = 100
_TABLE = re.compile(r"tables/[0-9a-f]{24}\.npy")
_END = b"PK\x05\x06"
_END_64 = b"PK\x06\x07"
_END_BYTES = 22
_LONGEST_COMMENT = 65_535
_DAMAGED = (zipfile.BadZipFile, zlib.error, struct.error, EOFError, NotImplementedError, RuntimeError, ValueError)


def archive_bytes(encoded: Encoded) -> bytes:
    """Return the file of an encoded project."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_STORED, allowZip64=False) as archive:
        for name, content in ((DOCUMENT, encoded.document), *encoded.blobs.items()):
            info = zipfile.ZipInfo(name, date_time=_DATE)
            info.external_attr = _PERMISSIONS
            info.create_system = 3  # the same on Windows
            archive.writestr(info, content)
    return buffer.getvalue()


def read_archive(path: Path) -> Mapping[str, bytes]:
    """Return the entries of a project file by their names; nothing is written anywhere.

    Raises
    ------
    InputError
        If it is missing, unreadable, no ZIP, damaged, or over a limit; the sentence does not name it.
    """
    if "\0" in str(path):
        raise InputError("there is no such file")
    try:
        if path.is_dir():
            raise InputError("this is a folder, not a file")
        size = path.stat().st_size
        if size > _LARGEST_FILE:
            raise InputError(f"the file is {size / 1e9:,.1f} GB large; the most that is read is 2 GB")
        with path.open("rb") as stream:
            return _entries(stream, size)
    except FileNotFoundError:
        raise InputError("there is no such file") from None
    except OSError as error:
        raise InputError(f"cannot be read: {reason(error)}") from error
    except _DAMAGED as error:
        raise InputError("the file is damaged: it is no whole ZIP archive") from error


def begins_like_a_project(head: bytes) -> bool:
    """Return whether a file that begins with `head` (42 bytes or more) is a ZIP whose first entry is a project's."""
    # The name of a ZIP's first entry stands behind its 30 bytes of header.
    return head.startswith(b"PK\x03\x04") and head[30:].startswith(DOCUMENT.encode())


def entries_in(data: bytes) -> Mapping[str, bytes]:
    """Return the entries of a project file's bytes, as `read_archive` does.

    Raises
    ------
    InputError
        If they are no ZIP, damaged, or over a limit; the sentence does not name the file.
    """
    try:
        return _entries(io.BytesIO(data), len(data))
    except _DAMAGED as error:
        raise InputError("the file is damaged: it is no whole ZIP archive") from error


def _entries(stream: BinaryIO, size: int) -> Mapping[str, bytes]:
    if size == 0:
        raise InputError("the file is empty")
    if stream.read(4) != b"PK\x03\x04":
        raise InputError("this is not a BobDesk project")
    _check_index(stream, size)
    with zipfile.ZipFile(stream) as archive:
        found = archive.infolist()
        _check_entries(found, size)
        return {info.filename: archive.read(info) for info in found}


def _check_index(stream: BinaryIO, size: int) -> None:
    """Refuse an index of millions of entries before it is read."""
    tail = min(size, _END_BYTES + _LONGEST_COMMENT + 20)
    stream.seek(size - tail)
    last = stream.read(tail)
    at = last.rfind(_END)
    if at < 0 or len(last) < at + _END_BYTES:
        raise InputError("the file is damaged: its end is missing")
    count, index_bytes = struct.unpack("<HL", last[at + 10 : at + 16])
    if count > _MOST_ENTRIES or index_bytes > _MOST_INDEX_BYTES or last[max(0, at - 20) : at].startswith(_END_64):
        raise InputError("it holds more than a project may")


def _check_entries(found: list[zipfile.ZipInfo], size: int) -> None:
    names = [info.filename for info in found]
    if DOCUMENT not in names:
        raise InputError("this is not a BobDesk project")
    if len(set(names)) < len(names):
        raise InputError("it holds two parts of one name")
    unpacked = 0
    for info in found:
        largest = _largest(info.filename)
        if largest is None:
            raise InputError("it holds a part that is none of a project's")
        if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED) or info.flag_bits & 1:
            raise InputError("it is packed or locked in a way that cannot be read")
        if info.compress_type == zipfile.ZIP_STORED and info.file_size > size:
            raise InputError("the file is damaged: its parts are longer than it is")
        if info.file_size > largest or info.file_size > 1000 + _HIGHEST_RATIO * info.compress_size:
            raise InputError("a part of it unpacks to more than it may")
        unpacked += 0 if info.compress_type == zipfile.ZIP_STORED else info.file_size
    if unpacked > _LARGEST_UNPACKED or sum(info.compress_size for info in found) > size:
        raise InputError("it unpacks to more than a project may")


def _largest(name: str) -> int | None:
    if name == DOCUMENT:
        return MOST_DOCUMENT_BYTES
    if name == PICTURE:
        return _LARGEST_PICTURE
    return _LARGEST_TABLE if _TABLE.fullmatch(name) else None

"""KMZ: a ZIP archive with a KML file in it, unpacked into memory and never to the disk."""

from __future__ import annotations

import io
import zipfile
import zlib
from pathlib import PurePosixPath

from bobdesk.errors import InputError
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.importers.kml import read_kml

_LIMIT_PACKED = 64_000_000
_LIMIT_UNPACKED = 64_000_000
_LIMIT_ENTRIES = 2_000
_LIMIT_RATIO = 200
_SMALL = 1_000_000
_ENTRY_MARK = b"PK\x01\x02"
_UNDERSTOOD = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)


def read_kmz(data: bytes, *, name: str) -> ImportedLine:
    """Read the longest line of the first KML file in a KMZ archive.

    Raises
    ------
    InputError
        If the archive is damaged, over a limit, has entries outside its folder, or holds no KML.
    """
    if len(data) > _LIMIT_PACKED:
        raise InputError(f"{name}: the archive is {len(data) / 1e6:,.0f} MB large; the most that is read is 64 MB")
    # Counted before the list of entries is built, which takes ten times the memory of the file.
    if data.count(_ENTRY_MARK) > _LIMIT_ENTRIES:
        raise InputError(f"{name}: the archive holds over {_LIMIT_ENTRIES:,} files and is not opened")
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            content = _kml_in(archive, name=name)
    except (zipfile.BadZipFile, zlib.error, EOFError, OSError, RuntimeError, ValueError) as error:
        raise InputError(f"{name}: the archive is damaged or encrypted and cannot be unpacked") from error
    return read_kml(content, name=name)


def _kml_in(archive: zipfile.ZipFile, *, name: str) -> bytes:
    entries = archive.infolist()
    for entry in entries:
        place = PurePosixPath(entry.filename.replace("\\", "/"))
        if place.is_absolute() or ".." in place.parts or ":" in entry.filename[:2]:
            raise InputError(f"{name}: the archive names a place outside its folder and is not opened")
    documents = [entry for entry in entries if entry.filename.lower().endswith(".kml")]
    if not documents:
        raise InputError(f"{name}: there is no KML file in the archive")
    chosen = next((entry for entry in documents if entry.filename.lower() == "doc.kml"), documents[0])
    if chosen.flag_bits & 1 or chosen.compress_type not in _UNDERSTOOD:
        raise InputError(f"{name}: the archive is encrypted or packed in an unusual way and cannot be unpacked")
    ratio = chosen.file_size / max(chosen.compress_size, 1)
    if chosen.file_size > _LIMIT_UNPACKED or (chosen.file_size > _SMALL and ratio > _LIMIT_RATIO):
        raise InputError(
            f"{name}: the archive would unpack to {chosen.file_size / 1e6:,.0f} MB, {ratio:,.0f} times its size,"
            " and is not opened"
        )
    # What the archive says of its size may be a lie.
    with archive.open(chosen) as stream:
        content = stream.read(_LIMIT_UNPACKED + 1)
    if len(content) > _LIMIT_UNPACKED:
        raise InputError(f"{name}: the archive unpacks to over {_LIMIT_UNPACKED // 1_000_000} MB and is not opened")
    return content

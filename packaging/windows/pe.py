"""What programs and libraries for Windows (PE files of 64 bits) take from others, and offer."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path

_EXPORTS, _IMPORTS, _LATE_IMPORTS = 0, 1, 13
_BY_NUMBER = 1 << 63


class PortableExecutable:
    """A file that is looked into.

    Raises
    ------
    ValueError
        If it is no such file.
    """

    def __init__(self, path: Path) -> None:
        self._data = data = path.read_bytes()
        (start,) = struct.unpack_from("<I", data, 0x3C) if data[:2] == b"MZ" else (0,)
        if data[start : start + 4] != b"PE\0\0" or struct.unpack_from("<H", data, start + 24) != (0x20B,):
            raise ValueError(f"{path} is no program or library of 64 bits for Windows")
        sections, size = struct.unpack_from("<H12xH", data, start + 6)
        count = struct.unpack_from("<I", data, start + 24 + 108)[0]
        self._tables = [struct.unpack_from("<II", data, start + 24 + 112 + 8 * at) for at in range(count)]
        first = start + 24 + size
        self._sections = [struct.unpack_from("<8xIIII", data, first + 40 * at) for at in range(sections)]

    def imports(self) -> dict[str, set[str]]:
        """Return the functions taken from each library, whose name is in small letters; "#7" is one by number."""
        found: dict[str, set[str]] = {}
        for table, size, layout in ((_IMPORTS, 20, "<I8xII"), (_LATE_IMPORTS, 32, "<4xI8xI")):
            at = self._place(table)
            while at:
                row = struct.unpack_from(layout, self._data, at)
                name, names = (row[1], row[0] or row[2]) if table == _IMPORTS else row
                if not name:
                    break
                found.setdefault(self._text(name).lower(), set()).update(self._functions(names))
                at += size
        return found

    def exports(self) -> set[str]:
        """Return the names of the functions and variables that are offered."""
        at = self._place(_EXPORTS)
        if not at:
            return set()
        count, names = struct.unpack_from("<I4xI", self._data, at + 24)
        table = self._offset(names)
        return {self._text(one) for (one,) in struct.iter_unpack("<I", self._data[table : table + 4 * count])}

    def _functions(self, names: int) -> Iterator[str]:
        at = self._offset(names)
        while (one := struct.unpack_from("<Q", self._data, at)[0]) != 0:
            yield f"#{one & 0xFFFF}" if one & _BY_NUMBER else self._text((one & 0x7FFFFFFF) + 2)
            at += 8

    def _place(self, table: int) -> int:
        address = self._tables[table][0] if table < len(self._tables) else 0
        return self._offset(address) if address else 0

    def _text(self, address: int) -> str:
        at = self._offset(address)
        return self._data[at : self._data.index(b"\0", at)].decode("ascii")

    def _offset(self, address: int) -> int:
        for length, start, stored, offset in self._sections:
            if start <= address < start + max(length, stored):
                return address - start + offset
        raise ValueError(f"nothing lies at address {address:#x}")


def executables(folder: Path) -> Iterator[Path]:
    """Yield all programs and libraries below a folder."""
    yield from (path for path in sorted(folder.rglob("*")) if path.suffix.lower() in (".dll", ".pyd", ".exe"))

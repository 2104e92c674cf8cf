"""Tables of float64 as .npy bytes: one fixed form, so that equal tables are equal bytes.

NumPy's own reader takes any header that a file brings, and its writer's padding may change; here the
header is known beforehand, and whatever else a file holds is refused before memory is taken for it.

References
----------
https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html, version 1.0.
"""

from __future__ import annotations

import numpy as np

from bobdesk.arrays import FloatArray

_MAGIC = b"\x93NUMPY\x01\x00"
_HEADER_BYTES = 128


def npy_bytes(table: FloatArray) -> bytes:
    """Return a table (n, k) as the bytes of a .npy file."""
    return _header(*table.shape) + np.ascontiguousarray(table, dtype="<f8").tobytes()


def npy_table(data: bytes, *, columns: int) -> FloatArray:
    """Return the table (n, `columns`) in the bytes of a .npy file that `npy_bytes` wrote, read-only.

    Raises
    ------
    ValueError
        If they are anything else.
    """
    rows, rest = divmod(len(data) - _HEADER_BYTES, 8 * columns)
    if rows < 0 or rest or data[:_HEADER_BYTES] != _header(rows, columns):
        raise ValueError("a table of numbers in it is damaged")
    table = np.frombuffer(data, dtype="<f8", offset=_HEADER_BYTES).astype(np.float64).reshape(rows, columns)
    table.flags.writeable = False
    return table


def _header(rows: int, columns: int) -> bytes:
    text = f"{{'descr': '<f8', 'fortran_order': False, 'shape': ({rows}, {columns}), }}".encode()
    room = _HEADER_BYTES - len(_MAGIC) - 2
    return _MAGIC + room.to_bytes(2, "little") + text.ljust(room - 1) + b"\n"

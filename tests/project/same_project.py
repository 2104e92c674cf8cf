"""Whether two projects are equal to the last bit, and a print of one to see that it never changed."""

from __future__ import annotations

import dataclasses
import struct
from typing import Any

import numpy as np


def print_of(value: Any) -> Any:
    """Return all of a value as nested tuples: floats by their bits, arrays by their bytes."""
    if dataclasses.is_dataclass(value):
        return (
            type(value).__name__,
            *(print_of(getattr(value, field.name)) for field in dataclasses.fields(value)),
        )
    if isinstance(value, np.ndarray):
        return (value.dtype.str, value.shape, value.tobytes())
    if isinstance(value, list | tuple):
        return tuple(print_of(item) for item in value)
    if isinstance(value, int | float) and not isinstance(value, bool):
        # 1 and 1.0 are the same setting; everything else must have the same bits.
        return struct.pack("<d", value)
    return value

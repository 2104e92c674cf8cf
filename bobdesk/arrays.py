"""Read-only float64 arrays, so that frozen dataclasses are frozen all the way down."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
BoolArray = npt.NDArray[np.bool_]


def frozen(values: npt.ArrayLike, *, columns: int | None = None) -> FloatArray:
    """Return a read-only float64 copy of `values`.

    Parameters
    ----------
    values
        Anything numpy can make a float array of.
    columns
        If given, the result must have the shape (n, columns).

    Raises
    ------
    ValueError
        If the shape is another than asked for.
    """
    array = np.array(values, dtype=np.float64)
    if columns is not None and (array.ndim != 2 or array.shape[1] != columns):
        raise ValueError(f"expected shape (n, {columns}), got {array.shape}")
    array.flags.writeable = False
    return array

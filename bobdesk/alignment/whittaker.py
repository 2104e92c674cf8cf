"""Whittaker smoothing: penalised least squares with a wavelength for a setting."""

from __future__ import annotations

import math

import numpy as np
from scipy.linalg import solveh_banded

from bobdesk.arrays import FloatArray

ORDER = 3


def whittaker(values: FloatArray, *, spacing: float, wavelength: float, order: int = ORDER) -> FloatArray:
    """Smooth equally spaced values.

    Minimises sum (z - y)^2 + lambda * sum (difference of `order` of z)^2, so that a wave of
    `wavelength` keeps half of its amplitude; longer waves pass (a circle of radius 15 m and a
    wavelength of 15 m: 1.6e-5 of its radius is lost), shorter ones do not. Straights and parabolas
    are kept exactly.

    Parameters
    ----------
    values : (n,) or (n, m)
        Samples, one column a quantity.
    spacing
        Distance between neighbouring samples, m.
    wavelength
        Half-power wavelength, m; 0 leaves the values as they are.
    order
        Order of the difference that is penalised.

    Returns
    -------
    Smoothed values, of the same shape.

    References
    ----------
    E. T. Whittaker, On a new method of graduation, Proc. Edinburgh Math. Soc. 41 (1923).
    P. H. C. Eilers, A perfect smoother, Anal. Chem. 75 (2003).
    """
    count = len(values)
    if wavelength <= 0 or count <= order:
        return values.copy()
    penalty = (wavelength / (2 * math.pi * spacing)) ** (2 * order)
    bands = penalty * _difference_gram(count, order)
    bands[-1] += 1.0
    smoothed: FloatArray = solveh_banded(bands, values, check_finite=False)
    return smoothed


def _difference_gram(count: int, order: int) -> FloatArray:
    """Return D'D of the difference matrix of `order`, as upper bands for `solveh_banded`."""
    signs = np.array([(-1.0) ** (order - k) * math.comb(order, k) for k in range(order + 1)])
    bands = np.zeros((order + 1, count))
    rows = count - order
    for offset in range(order + 1):
        for first in range(order + 1 - offset):
            start = first + offset
            bands[order - offset, start : start + rows] += signs[first] * signs[first + offset]
    return bands

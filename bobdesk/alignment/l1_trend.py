"""Piecewise linear curvature by an L1 trend filter on the offsets from a smooth line."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.linalg import cho_solve_banded, cholesky_banded

from bobdesk.arrays import FloatArray

STIFFNESS = 2.0
_RELINEARISATIONS = 3
_SWEEPS = 150
_OVER_RELAXATION = 1.6


def l1_curvature(raw: FloatArray, smooth: FloatArray, *, spacing: float, stiffness: float = STIFFNESS) -> FloatArray:
    """Fit a line whose curvature is piecewise linear: straights, arcs and clothoids.

    Minimises 1/2 integral (offset from the raw points)^2 + stiffness * integral |second derivative
    of the curvature|, with the curvature linearised about the current line (offset'' + k^2 offset), by
    ADMM with over-relaxation; the system is banded, so the cost grows with n only.

    Parameters
    ----------
    raw : (n, 2)
        Unsmoothed points at equal stations, m.
    smooth : (n, 2)
        A first smooth line beside them.
    spacing
        Distance between stations, m.
    stiffness
        Weight of the kinks of the curvature, m^4; larger means fewer pieces. 2 suits noise of 0.1 m:
        error of the curvature 2.8e-3 1/m with white noise, where the smoothed curve has 3.5e-3.

    Returns
    -------
    Curvature at each station, (n,), 1/m, left positive.

    References
    ----------
    S.-J. Kim, K. Koh, S. Boyd, D. Gorinevsky, l1 Trend Filtering, SIAM Review 51 (2009).
    """
    line = smooth
    result = _differences(line, spacing)
    for _ in range(_RELINEARISATIONS):
        tangent = np.gradient(line, spacing, axis=0)
        tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
        normal = np.column_stack([-tangent[:, 1], tangent[:, 0]])
        reference = _differences(line, spacing)
        measured = ((raw - line) * normal).sum(axis=1)
        offset, result = _trend(measured, reference, spacing=spacing, stiffness=stiffness / spacing**2)
        line = line + normal * offset[:, None]
    return result


def _differences(line: FloatArray, spacing: float) -> FloatArray:
    first = np.gradient(line, spacing, axis=0)
    second = np.gradient(first, spacing, axis=0)
    result: FloatArray = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / np.hypot(*first.T) ** 3
    return result


def _trend(
    measured: FloatArray, reference: FloatArray, *, spacing: float, stiffness: float
) -> tuple[FloatArray, FloatArray]:
    """Return the offsets and the curvature they lead to, for one linearisation."""
    count = len(measured)
    to_curvature = _second_derivative(count, spacing) + sparse.diags_array(reference**2)
    kinks_of_offset = (_second_difference(count) @ to_curvature).tocsr()
    kinks_of_reference = _second_difference(count) @ reference
    scale = np.median(np.abs(kinks_of_reference)) + 1e-9
    penalty = 0.8 * stiffness / scale
    system = sparse.eye_array(count) + penalty * (kinks_of_offset.T @ kinks_of_offset)
    factor = cholesky_banded(_upper_bands(sparse.csr_array(system), 6), check_finite=False)

    kinks, dual = kinks_of_reference.copy(), np.zeros_like(kinks_of_reference)
    offset = np.zeros(count)
    for _ in range(_SWEEPS):
        right = measured + penalty * (kinks_of_offset.T @ (kinks - dual - kinks_of_reference))
        offset = cho_solve_banded((factor, False), right, check_finite=False)
        relaxed = _OVER_RELAXATION * (kinks_of_offset @ offset + kinks_of_reference) + (1 - _OVER_RELAXATION) * kinks
        shifted = relaxed + dual
        kinks = np.sign(shifted) * np.maximum(np.abs(shifted) - stiffness / penalty, 0.0)
        dual = shifted - kinks
    return offset, reference + to_curvature @ offset


def _second_difference(count: int) -> sparse.csr_array:
    shape = (count - 2, count)
    second = sparse.eye_array(*shape) - 2 * sparse.eye_array(*shape, k=1) + sparse.eye_array(*shape, k=2)
    return sparse.csr_array(second)


def _second_derivative(count: int, spacing: float) -> sparse.csr_array:
    """Return the operator of the second derivative, with the ends' rows repeated."""
    inner = sparse.csr_array(_second_difference(count) / spacing**2)
    return sparse.csr_array(sparse.vstack([inner[:1], inner, inner[-1:]]))


def _upper_bands(matrix: sparse.csr_array, width: int) -> FloatArray:
    bands = np.zeros((width + 1, matrix.shape[0]))
    for offset in range(width + 1):
        bands[width - offset, offset:] = matrix.diagonal(offset)
    return bands

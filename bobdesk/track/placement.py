"""One plan laid over another, where the two have no common origin."""

from __future__ import annotations

import numpy as np

from bobdesk.arrays import FloatArray

_PLACES = 400


def laid_over(points: FloatArray, onto: FloatArray) -> FloatArray:
    """Return `points` (n, 2) moved, turned and scaled so that they lie as near to the line `onto` (m, 2) as can be.

    Both are compared at equal shares of their lengths. A plan with y down is turned over, for the one with y up is
    the other's mirror image; which of the two fits better is taken.

    References
    ----------
    S. Umeyama, Least-squares estimation of transformation parameters between two point patterns, IEEE Trans. PAMI 13
    (1991).
    """
    one, other = _at_shares(points), _at_shares(onto)
    mean, mean_other = one.mean(axis=0), other.mean(axis=0)
    spread = float(((one - mean) ** 2).sum())
    if spread == 0.0:
        moved: FloatArray = points + (mean_other - mean)
        return moved
    best: tuple[float, FloatArray] | None = None
    u, sizes, vt = np.linalg.svd((other - mean_other).T @ (one - mean))
    for turned_over in (1.0, -1.0):
        signs = np.array([1.0, np.sign(np.linalg.det(u @ vt)) * turned_over])
        turn = u @ np.diag(signs) @ vt
        scale = float(sizes @ signs) / spread
        fitted = scale * (points - mean) @ turn.T + mean_other
        missed = float(((scale * (one - mean) @ turn.T + mean_other - other) ** 2).sum())
        if best is None or missed < 0.5 * best[0]:
            best = (missed, fitted)
    assert best is not None
    return best[1]


def _at_shares(points: FloatArray) -> FloatArray:
    stations = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    shares = np.linspace(0.0, stations[-1], _PLACES)
    return np.column_stack([np.interp(shares, stations, points[:, axis]) for axis in (0, 1)])

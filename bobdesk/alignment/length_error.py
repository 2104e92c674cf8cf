"""How far the plan length may be wrong because no hand and no tracer places vertices exactly."""

from __future__ import annotations

import math

import numpy as np

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.curvature import curvature

# Where less of the noise shows, what shows tells nothing of the rest.
_LEAST_TAKEN_AWAY = 0.1


def length_sigma_of_vertices(line: Centreline, *, vertex_distance: float, wavelength: float) -> float | None:
    """Return 1 sigma of the plan length that follows from the vertices' noise, m.

    A line that is moved sideways by n(s) becomes longer by -∫ κ n ds. Let n be noise of the variance σ²
    that is independent over the distance h: the variance of the length then is σ² h ∫ κ² ds, and 2 σ²
    more for the two ends. σ is taken from what the smoothing of wavelength w has taken away: of noise of
    vertices h apart, whose shortest wave is 2 h, that is the share 1 - 2 h / w of the variance.

    Parameters
    ----------
    line
        The fitted line; the noise is judged by its unsmoothed stations.
    vertex_distance
        Mean distance between the vertices, m.
    wavelength
        Of the smoothing, m. Noise that is longer stays unseen; a tracer's neighbouring vertices err
        together, so h is taken to be w / 2 at least before the share is made up for.

    Returns
    -------
    None if hardly anything was smoothed away, so that nothing can be said.
    """
    way = np.gradient(line.points, axis=0)
    way /= np.maximum(np.hypot(way[:, 0], way[:, 1]), 1e-12)[:, None]
    apart = line.raw_points - line.points
    aside = apart[:, 1] * way[:, 0] - apart[:, 0] * way[:, 1]
    sigma = math.sqrt(float(np.mean(aside**2)))
    taken_away = 1 - 2 * vertex_distance / wavelength if wavelength > 0 else 0.0
    if taken_away < _LEAST_TAKEN_AWAY or sigma == 0:
        return None
    independent = max(vertex_distance / taken_away, wavelength / 2)
    bent = float(np.sum(curvature(line) ** 2)) * line.spacing
    return sigma * math.sqrt(2 / taken_away + independent * bent)

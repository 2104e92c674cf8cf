"""A line beside the actual track: how far its elevation and gradient are off."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray

_STEP = 1.0
_FEWEST_STEPS = 50
_MOST_STEPS = 1_000_000


@dataclass(frozen=True)
class Comparison:
    """A line less the actual track.

    Attributes
    ----------
    z_rms, z_max
        Root mean square and largest difference of elevation, m; elevations count from each line's
        lowest point.
    z_max_station
        Where the largest is, m along the actual track's plan.
    z_rms_percent
        Of the actual drop.
    gradient_rms
        Root mean square difference of the gradient.
    length_percent, drop_percent, mean_gradient_percent, plan_length_percent
        Deviations from the actual figures, %. The mean gradient is drop / length.
    """

    z_rms: float
    z_max: float
    z_max_station: float
    z_rms_percent: float
    gradient_rms: float
    length_percent: float
    drop_percent: float
    mean_gradient_percent: float
    plan_length_percent: float


def compare(line: FloatArray, actual: FloatArray) -> Comparison:
    """Compare two lines in space at equal shares of their plan lengths.

    Lines that were digitised apart never have the same plan length to the metre; equal shares keep
    curves beside curves, and need no common origin or direction.

    Parameters
    ----------
    line, actual : (n, 3), (m, 3)
        x, y, z, m, from start to end.
    """
    station, reference = _stations(line), _stations(actual)
    steps = int(np.clip(round(reference[-1] / _STEP), _FEWEST_STEPS, _MOST_STEPS))
    share = np.linspace(0.0, 1.0, steps + 1)
    z = np.interp(share, station / station[-1], line[:, 2] - line[:, 2].min())
    z_actual = np.interp(share, reference / reference[-1], actual[:, 2] - actual[:, 2].min())
    apart = z - z_actual
    gradients = -np.diff(z) * steps / station[-1]
    actual_gradients = -np.diff(z_actual) * steps / reference[-1]
    drop, length = _drop(line), _length(line)
    actual_drop, actual_length = _drop(actual), _length(actual)
    rms = float(np.sqrt((apart**2).mean()))
    worst = int(np.abs(apart).argmax())
    return Comparison(
        z_rms=rms,
        z_max=float(np.abs(apart).max()),
        z_max_station=float(share[worst] * reference[-1]),
        z_rms_percent=100 * rms / actual_drop if actual_drop else float("nan"),
        gradient_rms=float(np.sqrt(((gradients - actual_gradients) ** 2).mean())),
        length_percent=_percent(length, actual_length),
        drop_percent=_percent(drop, actual_drop),
        mean_gradient_percent=_percent(drop / length, actual_drop / actual_length),
        plan_length_percent=_percent(float(station[-1]), float(reference[-1])),
    )


def _stations(points: FloatArray) -> FloatArray:
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points[:, :2], axis=0).T))])


def _length(points: FloatArray) -> float:
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def _drop(points: FloatArray) -> float:
    return float(points[0, 2] - points[:, 2].min())


def _percent(value: float, actual: float) -> float:
    return 100 * (value - actual) / actual if actual else float("nan")

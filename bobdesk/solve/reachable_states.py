"""Sets of states (elevation, gradient) that a profile can be in: convex, and exact under what is done to them."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from bobdesk.arrays import BoolArray, FloatArray

_SLACK = 1e-9


@dataclass(frozen=True, eq=False)
class States:
    """A convex set of pairs of gradient and elevation.

    For each gradient the elevations lie between two piecewise linear functions, the lower one convex, the
    upper one concave; both are defined on the same range of gradients.

    Attributes
    ----------
    upper, lower : (2, u), (2, l)
        Rows: gradients in rising order, and elevations there, m.
    """

    upper: FloatArray
    lower: FloatArray

    def changed_by(self, most: float) -> States:
        """Return the states after the gradient has changed by up to `most`, the elevation staying."""
        return States(
            _widened(self.upper, int(self.upper[1].argmax()), most),
            _widened(self.lower, int(self.lower[1].argmin()), most),
        )

    def fallen(self, distance: float) -> States:
        """Return the states after running `distance`, m, at their gradient; before it, if negative."""
        return States(_sheared(self.upper, distance), _sheared(self.lower, distance))

    def with_gradients(self, low: float, high: float) -> States | None:
        """Return the states with a gradient in a range; None if there is none."""
        low = max(low, float(self.upper[0, 0]))
        high = min(high, float(self.upper[0, -1]))
        if low > high + _SLACK:
            return None
        high = max(low, high)
        return States(_cut(self.upper, low, high), _cut(self.lower, low, high))

    def with_elevations(self, low: float, high: float) -> States | None:
        """Return the states with an elevation in a range; None if there is none."""
        fits = self._where(self.upper, at_least=low)
        if fits is not None and high < np.inf:
            fits = fits._where(_mirrored(fits.lower), at_least=-high)
        if fits is None:
            return None
        upper = _capped(fits.upper, high)
        return States(upper, _mirrored(_capped(_mirrored(fits.lower), -low)))

    def _where(self, concave: FloatArray, *, at_least: float) -> States | None:
        """Return the states at gradients where a concave function is large enough."""
        gradients, values = concave
        enough = values >= at_least
        if enough.all():
            return self
        if not enough.any():
            best = int(values.argmax())
            if values[best] < at_least - _SLACK:
                return None
            return self.with_gradients(float(gradients[best]), float(gradients[best]))
        first, last = int(enough.argmax()), len(enough) - 1 - int(enough[::-1].argmax())
        low, high = float(gradients[first]), float(gradients[last])
        if first > 0:
            low = _crossing(concave, first - 1, at_least)
        if last < len(enough) - 1:
            high = _crossing(concave, last, at_least)
        return self.with_gradients(low, high)


def elevations_in_both(one: States, other: States) -> tuple[float, float] | None:
    """Return the lowest and highest elevation of the states that lie in both sets, or None."""
    low = max(one.upper[0, 0], other.upper[0, 0])
    high = min(one.upper[0, -1], other.upper[0, -1])
    if low > high + _SLACK:
        return None
    functions = (one.upper, other.upper, one.lower, other.lower)
    breaks = np.concatenate([[low, max(low, high)], *(each[0] for each in functions)])
    breaks = np.unique(np.clip(breaks, low, max(low, high)))
    values = [np.interp(breaks, *each) for each in functions]
    meet = [breaks]
    for first, second in combinations(values, 2):
        apart = first - second
        between = np.flatnonzero(apart[:-1] * apart[1:] < 0)
        share = apart[between] / (apart[between] - apart[between + 1])
        meet.append(breaks[between] + share * (breaks[between + 1] - breaks[between]))
    at = np.concatenate(meet)
    values = [np.interp(at, *each) for each in functions]
    upper, lower = np.minimum(values[0], values[1]), np.maximum(values[2], values[3])
    inside: BoolArray = upper >= lower - _SLACK
    if not inside.any():
        return None
    return float(lower[inside].min()), float(upper[inside].max())


def _widened(function: FloatArray, top: int, most: float) -> FloatArray:
    widened = np.concatenate([function[:, : top + 1], function[:, top:]], axis=1)
    widened[0, : top + 1] -= most
    widened[0, top + 1 :] += most
    return widened


def _mirrored(function: FloatArray) -> FloatArray:
    return np.stack([function[0], -function[1]])


def _sheared(function: FloatArray, distance: float) -> FloatArray:
    return np.stack([function[0], function[1] - distance * function[0]])


def _cut(function: FloatArray, low: float, high: float) -> FloatArray:
    gradients = function[0]
    first = int(np.searchsorted(gradients, low, side="right"))
    last = int(np.searchsorted(gradients, high, side="left"))
    ends = np.interp([low, high], gradients, function[1])
    inner = function[:, first : max(first, last)]
    return np.concatenate([[[low], [ends[0]]], inner, [[high], [ends[1]]]], axis=1)


def _capped(concave: FloatArray, most: float) -> FloatArray:
    """Return the smaller of a concave function and a number."""
    gradients, values = concave
    above = np.flatnonzero(values > most)
    if len(above) == 0:
        return concave
    first, last = int(above[0]), int(above[-1])
    low = float(gradients[0]) if first == 0 else _crossing(concave, first - 1, most)
    high = float(gradients[-1]) if last == len(values) - 1 else _crossing(concave, last, most)
    flat = np.array([[low, high], [most, most]])
    return np.concatenate([concave[:, :first], flat, concave[:, last + 1 :]], axis=1)


def _crossing(function: FloatArray, index: int, value: float) -> float:
    """Return the gradient at which a function has a value, between an index and the next."""
    (start, end), (before, after) = function[:, index : index + 2]
    return float(start + (end - start) * (value - before) / (after - before))

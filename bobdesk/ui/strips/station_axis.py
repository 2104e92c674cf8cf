"""The axis that all strips share: which stretch of the line they show."""

from __future__ import annotations

import math

import numpy as np
from PySide6.QtCore import QObject, Signal

from bobdesk.arrays import FloatArray

_CLOSEST = 2.0
_MARGIN = 0.015
_NOTHING = 1e-9


class StationAxis(QObject):
    """A stretch of stations, m.

    Signals
    -------
    changed
        Another stretch is shown.
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._length = 1000.0
        self._low, self._high = self._whole()

    @property
    def low(self) -> float:
        """First station that is shown, m."""
        return self._low

    @property
    def high(self) -> float:
        """Last station that is shown, m."""
        return self._high

    @property
    def length(self) -> float:
        """Length of the line, m."""
        return self._length

    @property
    def shows_all(self) -> bool:
        """Whether the whole line is shown."""
        first, last = self._whole()
        return self._low <= first + _NOTHING * self._length and self._high >= last - _NOTHING * self._length

    def set_length(self, length: float) -> None:
        """Take a line of another length; what is shown stays unless it was the whole line."""
        if length == self._length:
            return
        was_whole = self.shows_all
        self._length = length
        if was_whole:
            self._low, self._high = self._whole()
        else:
            self._keep_on_the_line()
        self.changed.emit()

    def fit(self) -> None:
        """Show the whole line."""
        self.show(*self._whole())

    def show(self, low: float, high: float) -> None:
        """Show a stretch."""
        if high < low:
            low, high = high, low
        middle, half = (low + high) / 2, max(high - low, _CLOSEST) / 2
        before = (self._low, self._high)
        self._low, self._high = middle - half, middle + half
        self._keep_on_the_line()
        if (self._low, self._high) != before:
            self.changed.emit()

    def zoom(self, factor: float, at: float) -> None:
        """Show a stretch that is `factor` times shorter, with the station `at` staying where it is."""
        span = max((self._high - self._low) / factor, _CLOSEST)
        share = (at - self._low) / (self._high - self._low)
        self.show(at - share * span, at + (1 - share) * span)

    def pan(self, by: float) -> None:
        """Move on by so many metres."""
        self.show(self._low + by, self._high + by)

    def bring_in(self, station: float) -> None:
        """Move no more than needed to show a station."""
        margin = 0.05 * (self._high - self._low)
        if station < self._low:
            self.pan(station - margin - self._low)
        elif station > self._high:
            self.pan(station + margin - self._high)

    def _whole(self) -> tuple[float, float]:
        return -_MARGIN * self._length, (1 + _MARGIN) * self._length

    def _keep_on_the_line(self) -> None:
        first, last = self._whole()
        span = min(self._high - self._low, last - first)
        self._low = min(max(self._low, first), last - span)
        self._high = self._low + span


def ticks(low: float, high: float, most: int) -> tuple[FloatArray, int]:
    """Return round numbers between two, at most so many, and the decimals they need."""
    span = high - low
    if not (math.isfinite(span) and span > 0):
        return np.array([low]), 0
    rough = span / max(most, 1)
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(size * power for size in (1, 2, 5, 10) if size * power >= rough * (1 - 1e-9))
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    found: FloatArray = np.arange(first, last + 1).astype(np.float64) * step
    return found, max(0, -math.floor(math.log10(step) + 1e-9))

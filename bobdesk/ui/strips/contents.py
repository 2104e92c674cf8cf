"""What a strip shows: curves, bands, levels and marks, each known by a key."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPen

from bobdesk.arrays import FloatArray
from bobdesk.ui.theme import colours

_MEDIAN_OVER_M = 10.0
# Points: a spike of a bad elevation is two of them wide, and more than the most take long for nothing.
_FEWEST_OF_MEDIAN, _MOST_OF_MEDIAN = 5, 25


def shade(colour: str, alpha: int = 255) -> QColor:
    """Return a colour of the theme by its name there, or any other as #rrggbb."""
    found = QColor(colour if colour.startswith("#") else getattr(colours(), colour))
    found.setAlpha(alpha)
    return found


@dataclass(frozen=True, eq=False)
class Curve:
    """Values by station.

    Attributes
    ----------
    stations, values : (n,)
        Ascending stations, m, and values in SI.
    colour
        Name of a colour in the theme, or #rrggbb.
    width, style, alpha
        Of the pen.
    counts
        Whether the strip's range follows it; a noisy curve in the background does not.
    counted : (n,)
        What the range follows in the place of the values, such as these without spikes; None for the values.
    column
        Its column in an exported table; "" leaves it out.
    steps
        Values hold up to the next station instead of running straight to it.
    """

    stations: FloatArray
    values: FloatArray
    colour: str = "text"
    width: float = 1.4
    style: Qt.PenStyle = Qt.PenStyle.SolidLine
    alpha: int = 255
    counts: bool = True
    counted: FloatArray | None = None
    column: str = ""
    steps: bool = False

    def pen(self) -> QPen:
        """Return the pen it is drawn with."""
        made = QPen(shade(self.colour, self.alpha), self.width, self.style)
        made.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
        return made


@dataclass(frozen=True, eq=False)
class Band:
    """The area between two curves over the same stations (n,).

    Attributes
    ----------
    has_edges
        Its two curves are dotted: where several areas lie over each other, shades alone say too little.
    """

    stations: FloatArray
    low: FloatArray
    high: FloatArray
    colour: str = "accent"
    alpha: int = 40
    has_edges: bool = False


@dataclass(frozen=True, eq=False)
class Bundle:
    """Many faint curves over the same stations.

    Attributes
    ----------
    stations : (n,)
        m.
    values : (c, n)
        In SI.
    """

    stations: FloatArray
    values: FloatArray
    colour: str = "preview"
    alpha: int = 70


@dataclass(frozen=True)
class Level:
    """A horizontal line.

    Attributes
    ----------
    value
        SI.
    label
        Stands above its right end.
    is_draggable
        Whether the mouse may move it.
    counts
        Whether the strip's range includes it.
    """

    value: float
    label: str = ""
    colour: str = "error"
    style: Qt.PenStyle = Qt.PenStyle.DashLine
    is_draggable: bool = False
    counts: bool = True


@dataclass(frozen=True, eq=False)
class Marks:
    """Points, drawn as diamonds.

    Attributes
    ----------
    stations, values : (n,)
        m, and SI.
    is_draggable
        Whether the mouse may move one.
    """

    stations: FloatArray
    values: FloatArray
    colour: str = "text"
    size: float = 6.0
    is_draggable: bool = False


def decimated(
    stations: FloatArray, values: FloatArray, low: float, high: float, columns: int
) -> tuple[FloatArray, FloatArray]:
    """Return the points of a curve between two stations, first, lowest, highest and last of each column of pixels.

    Parameters
    ----------
    stations, values : (n,)
        The curve; not finite values leave gaps.
    columns
        Pixels that it is drawn over.
    """
    first = max(int(np.searchsorted(stations, low)) - 1, 0)
    last = min(int(np.searchsorted(stations, high, "right")) + 1, len(stations))
    x, y = stations[first:last], values[first:last]
    if len(x) <= 4 * columns or columns < 1:
        return x, y
    column = ((x - low) * (columns / (high - low))).astype(np.int64)
    starts = np.flatnonzero(np.diff(column, prepend=column[0] - 1))
    ends = np.append(starts[1:], len(x)) - 1
    lowest, highest = np.minimum.reduceat(y, starts), np.maximum.reduceat(y, starts)
    rising = y[ends] >= y[starts]
    middle = 0.5 * (x[starts] + x[ends])
    at = np.column_stack([x[starts], middle, middle, x[ends]]).ravel()
    second, third = np.where(rising, lowest, highest), np.where(rising, highest, lowest)
    return at, np.column_stack([y[starts], second, third, y[ends]]).ravel()


def without_spikes(stations: FloatArray, values: FloatArray) -> FloatArray:
    """Return values as their median over 10 m, and at least 5 points: without the spikes of single bad points.

    Parameters
    ----------
    stations, values : (n,)
        Ascending stations, m.
    """
    from scipy.ndimage import median_filter

    if len(values) < _FEWEST_OF_MEDIAN:
        return values
    wide = _MEDIAN_OVER_M / max(float(np.median(np.diff(stations))), 1e-9)
    points = int(min(max(wide, _FEWEST_OF_MEDIAN), _MOST_OF_MEDIAN)) // 2 * 2 + 1
    found: FloatArray = median_filter(values, points, mode="nearest")
    return found


def stepped(stations: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the corners of a curve whose values hold up to the next station."""
    return np.repeat(stations, 2)[1:], np.repeat(values, 2)[:-1]

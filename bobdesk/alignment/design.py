"""A designer's list of curves, and where along a line it lies best."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from bobdesk.alignment.segments import Segments

MOST_CURVES = 1000
Side = Literal["left", "right"]
_GRID = 0.5
_FARTHEST = 200


@dataclass(frozen=True)
class DesignCurve:
    """One curve as it was designed.

    Attributes
    ----------
    start, length
        Station where it begins and length, m, in the designer's count.
    radius
        m.
    side
        Which way it turns, None where the list does not say.
    name
        May be empty.
    """

    start: float
    length: float
    radius: float
    side: Side | None = None
    name: str = ""

    @property
    def end(self) -> float:
        """Station where it ends, m."""
        return self.start + self.length


@dataclass(frozen=True)
class DesignList:
    """Curves in order.

    Attributes
    ----------
    name
        What the list is called.
    offset
        Station of the line at which the list's station 0 lies, m.
    """

    name: str
    curves: tuple[DesignCurve, ...]
    offset: float = 0.0


def best_offset(design: DesignList, segments: Segments) -> float:
    """Return the offset at which curves of the list lie best over curves of ours, m, to half a metre.

    Designers count from the timing start, which lies some 20 m behind the start of the line.
    """
    if not segments:
        return 0.0
    # What lies so far behind our line that no offset brings it there says nothing, and one wrong digit can be 10^9 m.
    length = max(segments[-1].end, min(design.curves[-1].end, segments[-1].end + _FARTHEST * _GRID))
    stations = np.arange(0.0, length, _GRID)
    ours, theirs = np.full(len(stations), -1.0), np.full(len(stations), -1.0)
    for segment in segments:
        if segment.kind == "curve":
            ours[(stations >= segment.start) & (stations < segment.end)] = 1.0
    for curve in design.curves:
        theirs[(stations >= curve.start) & (stations < curve.end)] = 1.0
    shifts = np.arange(-_FARTHEST, _FARTHEST + 1)
    count = len(stations)
    agree = [
        float(ours[max(s, 0) : count + min(s, 0)] @ theirs[max(-s, 0) : count + min(-s, 0)]) for s in shifts.tolist()
    ]
    return float(shifts[int(np.argmax(agree))] * _GRID) if count > _FARTHEST else 0.0

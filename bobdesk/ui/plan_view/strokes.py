"""Lines of many points on the screen: only what is in view, and not more points than pixels."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QLineF, QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from bobdesk.arrays import BoolArray, FloatArray
from bobdesk.ui.plan_view.space import Frame

_MARGIN = 24.0
_FINEST = 0.8
_MANY = 100
_OPAQUE = 255


def pen(colour: str, width: float, style: Qt.PenStyle = Qt.PenStyle.SolidLine, *, alpha: int = 255) -> QPen:
    """Return a pen with round joins."""
    shade = QColor(colour)
    shade.setAlpha(alpha)
    made = QPen(shade, width, style)
    made.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    if style == Qt.PenStyle.SolidLine:
        made.setCapStyle(Qt.PenCapStyle.RoundCap)
    return made


def polygon(points: FloatArray) -> QPolygonF:
    """Return points (n, 2) as Qt draws them."""
    return QPolygonF(list(map(QPointF, points[:, 0].tolist(), points[:, 1].tolist())))


def draw_line(painter: QPainter, screen: FloatArray, frame: Frame) -> None:
    """Draw the line through `screen` (n, 2), screen pixels, with the painter's pen.

    Qt takes twice as long for one stroke of thousands of points as for as many single edges. Their square ends
    overlap, so that no corner gapes; the difference is not seen where points are that close.
    """
    whole = painter.pen()
    is_plain = whole.style() == Qt.PenStyle.SolidLine and whole.color().alpha() == _OPAQUE
    for first, last in visible_runs(screen, frame):
        points = thinned(screen[first : last + 1])
        if not is_plain or len(points) <= _MANY:
            painter.drawPolyline(polygon(points))
            continue
        quick = QPen(whole)
        quick.setCapStyle(Qt.PenCapStyle.SquareCap)
        painter.setPen(quick)
        painter.drawLines([QLineF(*edge) for edge in np.hstack([points[:-1], points[1:]]).tolist()])
        painter.setPen(whole)


def visible_runs(screen: FloatArray, frame: Frame) -> list[tuple[int, int]]:
    """Return first and last vertex of each stretch of the line whose edges may be in view."""
    if len(screen) < 2:
        return []
    low, high = np.minimum(screen[:-1], screen[1:]), np.maximum(screen[:-1], screen[1:])
    seen = (high > -_MARGIN).all(axis=1) & (low < [frame.width + _MARGIN, frame.height + _MARGIN]).all(axis=1)
    return runs(np.asarray(seen))


def runs(flags: BoolArray) -> list[tuple[int, int]]:
    """Return first and last vertex of each unbroken row of flagged edges."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(np.int8)))
    return [(int(first), int(last)) for first, last in zip(edges[::2], edges[1::2], strict=True)]


def thinned(screen: FloatArray, finest: float = _FINEST) -> FloatArray:
    """Return the line without vertices that follow the one before within less than a pixel."""
    if len(screen) < 3:
        return screen
    steps = np.hypot(np.diff(screen[:, 0]), np.diff(screen[:, 1]))
    bins = np.floor(np.cumsum(steps) / finest)
    keep = np.concatenate([[True], np.diff(bins, prepend=0.0) > 0])
    keep[-1] = True
    kept: FloatArray = screen[keep]
    return kept

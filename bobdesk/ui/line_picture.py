"""A small picture of a line: in a card, in a dialog."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from bobdesk.arrays import FloatArray

MOST_POINTS = 200


def thinned(points: FloatArray, most: int = MOST_POINTS) -> FloatArray:
    """Return at most `most` of the points (n, 2), ends included."""
    count = min(len(points), most)
    chosen: FloatArray = points[np.linspace(0, len(points) - 1, count).round().astype(np.int64)]
    return chosen


def paint_line(painter: QPainter, place: QRectF, points: FloatArray, colour: str, width: float = 2.0) -> None:
    """Draw a line as large as fits, its shape kept.

    Parameters
    ----------
    points : (n, 2)
        Any unit, y up; nothing is drawn for fewer than two.
    """
    if len(points) < 2 or not np.isfinite(points).all():
        return
    low, high = points.min(axis=0), points.max(axis=0)
    size = high - low
    factor = min(
        (
            side / extent
            for side, extent in zip((place.width(), place.height()), size.tolist(), strict=True)
            if extent > 0
        ),
        default=0.0,
    )
    shown = (points - (low + high) / 2) * (factor, -factor)
    centre = place.center()
    polygon = QPolygonF([QPointF(centre.x() + x, centre.y() + y) for x, y in shown.tolist()])
    pen = QPen(QColor(colour), width, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.RoundJoin)
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(pen)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawPolyline(polygon)
    painter.restore()

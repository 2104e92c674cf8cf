"""Draws lines in space from back to front."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QLinearGradient, QPainter, QPen

from bobdesk.arrays import BoolArray, FloatArray, IntArray
from bobdesk.ui.theme import colours
from bobdesk.ui.view3d.camera import Camera
from bobdesk.ui.view3d.colouring import STEPS, Colouring, shades

_DROP_LINES = 90
_GROUND_EDGES = 240
_OVERLAY_EDGES = 500
_MOST_EDGES = 3000


@dataclass(frozen=True, eq=False)
class Thread:
    """A thin line beside the first one: another run, or the actual track; points (n, 3), m."""

    points: FloatArray
    colour: str
    style: Qt.PenStyle = Qt.PenStyle.SolidLine


@dataclass(frozen=True, eq=False)
class Scene:
    """What is drawn.

    Attributes
    ----------
    points : (n, 3)
        Of the line, m.
    colouring
        A value for each of them.
    is_curve, is_selected : (n,)
        Rows of curves are drawn thicker, selected ones with an edge.
    threads
        Thin lines.
    has_drop_lines
        Whether verticals down to the lowest level are drawn, and the plan there.
    start, finish, low, high, title
        Words at the ends of the line and of the colours, and of the figure.
    cursor
        A place on the line, x y z, that is marked.
    """

    points: FloatArray
    colouring: Colouring
    is_curve: BoolArray
    is_selected: BoolArray
    threads: tuple[Thread, ...] = ()
    has_drop_lines: bool = True
    start: str = ""
    finish: str = ""
    low: str = ""
    high: str = ""
    title: str = ""
    cursor: FloatArray | None = None
    floor: float = field(default=0.0)


def draw(painter: QPainter, scene: Scene, camera: Camera, area: QRectF, *, legend_bottom: float = 0.0) -> None:
    """Draw a scene into a rectangle that begins at 0, 0.

    Parameters
    ----------
    legend_bottom
        Room to be left free below the legend, pixels.
    """
    of = colours()
    background = QLinearGradient(area.topLeft(), area.bottomLeft())
    background.setColorAt(0.0, QColor(of.base))
    background.setColorAt(1.0, QColor(of.canvas))
    painter.fillRect(area, background)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    _draw_pieces(painter, scene, camera, area)
    _draw_marks(painter, scene, camera, area)
    _draw_legend(painter, scene, area, legend_bottom)


def _draw_pieces(painter: QPainter, scene: Scene, camera: Camera, area: QRectF) -> None:
    """Draw every edge, the farthest first; neighbours with the same pen go to the painter in one call."""
    pens, pieces, depths, kinds = _pieces(scene, camera, area)
    order = np.argsort(-depths, kind="stable")
    kinds = kinds[order]
    pieces = pieces[order]
    edges = np.flatnonzero(np.diff(kinds, prepend=-1))
    ends = np.append(edges[1:], len(kinds))
    rows = pieces.tolist()
    for first, last in zip(edges.tolist(), ends.tolist(), strict=True):
        painter.setPen(pens[int(kinds[first])])
        painter.drawLines([QLineF(*rows[index]) for index in range(first, last)])


def _pieces(scene: Scene, camera: Camera, area: QRectF) -> tuple[list[QPen], FloatArray, FloatArray, IntArray]:
    """Return pens, edges in pixels (m, 4), their depths and the pen of each."""
    of = colours()
    pens: list[QPen] = []
    parts: list[FloatArray] = []
    depths: list[FloatArray] = []
    kinds: list[IntArray] = []

    def add(points: FloatArray, kind: IntArray | int, *, joined: bool = True, nearer: float = 0.0) -> None:
        places, away = camera.seen(points, area.width(), area.height())
        if joined:
            pieces, depth = np.hstack([places[:-1], places[1:]]), 0.5 * (away[:-1] + away[1:])
        else:
            pieces, depth = np.hstack([places[0::2], places[1::2]]), np.maximum(away[0::2], away[1::2])
        parts.append(pieces)
        depths.append(depth - nearer)
        kinds.append(np.full(len(pieces), kind, dtype=np.int64) if isinstance(kind, int) else kind)

    points = scene.points
    if scene.has_drop_lines:
        pens += [_pen(of.grid, 1.0), _pen(of.muted, 1.0, Qt.PenStyle.DashLine)]
        few = points[_thin(len(points), _DROP_LINES)]
        feet = few.copy()
        feet[:, 2] = scene.floor
        add(np.stack([few, feet], axis=1).reshape(-1, 3), 0, joined=False)
        ground = points[_thin(len(points), _GROUND_EDGES)].copy()
        ground[:, 2] = scene.floor
        # Every second piece is left out: dashes that a pen would draw anew at each edge.
        pairs = np.stack([ground[:-1], ground[1:]], axis=1)[::2].reshape(-1, 3)
        pens[1].setStyle(Qt.PenStyle.SolidLine)
        add(pairs, 1, joined=False)
    for thread in scene.threads:
        pens.append(_pen(thread.colour, 1.6, thread.style))
        add(thread.points[_thin(len(thread.points), _OVERLAY_EDGES)], len(pens) - 1)
    rows = _thin(len(points), _MOST_EDGES)
    levels = scene.colouring.levels[rows][:-1]
    curve, chosen = scene.is_curve[rows][:-1], scene.is_selected[rows][:-1]
    first = len(pens)
    palette = shades(two_sided=scene.colouring.is_two_sided)
    for width in (3.0, 5.5):
        pens += [_pen(colour, width) for colour in palette]
    if chosen.any():
        pens.append(_pen(of.text, 9.0))
        places = points[rows]
        pairs = np.stack([places[:-1], places[1:]], axis=1)[chosen].reshape(-1, 3)
        add(pairs, len(pens) - 1, joined=False)
    add(points[rows], first + levels + STEPS * curve.astype(np.int64), nearer=1e-3)
    return pens, np.concatenate(parts), np.concatenate(depths), np.concatenate(kinds)


def _draw_marks(painter: QPainter, scene: Scene, camera: Camera, area: QRectF) -> None:
    of = colours()
    ends = scene.points[[0, -1]]
    places, _ = camera.seen(ends, area.width(), area.height())
    metrics = QFontMetricsF(painter.font())
    for (x, y), text, colour, is_round in zip(
        places.tolist(), (scene.start, scene.finish), (of.start, of.finish), (True, False), strict=True
    ):
        painter.setPen(QPen(QColor(of.base), 1.5))
        painter.setBrush(QColor(colour))
        box = QRectF(x - 6, y - 6, 12, 12)
        if is_round:
            painter.drawEllipse(box)
        else:
            painter.drawRect(box)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        wide = metrics.horizontalAdvance(text)
        left = min(max(x + 10, area.left() + 4), area.right() - wide - 4)
        painter.setPen(QColor(of.text))
        painter.drawText(QPointF(left, max(y - 10, metrics.ascent() + 4)), text)
    if scene.cursor is not None:
        (x, y), *_ = camera.seen(scene.cursor.reshape(1, 3), area.width(), area.height())[0].tolist()
        painter.setPen(QPen(QColor(of.text), 2.0))
        painter.setBrush(QColor(of.base))
        painter.drawEllipse(QPointF(x, y), 6.0, 6.0)
        painter.setBrush(Qt.BrushStyle.NoBrush)


def _draw_legend(painter: QPainter, scene: Scene, area: QRectF, bottom: float) -> None:
    of = colours()
    metrics = QFontMetricsF(painter.font())
    wide = min(190.0, 0.35 * area.width())
    left, top = area.right() - wide - 16, area.bottom() - bottom - metrics.height() - 26
    ramp = QLinearGradient(left, 0, left + wide, 0)
    palette = shades(two_sided=scene.colouring.is_two_sided)
    for level in range(0, STEPS, 3):
        ramp.setColorAt(level / (STEPS - 1), palette[level])
    ramp.setColorAt(1.0, palette[-1])
    painter.fillRect(QRectF(left, top, wide, 9), ramp)
    painter.setPen(QColor(of.text))
    painter.drawText(QPointF(left, top - 6), scene.title)
    below = top + 11 + metrics.ascent()
    painter.drawText(QPointF(left, below), scene.low)
    painter.drawText(QPointF(left + wide - metrics.horizontalAdvance(scene.high), below), scene.high)


def _pen(colour: QColor | str, width: float, style: Qt.PenStyle = Qt.PenStyle.SolidLine) -> QPen:
    pen = QPen(QColor(colour), width, style, Qt.PenCapStyle.RoundCap)
    pen.setCosmetic(True)
    return pen


def _thin(count: int, most: int) -> IntArray:
    """Return the indices of at most `most` rows, with both ends."""
    if count <= most:
        return np.arange(count)
    return np.linspace(0, count - 1, most).round().astype(np.int64)


def with_floor(scene: Scene) -> FloatArray:
    """Return the points of the line and their feet: what is to be in sight."""
    if not scene.has_drop_lines:
        return scene.points
    feet = scene.points.copy()
    feet[:, 2] = scene.floor
    both: FloatArray = np.concatenate([scene.points, feet])
    return both

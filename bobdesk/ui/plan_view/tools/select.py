"""Select and move vertices: by clicks, a rubber band, drags; new ones from the middle of an edge."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from bobdesk.arrays import FloatArray
from bobdesk.ui.plan_view.layers.trace import handles_shown
from bobdesk.ui.plan_view.near import distances_along, nearest_on_line, nearest_vertex
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import pen
from bobdesk.ui.plan_view.tools.tool import Pointer, Tool
from bobdesk.ui.theme import colours

# A press that moves less than this is a click, screen pixels.
_A_DRAG = 4.0
# Edges shorter than this on the screen have no ghost in their middle.
_GHOST_FROM = 28.0
# Where vertices are too close for handles, a drag bends the line over this length to both sides, screen pixels.
_BEND = 60.0


@dataclass
class _Grip:
    """What the button holds: vertices at `indices`, a new one behind `indices[0]`, or a rubber band."""

    kind: Literal["vertices", "new", "band"]
    pressed: Pointer
    indices: tuple[int, ...] = ()
    weights: FloatArray | None = None
    now: Pointer | None = None

    @property
    def has_moved(self) -> bool:
        if self.now is None:
            return False
        way = self.now.screen - self.pressed.screen
        return float(np.hypot(way.x(), way.y())) >= _A_DRAG

    @property
    def shift(self) -> FloatArray:
        now = self.now or self.pressed
        return np.subtract(now.plan, self.pressed.plan)


class SelectTool(Tool):
    """The tool for correcting a line."""

    name = "select"
    cursor = Qt.CursorShape.ArrowCursor
    places_points = False

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)  # type: ignore[arg-type]
        self._grip: _Grip | None = None
        self._ghost: int | None = None
        self._hot: int | None = None
        self._is_dense = False

    @property
    def is_dragging(self) -> bool:
        """Whether vertices follow the mouse."""
        return self._grip is not None and self._grip.kind != "band" and self._grip.has_moved

    def start(self) -> None:
        """Say what can be done."""
        self._say()

    def stop(self) -> None:
        """Drop a drag."""
        self.reset()

    def refresh(self) -> None:
        """Drop a drag of vertices that may be gone; say what can be done now."""
        self._grip = None
        self._say()

    def reset(self) -> None:
        """Hold nothing."""
        self._grip, self._ghost, self._hot = None, None, None
        self.repaint.emit()

    def press(self, pointer: Pointer) -> None:
        """Take hold of a vertex, of an edge's middle, or begin a rubber band."""
        if pointer.button != Qt.MouseButton.LeftButton:
            return
        points = self._points()
        self._grip = _Grip("band", pointer)
        if points is None:
            return
        if self._ghost is not None and self._ghost < len(points) - 1:
            self._grip = _Grip("new", pointer, (self._ghost,))
            return
        index, away = nearest_vertex(points, pointer.plan)
        if away > pointer.reach:
            return
        self._pick(index, pointer)
        if index in self.desk.selection.vertices:
            self._grip = self._hold(points, index, pointer)

    def move(self, pointer: Pointer) -> None:
        """Drag, or show what a press would take hold of."""
        if self._grip is None:
            self._hover(pointer)
            return
        self._grip.now = pointer
        self.repaint.emit()

    def leave(self) -> None:
        """Show no ghost."""
        if self._grip is None:
            self._ghost, self._hot = None, None
            self.repaint.emit()

    def release(self, pointer: Pointer) -> None:
        """Do what was previewed, as one step."""
        if pointer.button != Qt.MouseButton.LeftButton or self._grip is None:
            return
        self._grip.now = pointer
        grip, self._grip = self._grip, None
        if grip.kind == "band":
            self._select_in(grip)
        elif grip.kind == "new":
            self._insert(grip)
        elif grip.has_moved:
            self._move(grip)
        elif not (pointer.holds(Qt.KeyboardModifier.ShiftModifier) or pointer.holds(_CONTROL)):
            self.desk.selection.vertices = (self._nearest(grip.pressed),)
        self._hover(pointer)
        self.repaint.emit()

    def double_click(self, pointer: Pointer) -> None:
        """Put a new vertex on the line."""
        points = self._points()
        if points is None or len(points) < 2:
            return
        place = nearest_on_line(points, pointer.plan)
        if place.away <= pointer.reach and nearest_vertex(points, pointer.plan)[1] > pointer.reach:
            self._grip = None
            self._put_in(place.edge, place.place)

    def cancel(self) -> bool:
        """Drop a drag, or else select nothing."""
        if self._grip is not None:
            self.reset()
            return True
        if self.desk.selection.vertices:
            self.desk.selection.vertices = ()
            return True
        return False

    def let_go(self) -> None:
        """Drop a drag, one that has hardly begun too."""
        if self._grip is not None:
            self.reset()

    def preview_points(self) -> FloatArray | None:
        """Return the vertices as the drag would leave them."""
        points = self._points()
        if points is None or self._grip is None or not self._grip.has_moved or self._grip.kind == "band":
            return None
        if self._grip.kind == "new":
            now = self._grip.now or self._grip.pressed
            return np.insert(points, self._grip.indices[0] + 1, now.plan, axis=0)
        moved = points.copy()
        moved[list(self._grip.indices)] = self._moved(points, self._grip)
        return moved

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """Draw rubber band, ghost and the vertex under the mouse."""
        of = colours()
        grip = self._grip
        if grip is not None and grip.kind == "band" and grip.has_moved and grip.now is not None:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
            painter.setPen(pen(of.accent, 1.0, Qt.PenStyle.DashLine))
            shade = QColor(of.accent)
            shade.setAlpha(28)
            painter.setBrush(shade)
            painter.drawRect(QRectF(frame.point(grip.pressed.plan), grip.now.screen).normalized())
            return
        points = self._points()
        if points is None or grip is not None:
            return
        if self._ghost is not None and self._ghost < len(points) - 1:
            middle = 0.5 * (points[self._ghost] + points[self._ghost + 1])
            at = frame.point((float(middle[0]), float(middle[1])))
            shade = QColor(of.vertex)
            shade.setAlpha(200)
            painter.setBrush(shade)
            painter.setPen(pen(of.trace, 1.2, Qt.PenStyle.DotLine))
            painter.drawEllipse(at, 4.5, 4.5)
            painter.setPen(pen(of.trace, 1.2))
            painter.drawLine(at - QPointF(2, 0), at + QPointF(2, 0))
            painter.drawLine(at - QPointF(0, 2), at + QPointF(0, 2))
        elif self._hot is not None and self._hot < len(points):
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(pen(of.trace_doubtful, 2.0))
            x, y = points[self._hot]
            painter.drawEllipse(frame.point((float(x), float(y))), 8.0, 8.0)

    def _points(self) -> FloatArray | None:
        project = self.desk.session.project
        return None if project.source is not None or project.trace is None else project.trace.points

    def _nearest(self, pointer: Pointer) -> int:
        points = self._points()
        return 0 if points is None else nearest_vertex(points, pointer.plan)[0]

    def _pick(self, index: int, pointer: Pointer) -> None:
        chosen = self.desk.selection.vertices
        if pointer.holds(_CONTROL):
            self.desk.selection.vertices = tuple(set(chosen) ^ {index})
        elif pointer.holds(Qt.KeyboardModifier.ShiftModifier):
            self.desk.selection.vertices = (*chosen, index)
        elif index not in chosen:
            self.desk.selection.vertices = (index,)

    def _hold(self, points: FloatArray, index: int, pointer: Pointer) -> _Grip:
        """Hold what is selected; of a line too dense for handles, a stretch around the vertex."""
        chosen = self.desk.selection.vertices
        dense = not handles_shown(points / pointer.px_per_screen)[index]
        if len(chosen) > 1 or not dense or pointer.holds(Qt.KeyboardModifier.AltModifier):
            return _Grip("vertices", pointer, chosen)
        away = np.abs(distances_along(points) - distances_along(points)[index]) / (_BEND * pointer.px_per_screen)
        taken = np.flatnonzero(away < 1)
        return _Grip("vertices", pointer, tuple(taken.tolist()), 0.5 + 0.5 * np.cos(np.pi * away[taken]))

    def _moved(self, points: FloatArray, grip: _Grip) -> FloatArray:
        shift = grip.shift if grip.weights is None else grip.weights[:, None] * grip.shift
        moved: FloatArray = points[list(grip.indices)] + shift
        return moved

    def _hover(self, pointer: Pointer) -> None:
        points = self._points()
        ghost = hot = None
        if points is not None and len(points) > 1:
            index, away = nearest_vertex(points, pointer.plan)
            if away <= pointer.reach:
                hot = index
                self._is_dense = not handles_shown(points / pointer.px_per_screen)[index]
            middles = 0.5 * (points[:-1] + points[1:])
            edge, from_middle = nearest_vertex(middles, pointer.plan)
            long_enough = np.hypot(*(points[edge + 1] - points[edge])) >= _GHOST_FROM * pointer.px_per_screen
            if long_enough and from_middle <= pointer.reach and from_middle < away:
                ghost, hot = edge, None
        if (ghost, hot) != (self._ghost, self._hot):
            self._ghost, self._hot = ghost, hot
            self._say()
            self.repaint.emit()

    def _say(self) -> None:
        project = self.desk.session.project
        if project.source is not None:
            self.say(self.tr("Coordinates from a file are not edited here; set start and finish, or measure."))
        elif project.trace is None:
            self.say(self.tr("Draw or trace the line first; then its vertices are selected and moved here."))
        elif self._ghost is not None:
            self.say(self.tr("Drag to insert a vertex here."))
        elif self._hot is not None and self._is_dense:
            self.say(self.tr("Drag to bend the line here; with Alt one vertex moves; Delete removes; arrows nudge."))
        elif self._hot is not None:
            self.say(self.tr("Drag to move; Shift adds to the selection, Ctrl toggles; Delete removes; arrows nudge."))
        else:
            self.say(self.tr("Click or drag a frame to select vertices; double-click the line to insert one."))

    def _select_in(self, grip: _Grip) -> None:
        points = self._points()
        now = grip.now or grip.pressed
        found: tuple[int, ...] = ()
        if points is not None and grip.has_moved:
            low, high = np.minimum(grip.pressed.plan, now.plan), np.maximum(grip.pressed.plan, now.plan)
            found = tuple(np.flatnonzero(((points >= low) & (points <= high)).all(axis=1)).tolist())
        chosen = self.desk.selection.vertices
        if now.holds(_CONTROL):
            found = tuple(set(chosen) ^ set(found))
        elif now.holds(Qt.KeyboardModifier.ShiftModifier):
            found = (*chosen, *found)
        self.desk.selection.vertices = found

    def _insert(self, grip: _Grip) -> None:
        points = self._points()
        if points is None:
            return
        now = grip.now or grip.pressed
        middle = 0.5 * (points[grip.indices[0]] + points[grip.indices[0] + 1])
        place = now.plan if grip.has_moved else (float(middle[0]), float(middle[1]))
        self._put_in(grip.indices[0], place)

    def _put_in(self, after: int, place: tuple[float, float]) -> None:
        from bobdesk.project import edits

        if self.desk.session.apply(
            self.tr("Insert vertex"), lambda before: edits.insert_vertex(before, after, place[0], place[1])
        ):
            self.desk.selection.vertices = (after + 1,)

    def _move(self, grip: _Grip) -> None:
        from bobdesk.project import edits

        points = self._points()
        if points is None:
            return
        to = self._moved(points, grip)
        if grip.weights is not None:
            label = self.tr("Bend line")
        else:
            label = self.tr("Move vertex") if len(grip.indices) == 1 else self.tr("Move vertices")
        self.desk.session.apply(label, lambda before: edits.move_vertices(before, grip.indices, to))


_CONTROL = Qt.KeyboardModifier.ControlModifier

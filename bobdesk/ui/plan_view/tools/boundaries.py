"""Correct segments on the plan: drag boundaries along the line, select segments, split by a double click."""

from __future__ import annotations

import math

import numpy as np
from PySide6.QtCore import QObject, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QKeyEvent, QPainter

from bobdesk.alignment.segments import segment_at
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.follow import Follower
from bobdesk.ui.plan_view.line_on_plan import LineOnPlan
from bobdesk.ui.plan_view.nudge import is_arrow
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import pen
from bobdesk.ui.plan_view.tools.tool import Pointer, Tool
from bobdesk.ui.segments.alignment_now import AlignmentNow, alignment_now
from bobdesk.ui.segments.boundary_drag import BoundaryDrag
from bobdesk.ui.segments.drag_words import DragWords
from bobdesk.ui.segments.operations import SegmentOperations, operations
from bobdesk.ui.theme import colours

_A_DRAG = 4.0
_SNAP = 8.0
_ARROWS = {
    Qt.Key.Key_Left: (-1.0, 0.0),
    Qt.Key.Key_Right: (1.0, 0.0),
    Qt.Key.Key_Up: (0.0, -1.0),
    Qt.Key.Key_Down: (0.0, 1.0),
}


class BoundariesTool(Tool):
    """The tool of the segments' step."""

    name = "boundaries"
    cursor = Qt.CursorShape.ArrowCursor
    places_points = False

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(desk, parent)
        self._pressed: Pointer | None = None
        self._follower: Follower | None = None
        self._is_moving = False
        self._hot: int | None = None
        self._frame: Frame | None = None
        self._ready = False

    @property
    def is_dragging(self) -> bool:
        """Whether a boundary follows the mouse."""
        return self._is_moving

    def start(self) -> None:
        """Say what can be done."""
        self._prepare()
        self._say()

    def stop(self) -> None:
        """Drop a drag."""
        self.reset()

    def refresh(self) -> None:
        """Say what can be done now."""
        self._say()

    def reset(self) -> None:
        """Hold nothing."""
        self._pressed, self._is_moving, self._hot = None, False, None
        if self._ready:
            self._drag.cancel()
        self.repaint.emit()

    def press(self, pointer: Pointer) -> None:
        """Take hold of a boundary, or select a segment."""
        if pointer.button != Qt.MouseButton.LeftButton or not self._prepare():
            return
        boundary = self._boundary_at(pointer)
        if boundary is not None:
            if self._drag.hold(boundary):
                self._pressed, self._is_moving = pointer, False
                self._follower = self._line.follower(
                    self.desk.session.project, self._drag.station, pointer, between=self._between(boundary)
                )
            return
        found = self._line.nearest(self.desk.session.project, pointer.plan)
        if found is None:
            self.desk.notices.refuse(self._now.problem or self.tr("There are no segments yet: a line comes first"))
        elif found[1] <= 2 * pointer.reach:
            index = segment_at(self._now.segments, found[0])
            self._operations.select(index, station=found[0], add=pointer.holds(Qt.KeyboardModifier.ShiftModifier))
        else:
            self._operations.select_nothing()

    def move(self, pointer: Pointer) -> None:
        """Let the boundary follow along the line; Alt moves it freely."""
        if not self._prepare():
            return
        if self._pressed is None or self._drag.boundary is None:
            self._hover(pointer)
            return
        way = pointer.screen - self._pressed.screen
        self._is_moving = self._is_moving or math.hypot(way.x(), way.y()) >= _A_DRAG
        if not self._is_moving:
            return
        if self._follower is not None:
            free = pointer.holds(Qt.KeyboardModifier.AltModifier)
            per_screen = pointer.px_per_screen * self._line.metres_per_unit(self.desk.session.project)
            self._drag.drag(self._follower.to(pointer.plan), snap=0.0 if free else _SNAP * per_screen)
        self.repaint.emit()

    def leave(self) -> None:
        """Show no handle under a mouse that is elsewhere."""
        if self._hot is not None:
            self._hot = None
            self.repaint.emit()

    def release(self, pointer: Pointer) -> None:
        """Keep the boundary where it is: one step of undo."""
        if pointer.button != Qt.MouseButton.LeftButton or self._pressed is None:
            return
        moved, self._pressed, self._is_moving = self._is_moving, None, False
        if moved:
            self._drag.drop()
        else:
            self._drag.cancel()
        self._say()
        self.repaint.emit()

    def double_click(self, pointer: Pointer) -> None:
        """Split the segment here."""
        if not self._prepare() or self._boundary_at(pointer) is not None:
            return
        found = self._line.nearest(self.desk.session.project, pointer.plan)
        if found is not None and found[1] <= 2 * pointer.reach:
            self.desk.selection.station = found[0]
            self._operations.split()

    def takes_key(self, event: QKeyEvent) -> bool:
        """Return whether a key moves the selected boundary."""
        return is_arrow(event) and self.desk.selection.boundary is not None

    def key(self, event: QKeyEvent) -> bool:
        """Move the selected boundary by an arrow: a screen pixel, ten with Shift, a tenth with Ctrl."""
        boundary = self.desk.selection.boundary
        if not is_arrow(event) or boundary is None or self._frame is None or not self._prepare():
            return False
        project = self.desk.session.project
        line = self._line.on_screen(project, self._frame)
        if line is None or boundary >= len(self._now.segments) - 1:
            return False
        station = self._now.segments[boundary].end
        by = self._frame.per_screen * self._line.metres_per_unit(project)
        way = np.diff(line.at(np.array([station - 3 * by, station + 3 * by])), axis=0)[0]
        arrow = np.array(_ARROWS[Qt.Key(event.key())])
        along = float(arrow @ way)
        # An arrow across the line still moves: right and down lead on.
        forward = along > 0 if abs(along) > 0.2 * float(np.hypot(*way)) else arrow.sum() > 0
        if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            by *= 10
        elif event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            by *= 0.1
        return self._operations.nudge(by if forward else -by)

    def delete(self) -> bool:
        """Take the selected boundary away."""
        if self.desk.selection.boundary is None or not self._prepare():
            return False
        self._operations.delete_boundary()
        return True

    def cancel(self) -> bool:
        """Put the boundary back, or else select nothing."""
        self._prepare()
        if self._drag.cancel():
            self._pressed, self._is_moving = None, False
            self.repaint.emit()
            return True
        return self._operations.select_nothing()

    def let_go(self) -> None:
        """Drop a drag, one that has hardly begun too."""
        if self._pressed is not None:
            self.reset()

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """Mark the boundary under the mouse; beside one that is dragged, write its figures."""
        self._frame = frame
        if not self._ready:
            return
        line = self._line.on_screen(self.desk.session.project, frame)
        if line is None:
            return
        if self._is_moving and self._drag.boundary is not None:
            self._draw_figures(painter, frame, QPointF(*line.at(np.array([self._drag.station]))[0].tolist()))
        elif self._hot is not None and self._hot < len(self._now.segments) - 1:
            at = line.at(np.array([self._now.segments[self._hot].end]))[0]
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(pen(colours().accent, 2.0))
            painter.drawEllipse(QPointF(*at.tolist()), 9.0, 9.0)

    def _prepare(self) -> bool:
        """Begin to follow the segments when the tool is first used, so that an empty window loads nothing."""
        if not self._ready:
            self._now: AlignmentNow = alignment_now(self.desk)
            self._operations: SegmentOperations = operations(self.desk)
            self._drag = BoundaryDrag(self.desk, self)
            self._words = DragWords(self.desk, self)
            self._line = LineOnPlan(self._now)
            self._now.changed.connect(self._on_now)
            self._ready = True
        return True

    def _on_now(self) -> None:
        if self._hot is not None or self._is_moving:
            self.repaint.emit()

    def _between(self, boundary: int) -> tuple[float, float]:
        segments = self._now.segments
        return segments[boundary].start, segments[boundary + 1].end

    def _boundary_at(self, pointer: Pointer) -> int | None:
        points, value = self._line.points(self.desk.session.project), self._now.value
        if value is None or not len(points) or len(value.segments) < 2:
            return None
        ends = np.array([segment.end for segment in value.segments[:-1]])
        stations = value.line.stations
        places = np.column_stack([np.interp(ends, stations, points[:, axis]) for axis in (0, 1)])
        away = np.hypot(*(places - pointer.plan).T)
        nearest = int(away.argmin())
        return nearest if away[nearest] <= pointer.reach else None

    def _hover(self, pointer: Pointer) -> None:
        hot = self._boundary_at(pointer)
        if hot != self._hot:
            self._hot = hot
            self._say()
            self.repaint.emit()

    def _say(self) -> None:
        if self._hot is not None:
            self.say(self.tr("Drag the boundary along the line; Alt moves it freely; arrows nudge it; Del merges."))
        else:
            self.say(
                self.tr("Click a segment to select it, drag a boundary, double-click to split; X, C, O, L act on it.")
            )

    def _draw_figures(self, painter: QPainter, frame: Frame, at: QPointF) -> None:
        lines = self._words.lines(self._drag)
        metrics = painter.fontMetrics()
        width = max(metrics.horizontalAdvance(line) for line in lines) + 16.0
        height = len(lines) * metrics.height() + 8.0
        left = at.x() + 16 if at.x() + 16 + width < frame.width else at.x() - 16 - width
        top = min(max(at.y() - height - 10, 4.0), frame.height - height - 4)
        box = QRectF(left, top, width, height)
        of = colours()
        shade = QColor(of.base)
        shade.setAlpha(240)
        painter.setPen(pen(of.border, 1.0))
        painter.setBrush(shade)
        painter.drawRoundedRect(box, 4, 4)
        painter.setPen(QColor(of.text))
        there = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop
        painter.drawText(box.adjusted(8, 4, -8, -4), int(there), "\n".join(lines))

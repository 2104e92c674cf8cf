"""What drawing and following have in common: a line is placed click by click and ends in one edit."""

from __future__ import annotations

import math

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QKeyEvent, QPainter

from bobdesk.arrays import FloatArray, frozen
from bobdesk.plan.traced_line import Trace
from bobdesk.ui.notices import Remedy
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import draw_line, pen
from bobdesk.ui.plan_view.tools.line_in_progress import LineInProgress, clicked
from bobdesk.ui.plan_view.tools.tool import Pointer, Tool
from bobdesk.ui.theme import colours

_ENDS = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
_SAME_CLICK = 1.5


class LineTool(Tool):
    """Places a line; a subclass says what one click adds, and what becomes of the whole."""

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)  # type: ignore[arg-type]
        self.line = LineInProgress()
        self._cursor: Pointer | None = None
        self._rests = False

    def start(self) -> None:
        """Say what to do."""
        self._rests = False
        self._say()

    def stop(self) -> None:
        """End a line that can be ended; another one is kept until the tool is taken again."""
        self._cursor = None
        if self.line.is_empty:
            return
        if self._can_commit():
            self.finish()
        elif self.line.pieces:
            self.desk.notices.note(self.tr("The line that you began is kept; take the tool again to go on with it"))

    def refresh(self) -> None:
        """Say what can be done now."""
        self._say()

    def reset(self) -> None:
        """Forget the line."""
        self.line.clear()
        self._cursor, self._rests = None, False
        self.repaint.emit()

    def press(self, pointer: Pointer) -> None:
        """Place the next piece, or take up an end of the line that there is."""
        if pointer.button != Qt.MouseButton.LeftButton or not self._is_usable():
            return
        self._rests = False
        self._cursor = pointer
        if self.line.is_empty and self._take_up(pointer):
            self._say()
            self.repaint.emit()
            return
        last, first = self.line.last, self.line.first
        if last is not None and math.dist(last, pointer.plan) <= _SAME_CLICK * pointer.px_per_screen:
            return
        other = self._other_end()
        if other is not None and math.dist(other, pointer.plan) <= pointer.reach:
            self._place(pointer, other)
            self.finish()
        elif len(self.line.points) >= 3 and first is not None and math.dist(first, pointer.plan) <= pointer.reach:
            self._place(pointer, first)
            self.finish()
        else:
            self._place(pointer, pointer.plan)
        self._say()
        self.repaint.emit()

    def move(self, pointer: Pointer) -> None:
        """Let the next piece follow the mouse."""
        self._cursor = pointer
        self.repaint.emit()

    def leave(self) -> None:
        """Show no next piece while the mouse is elsewhere."""
        self._cursor = None
        self.repaint.emit()

    def double_click(self, pointer: Pointer) -> None:
        """End the line; the first press has placed its last point."""
        if pointer.button == Qt.MouseButton.LeftButton and self.line.pieces:
            self.finish()

    def takes_key(self, event: QKeyEvent) -> bool:
        """Return whether the key ends the line or takes a click back."""
        return not self.line.is_empty and event.key() in (Qt.Key.Key_Backspace, *_ENDS)

    def key(self, event: QKeyEvent) -> bool:
        """Take the keys that end the line or take a click back."""
        if event.key() == Qt.Key.Key_Backspace:
            return self.take_back()
        if event.key() in _ENDS and not self.line.is_empty:
            self.finish()
            return True
        return False

    def cancel(self) -> bool:
        """Drop the piece that follows the mouse; what was placed stays."""
        if self.line.is_empty or self._rests:
            return False
        self._rests = True
        self._say()
        self.repaint.emit()
        return True

    def take_back(self) -> bool:
        """Take the last click back."""
        if self.line.is_empty:
            return False
        self.line.take_back()
        self._rests = False
        self._say()
        self.repaint.emit()
        return True

    def finish(self) -> None:
        """Make one edit of what was placed; where that would replace a line, ask first."""
        self._let_go_of_lost_end()
        if self.line.continues is not None:
            if self.line.pieces:
                self._continue()
            else:
                self.reset()
        elif len(self.line.points) < 2:
            self.desk.notices.refuse(self.tr("A line needs at least two points; click on, or take the point back"))
        elif self._can_commit():
            self._commit(self.tr("Draw line"))
        else:
            self._ask()
        self._say()
        self.repaint.emit()

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """Draw what is placed, and the piece that follows the mouse."""
        placed = self.line.with_origin()
        of = colours()
        if len(placed):
            screen = frame.to_screen(placed)
            painter.setPen(pen(of.preview, 2.4))
            draw_line(painter, screen, frame)
        following = None if self._rests or self._cursor is None else self._following(self._cursor)
        if following is not None:
            painter.setPen(pen(of.preview, 1.6, Qt.PenStyle.DashLine))
            draw_line(painter, frame.to_screen(following), frame)
        painter.setPen(pen(of.preview, 1.4))
        painter.setBrush(QColor(of.vertex))
        for piece in self.line.pieces:
            x, y = piece.points[-1]
            painter.drawEllipse(frame.point((float(x), float(y))), 3.5, 3.5)
        if self.line.pieces and len(self.line.pieces[0].points) > 1:
            x, y = self.line.pieces[0].points[0]
            painter.drawEllipse(frame.point((float(x), float(y))), 3.5, 3.5)
        self._paint_ends(painter, frame)

    def _paint_ends(self, painter: QPainter, frame: Frame) -> None:
        """Ring the end under the mouse that a click would take up or join to."""
        if self._cursor is None:
            return
        ends = self._ends() if self.line.is_empty else [end for end in (self._other_end(),) if end is not None]
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(pen(colours().preview, 2.0))
        for end in ends:
            if math.dist(end, self._cursor.plan) <= self._cursor.reach:
                painter.drawEllipse(frame.point(end), 9.0, 9.0)

    def _following(self, pointer: Pointer) -> FloatArray | None:
        """Return the line (n, 2) from the last point to the mouse."""
        last = self.line.last
        return None if last is None else np.array([last, pointer.plan])

    def _place(self, pointer: Pointer, place: tuple[float, float]) -> None:
        """Add what a click at `place` adds."""
        self.line.pieces.append(clicked(place))

    def _say(self) -> None:
        """Tell what the next click does."""

    def _is_usable(self) -> bool:
        project = self.desk.session.project
        if project.source is not None:
            self.desk.notices.refuse(self.tr("This plan comes from coordinates: its line is not drawn by hand"))
            return False
        if project.picture is None and project.trace is None:
            self.desk.notices.refuse(self.tr("Open a picture of the plan first"))
            return False
        return True

    def _can_commit(self) -> bool:
        """Return whether the line can become the document's without taking another's place."""
        if self.line.continues is not None:
            return bool(self.line.pieces)
        return len(self.line.points) >= 2 and self.desk.session.project.trace is None

    def _ends(self) -> list[tuple[float, float]]:
        trace = self.desk.session.project.trace
        if trace is None or self.desk.session.project.source is not None:
            return []
        return [(float(x), float(y)) for x, y in trace.points[[0, -1]]]

    def _other_end(self) -> tuple[float, float] | None:
        """Return the end of the line that there is, to which a continued one can be closed."""
        ends = self._ends()
        if self.line.continues is None or not self.line.pieces or not ends:
            return None
        return ends[0] if self.line.continues == "end" else ends[1]

    def _let_go_of_lost_end(self) -> None:
        """Make a line of its own of what continued a line that is gone, or ends elsewhere now."""
        origin = self.line.origin
        if origin is None:
            return
        ends = self._ends()
        if not ends or ends[0 if self.line.continues == "start" else 1] != origin:
            self.line.continues, self.line.origin = None, None
            self.line.pieces.insert(0, clicked(origin))

    def _take_up(self, pointer: Pointer) -> bool:
        ends = self._ends()
        near = [index for index, end in enumerate(ends) if math.dist(end, pointer.plan) <= pointer.reach]
        if not near:
            return False
        nearest = min(near, key=lambda index: math.dist(ends[index], pointer.plan))
        self.line.continues = "start" if nearest == 0 else "end"
        self.line.origin = ends[nearest]
        return True

    def _continue(self) -> None:
        from bobdesk.project import edits

        trace = self.desk.session.project.trace
        if trace is None:
            return
        points, sure = self.line.points, self.line.confidence
        at = len(trace.points)
        if self.line.continues == "start":
            points, sure, at = points[::-1], sure[::-1], 0
        if self.desk.session.apply(
            self.tr("Continue line"), lambda before: edits.redraw_stretch(before, at, at, points, sure)
        ):
            self.reset()

    def _commit(self, label: str) -> None:
        from bobdesk.project import edits

        points, sure, width = self.line.points, self.line.confidence, self.line.width
        if width > 0:
            trace = made_trace(points, sure, width)
            done = self.desk.session.apply(label, lambda before: edits.take_trace(before, trace))
        else:
            done = self.desk.session.apply(label, lambda before: edits.draw_line(before, points))
        if done:
            self.reset()

    def _ask(self) -> None:
        self.desk.notices.warn(
            self.tr("There is a line already; the new one waits"),
            Remedy(self.tr("Replace the line"), self._replace),
            Remedy(self.tr("Join to the line"), self._join),
            Remedy(self.tr("Drop the new one"), self._drop),
        )

    def _replace(self) -> None:
        if len(self.line.points) >= 2:
            self._commit(self.tr("Replace line"))

    def _drop(self) -> None:
        self.reset()
        self._say()

    def _join(self) -> None:
        """Close the gap between the two lines, where their ends are nearest to each other."""
        from bobdesk.project import edits

        trace = self.desk.session.project.trace
        if trace is None or len(self.line.points) < 2:
            return
        points, sure = self.line.points, self.line.confidence
        old_start, old_end = trace.points[0], trace.points[-1]
        gaps = {
            (True, False): np.hypot(*(old_end - points[0])),
            (True, True): np.hypot(*(old_end - points[-1])),
            (False, False): np.hypot(*(old_start - points[-1])),
            (False, True): np.hypot(*(old_start - points[0])),
        }
        behind, turned = min(gaps, key=lambda which: float(gaps[which]))
        if turned:
            points, sure = points[::-1], sure[::-1]
        at = len(trace.points) if behind else 0
        if self.desk.session.apply(
            self.tr("Join lines"), lambda before: edits.redraw_stretch(before, at, at, points, sure)
        ):
            self.reset()


def made_trace(points: FloatArray, confidence: FloatArray, width: float) -> Trace:
    """Return the trace of followed and clicked pieces, without points that lie on each other."""
    steps = np.hypot(*np.diff(points, axis=0).T)
    keep = np.concatenate([[True], steps > 1e-6])
    nowhere = np.zeros((0, 2), dtype=np.int64)
    nowhere.flags.writeable = False
    return Trace(frozen(points[keep], columns=2), frozen(confidence[keep]), width, "single", (), nowhere)

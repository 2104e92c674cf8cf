"""Trace both edges of a wide track one after the other; the line goes in the middle."""

from __future__ import annotations

from collections.abc import Generator

import numpy as np
from PySide6.QtCore import QObject
from PySide6.QtGui import QPainter

from bobdesk.arrays import FloatArray
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import draw_line, pen
from bobdesk.ui.plan_view.tools.line_in_progress import LineInProgress, Piece
from bobdesk.ui.plan_view.tools.live_wire import LiveWireTool
from bobdesk.ui.plan_view.tools.tool import Pointer
from bobdesk.ui.theme import colours


class TwoEdgesTool(LiveWireTool):
    """Each edge is followed or clicked as a line is, and ended by Enter or a double click."""

    name = "two_edges"

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(desk, parent)
        self._first: LineInProgress | None = None
        self._second: LineInProgress | None = None
        self._is_working = False

    def stop(self) -> None:
        """Keep both edges until the tool is taken again."""
        self._cursor = None
        if self._first is not None or self.line.pieces:
            self.desk.notices.note(self.tr("The edges that you began are kept; take the tool again to go on"))

    def reset(self) -> None:
        """Forget both edges."""
        self._first = self._second = None
        self._is_working = False
        super().reset()

    def press(self, pointer: Pointer) -> None:
        """Place the next point of an edge; not while the middle is being found."""
        if self._second is None:
            super().press(pointer)

    def finish(self) -> None:
        """End an edge; after the second one, find the middle."""
        if self._measuring:
            super().finish()
        elif self._second is not None:
            if not self._is_working:
                super().finish()
        elif len(self.line.points) < 2:
            self.desk.notices.refuse(self.tr("An edge needs at least two points; click on, or take the point back"))
        elif self._first is None:
            self._first, self.line = self.line, LineInProgress()
            self._is_ending = False
            self._anchor, self._anchor_of = None, None
        else:
            self._is_ending = False
            self._find_middle(self._first, self.line)
        self._say()
        self.repaint.emit()

    def take_back(self) -> bool:
        """Take the last click back: of the middle, of the second edge, then of the first."""
        if self._is_working:
            return False
        if self._second is not None:
            self.line, self._second = self._second, None
        elif self.line.is_empty and self._first is not None:
            self.line, self._first = self._first, None
        else:
            return super().take_back()
        self._find_ways()
        self._say()
        self.repaint.emit()
        return True

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """Draw both edges and what follows the mouse."""
        painter.setPen(pen(colours().preview, 2.0, alpha=150))
        for edge in (self._first, self._second):
            if edge is not None and edge.pieces:
                draw_line(painter, frame.to_screen(edge.points), frame)
        super().paint(painter, frame)

    def _take_up(self, pointer: Pointer) -> bool:
        return False

    def _following(self, pointer: Pointer) -> FloatArray | None:
        return None if self._second is not None else super()._following(pointer)

    def _find_middle(self, first: LineInProgress, second: LineInProgress) -> None:
        one, other = first.points, second.points
        self._second, self._is_working = second, True
        self.line = LineInProgress()

        def steps() -> Generator[None, None, FloatArray]:
            from bobdesk.plan.midline import midline

            yield
            return midline(one, other)

        self.desk.runner.start(
            self.tr("Finding the middle between two edges"), steps, done=self._on_middle, failed=self._on_no_middle
        )

    def _on_middle(self, middle: FloatArray) -> None:
        if not self._is_working or self._first is None or self._second is None:
            return
        self._is_working = False
        gap = float(np.hypot(*(self._first.points[0] - middle[0])))
        self.line = LineInProgress([Piece(middle, np.ones(len(middle)), max(2 * gap, 1.0))])
        super().finish()

    def _on_no_middle(self, sentence: str) -> None:
        self._is_working = False
        self.take_back()
        self.desk.notices.error(sentence)

    def _say(self) -> None:
        if self._is_working:
            self.say(self.tr("Finding the middle between two edges …"))
        elif self._second is not None:
            self.say(self.tr("The middle is ready: Enter takes it, Backspace goes back to the edges."))
        elif self._first is not None and self.line.is_empty:
            self.say(self.tr("First edge done. Click the start of the other edge."))
        elif self._first is None and self.line.is_empty and self._wire is not None:
            self.say(self.tr("Click the start of the first edge; the line will go in the middle between two edges."))
        else:
            super()._say()

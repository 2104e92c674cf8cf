"""Trace the line between two clicks."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Generator
from typing import Any

import numpy as np
from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QColor, QKeyEvent, QPainter

from bobdesk.plan.image import PlanImage
from bobdesk.plan.traced_line import Trace
from bobdesk.progress import Progress
from bobdesk.ui.desk import Desk
from bobdesk.ui.notices import Remedy
from bobdesk.ui.plan_view.layers.flags import draw_flag
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import pen
from bobdesk.ui.plan_view.tools.tool import Pointer, Tool
from bobdesk.ui.runner import Job
from bobdesk.ui.theme import colours

Place = tuple[float, float]
_PLACE = re.compile(r"(-?\d+),(-?\d+)")


class AutoTraceTool(Tool):
    """A click is the start, Shift and a click a point on the way, the next plain click the finish."""

    name = "auto_trace"

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(desk, parent)
        self._clicks: list[Place] = []
        self._cursor: Pointer | None = None
        self._job: Job | None = None
        self._progress: Progress | None = None
        self._last: tuple[PlanImage, list[Place], Trace] | None = None

    @property
    def is_busy(self) -> bool:
        """Whether a trace is under way."""
        return self._job is not None

    @property
    def can_look_for_loops(self) -> bool:
        """Whether the line is the one that was traced last, so that its clicks are known."""
        return self._last is not None and self.desk.session.project.trace is self._last[2] and not self.is_busy

    def start(self) -> None:
        """Say what to do."""
        self._say()

    def stop(self) -> None:
        """Go on in the background: a trace that is under way comes when it is ready."""
        self._cursor = None

    def refresh(self) -> None:
        """Say what can be done now."""
        self._say()

    def reset(self) -> None:
        """Forget the clicks, and stop what is under way."""
        self._clicks.clear()
        self._last = None
        if self._job is not None:
            self._job.stop()
        self._job, self._progress = None, None
        self.repaint.emit()

    def press(self, pointer: Pointer) -> None:
        """Take start, a point on the way, or the finish."""
        image = self.desk.picture.image
        if pointer.button != Qt.MouseButton.LeftButton or self._job is not None:
            return
        if image is None:
            self.desk.notices.refuse(self.tr("The picture is not ready yet"))
            return
        if self._clicks and math.dist(self._clicks[-1], pointer.plan) < max(1.0, 3 * pointer.px_per_screen):
            return
        self._cursor = pointer
        self._clicks.append(pointer.plan)
        if len(self._clicks) >= 2 and not pointer.holds(Qt.KeyboardModifier.ShiftModifier):
            self._run(image)
        self._say()
        self.repaint.emit()

    def move(self, pointer: Pointer) -> None:
        """Let the finish follow the mouse."""
        self._cursor = pointer
        if self._clicks:
            self.repaint.emit()

    def leave(self) -> None:
        """Show no finish while the mouse is elsewhere."""
        self._cursor = None
        self.repaint.emit()

    def takes_key(self, event: QKeyEvent) -> bool:
        """Return whether the key begins to trace or takes a click back."""
        return bool(self._clicks) and event.key() in (Qt.Key.Key_Backspace, Qt.Key.Key_Return, Qt.Key.Key_Enter)

    def key(self, event: QKeyEvent) -> bool:
        """Take Backspace and Enter."""
        if event.key() == Qt.Key.Key_Backspace:
            return self.take_back()
        image = self.desk.picture.image
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and len(self._clicks) >= 2 and image is not None:
            if self._job is None:
                self._run(image)
            return True
        return False

    def cancel(self) -> bool:
        """Stop a trace; its clicks stay. Without one, put the tool down."""
        if self._job is None:
            return False
        self._job.stop()
        return True

    def take_back(self) -> bool:
        """Take the last click back."""
        if self._job is not None or not self._clicks:
            return False
        self._clicks.pop()
        self._say()
        self.repaint.emit()
        return True

    def look_for_loops(self) -> None:
        """Trace the same clicks once more, going straight on at crossings."""
        if self._last is None or self._job is not None:
            return
        image, clicks, _trace = self._last

        def steps() -> Generator[Progress, None, Trace | None]:
            from bobdesk.plan.trace import propose_loops

            return (yield from propose_loops(image.pixels, clicks))

        self._start(self.tr("Looking for loops"), steps, lambda trace: self._on_loops(image, clicks, trace))

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """Draw the clicks, and where the next one would go."""
        if not self._clicks:
            return
        of = colours()
        points = [frame.point(place) for place in self._clicks]
        if self._cursor is not None and self._job is None:
            painter.setPen(pen(of.preview, 1.4, Qt.PenStyle.DashLine))
            painter.drawLine(points[-1], frame.point(self._cursor.plan))
        painter.setBrush(QColor(of.vertex))
        painter.setPen(pen(of.preview, 2.0))
        for point in points[1:]:
            painter.drawEllipse(point, 4.5, 4.5)
        draw_flag(painter, points[0], of.start, self.tr("Start"))

    def _run(self, image: PlanImage) -> None:
        clicks = list(self._clicks)

        def steps() -> Generator[Progress, None, Trace]:
            from bobdesk.plan.trace import trace_line

            return (yield from trace_line(image.pixels, np.array(clicks)))

        self._start(self.tr("Tracing the line"), steps, lambda trace: self._on_traced(image, clicks, trace))

    def _start(self, title: str, steps: Callable[[], Generator[Any, None, Any]], done: Callable[[Any], None]) -> None:
        def stopped() -> None:
            # After another document was opened the end of the old trace is no end of a new one.
            if self._job is job:
                self._on_stopped()

        job = self.desk.runner.start(
            title, steps, done=done, failed=self._on_failed, stopped=stopped, progressed=self._on_progress
        )
        self._job = job
        self._say()

    def _on_progress(self, progress: Progress) -> None:
        self._progress = progress
        self._say()

    def _on_failed(self, sentence: str) -> None:
        self._on_stopped()
        self.desk.notices.error(sentence)

    def _on_stopped(self) -> None:
        self._job, self._progress = None, None
        self._say()
        self.repaint.emit()

    def _on_traced(self, image: PlanImage, clicks: list[Place], trace: Trace) -> None:
        self._take(image, clicks, trace, self.tr("Trace line"))

    def _on_loops(self, image: PlanImage, clicks: list[Place], trace: Trace | None) -> None:
        if trace is None:
            self._on_stopped()
            self.desk.notices.note(self.tr("No loop was found: no longer way leads along the drawn line"))
        else:
            self._take(image, clicks, trace, self.tr("Trace line around its loops"))

    def _take(self, image: PlanImage, clicks: list[Place], trace: Trace, label: str) -> None:
        from bobdesk.project import edits

        self._on_stopped()
        if self.desk.picture.image is not image:
            return
        if self.desk.session.apply(label, lambda before: edits.take_trace(before, trace)):
            self._clicks.clear()
            self._last = (image, clicks, trace)
            self.desk.selection.vertices = ()
            self._tell(trace)
        self._say()
        self.repaint.emit()

    def _tell(self, trace: Trace) -> None:
        """Say what is doubtful about a trace, with a way to look at it."""
        if not trace.warnings:
            return
        sentence = trace.warnings[0]
        if len(trace.warnings) > 1:
            sentence = self.tr("{sentence} There are {count} more places to look at.").format(
                sentence=sentence, count=len(trace.warnings) - 1
            )
        remedies = []
        place = _PLACE.search(trace.warnings[0])
        if place is not None:
            x, y = float(place[1]), float(place[2])
            remedies.append(Remedy(self.tr("Show it"), lambda: self.show_place.emit(x, y)))
        remedies.append(Remedy(self.tr("Look for loops"), self.look_for_loops))
        self.desk.notices.warn(sentence, *remedies)

    def _say(self) -> None:
        if self._job is not None:
            doing = self._job.title if self._progress is None else self._progress.doing
            share = 0 if self._progress is None else round(100 * self._progress.fraction)
            self.say(self.tr("{doing} … {share} %. Esc stops it.").format(doing=doing, share=share))
        elif self.desk.picture.image is None:
            self.say(self.tr("The picture is not ready yet."))
        elif not self._clicks:
            self.say(self.tr("Click the start of the drawn line."))
        else:
            self.say(self.tr("Click the finish; Shift and a click adds a point on the way, as on a loop."))

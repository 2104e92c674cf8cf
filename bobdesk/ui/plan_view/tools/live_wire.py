"""Follow the drawn line: a wire clings to it between the last click and the mouse, each click takes a piece."""

from __future__ import annotations

from collections.abc import Generator
from typing import TYPE_CHECKING, Any

import numpy as np
from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QKeyEvent

from bobdesk.arrays import FloatArray
from bobdesk.plan.image import PlanImage
from bobdesk.ui.desk import Desk
from bobdesk.ui.newest import Newest
from bobdesk.ui.plan_view.tools.line_in_progress import Piece, clicked
from bobdesk.ui.plan_view.tools.line_tool import LineTool
from bobdesk.ui.plan_view.tools.tool import Pointer
from bobdesk.ui.runner import Job

if TYPE_CHECKING:
    from bobdesk.plan.livewire import Anchor, Followed, LiveWire

Place = tuple[float, float]
# Where the anchor lies beside the line's last point by less than this, it is that point's, picture pixels.
_SAME_PLACE = 12.0


class LiveWireTool(LineTool):
    """Until a wire is ready, and with Shift or F, a click is a plain vertex."""

    name = "live_wire"

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(desk, parent)
        self._is_free = False
        self._wire: LiveWire | None = None
        self._image: PlanImage | None = None
        self._preparing: Job | None = None
        self._anchor: Anchor | None = None
        self._anchor_of: Place | None = None
        self._measuring: list[Job] = []
        self._is_ending = False
        self._anchors = Newest(desk.runner, self.tr("Looking along the line"), self)
        self._anchors.answered.connect(self._on_anchor)
        self._anchors.failed.connect(desk.notices.warn)
        desk.picture.changed.connect(self._on_picture)

    @property
    def is_free(self) -> bool:
        """Whether clicks are plain vertices for now."""
        return self._is_free

    @property
    def is_ready(self) -> bool:
        """Whether the wire of the last point can be shown."""
        return self._anchor is not None and self._anchor_of == self.line.last

    def start(self) -> None:
        """Make the picture ready, and say what to do."""
        super().start()
        self._prepare()

    def reset(self) -> None:
        """Forget the line."""
        for job in self._measuring:
            job.stop()
        self._measuring.clear()
        self._is_ending = False
        self._anchors.drop()
        self._anchor, self._anchor_of = None, None
        super().reset()

    def takes_key(self, event: QKeyEvent) -> bool:
        """Return whether the key switches between wire and clicks, or ends the line."""
        return super().takes_key(event) or (not self.line.is_empty and event.key() == Qt.Key.Key_F)

    def key(self, event: QKeyEvent) -> bool:
        """Take F, and the keys of every line."""
        if event.key() == Qt.Key.Key_F and not self.line.is_empty:
            self._is_free = not self._is_free
            self._say()
            self.repaint.emit()
            return True
        return super().key(event)

    def take_back(self) -> bool:
        """Take the last click back, and find the ways from the one before."""
        self._is_ending = False
        taken = super().take_back()
        if taken:
            self._find_ways()
        return taken

    def finish(self) -> None:
        """End the line, as soon as its pieces are measured."""
        if self._measuring:
            self._is_ending = True
            self._say()
            return
        self._is_ending = False
        super().finish()

    def _take_up(self, pointer: Pointer) -> bool:
        taken = super()._take_up(pointer)
        if taken:
            self._find_ways()
        return taken

    def _place(self, pointer: Pointer, place: Place) -> None:
        anchor, wire = self._anchor, self._wire
        if anchor is None or wire is None or not self.is_ready or self._clicks_freely(pointer):
            self.line.pieces.append(clicked(place))
        else:
            way = anchor.path(place)
            piece = Piece(way[1:], np.ones(len(way) - 1))
            self.line.pieces.append(piece)
            self._measure(wire, anchor, way, piece)
        self._find_ways()

    def _following(self, pointer: Pointer) -> FloatArray | None:
        if self._anchor is not None and self.is_ready and not self._clicks_freely(pointer):
            way = self._anchor.path(pointer.plan)
            last = self.line.last
            return way if last is None else np.vstack([last, way[1:]])
        return super()._following(pointer)

    def _clicks_freely(self, pointer: Pointer) -> bool:
        return self._is_free != pointer.holds(Qt.KeyboardModifier.ShiftModifier)

    def _prepare(self) -> None:
        image = self.desk.picture.image
        if image is None or image is self._image:
            return
        self._image, self._wire = image, None

        def steps() -> Generator[Any, None, LiveWire]:
            from bobdesk.plan.livewire import prepare

            return (yield from prepare(image.pixels))

        def stopped() -> None:
            # The next click prepares it anew.
            if self._image is image and self._wire is None:
                self._image, self._preparing = None, None

        if self._preparing is not None:
            self._preparing.stop()
        self._preparing = self.desk.runner.start(
            self.tr("Preparing the picture for following"),
            steps,
            done=self._on_wire,
            failed=self.desk.notices.warn,
            stopped=stopped,
        )

    def _on_picture(self) -> None:
        if self.desk.picture.image is not self._image:
            self._image, self._wire, self._anchor = None, None, None

    def _on_wire(self, wire: LiveWire) -> None:
        self._preparing = None
        if self._image is None or wire.pixels is not self._image.pixels:
            return
        self._wire = wire
        self._find_ways()
        self._say()

    def _find_ways(self) -> None:
        """Have all ways from the last point found in the background."""
        wire, last = self._wire, self.line.last
        if wire is None:
            self._prepare()
            return
        if last is None or last == self._anchor_of:
            return
        colours = () if self._anchor is None else self._anchor.colours

        def find() -> tuple[Place, Anchor]:
            from bobdesk.plan.livewire import anchored

            return last, anchored(wire, last, colours=colours)

        self._anchors.ask(find)

    def _on_anchor(self, answer: tuple[Place, Anchor]) -> None:
        self._anchor_of, self._anchor = answer
        if self._anchor_of != self.line.last:
            self._find_ways()
        self._say()
        self.repaint.emit()

    def _measure(self, wire: LiveWire, anchor: Anchor, way: FloatArray, piece: Piece) -> None:
        """Bring an accepted piece to the middle of its line, in the background."""

        def steps() -> Generator[Any, None, Followed]:
            from bobdesk.plan.livewire import followed

            return (yield from followed(wire, anchor, way))

        def done(found: Followed) -> None:
            self._on_measured(piece, found)

        job = self.desk.runner.start(self.tr("Measuring the line"), steps, done=done, failed=self.desk.notices.warn)
        self._measuring.append(job)
        job.ended.connect(self._on_measuring_ended)

    def _on_measured(self, piece: Piece, found: Followed) -> None:
        if not any(piece is one for one in self.line.pieces):
            return
        was_last = self.line.pieces[-1] is piece
        before = next(index for index, one in enumerate(self.line.pieces) if one is piece) - 1
        if before == 0 and len(self.line.pieces[0].points) == 1 and found.width > 0:
            # The first click goes onto the line that it began.
            self.line.pieces[0].points = found.points[:1].copy()
        piece.points, piece.confidence, piece.width = found.points[1:], found.confidence[1:], found.width
        if was_last:
            x, y = piece.points[-1]
            if self._anchor is not None and self._anchor_of is not None:
                near = np.hypot(self._anchor_of[0] - x, self._anchor_of[1] - y) < _SAME_PLACE
                self._anchor_of = (float(x), float(y)) if near else self._anchor_of
            self._find_ways()
        self.repaint.emit()

    def _on_measuring_ended(self) -> None:
        self._measuring = [job for job in self._measuring if job.is_running]
        if self._is_ending and not self._measuring:
            self.finish()
        self._say()

    def _can_commit(self) -> bool:
        return not self._measuring and super()._can_commit()

    def _say(self) -> None:
        if self._is_ending:
            self.say(self.tr("Measuring the last pieces …"))
        elif self.desk.picture.image is None:
            self.say(self.tr("The picture is not ready yet."))
        elif self._wire is None:
            self.say(self.tr("Preparing the picture …"))
        elif self._rests:
            self.say(self.tr("Click to go on, Enter to end the line, Esc once more to put the tool down."))
        elif self.line.is_empty and self.desk.session.project.trace is not None:
            self.say(self.tr("Click an end of the line to continue it, or the start of another one."))
        elif self.line.is_empty:
            self.say(self.tr("Click the start of the drawn line."))
        elif self._is_free:
            self.say(self.tr("Free clicks: F or Shift follows the line again; Enter ends, Backspace takes back."))
        else:
            self.say(self.tr("Click to take the piece; F or Shift for free clicks; Enter ends, Backspace takes back."))

"""Give a known distance: click both ends, type the length; the ends can be dragged afterwards."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QKeyEvent, QPainter

from bobdesk.plan.control_points import KnownDistance
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.control_points import draw_measured
from bobdesk.ui.plan_view.popup import Popup
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.tools.give_distance import give_distance
from bobdesk.ui.plan_view.tools.tool import Pointer, Tool

Place = tuple[float, float]
_Held = tuple[Literal["known", "check"], int, Literal["start_px", "end_px"]]


class KnownDistanceTool(Tool):
    """Two clicks and a number."""

    name = "known_distance"

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(desk, parent)
        self._first: Place | None = None
        self._second: Place | None = None
        self._cursor: Pointer | None = None
        self._held: _Held | None = None
        self._popup: Popup | None = None

    @property
    def is_dragging(self) -> bool:
        """Whether an end follows the mouse."""
        return self._held is not None

    def start(self) -> None:
        """Say what to do."""
        self._say()

    def stop(self) -> None:
        """Drop a drag and the form; a first click stays."""
        self._held, self._cursor = None, None
        self._close_popup()

    def refresh(self) -> None:
        """Drop a drag: the distance may be gone."""
        self._held = None

    def reset(self) -> None:
        """Forget the clicks."""
        self._first = self._second = self._held = None
        self._close_popup()
        self.repaint.emit()

    def press(self, pointer: Pointer) -> None:
        """Take the next end, or take hold of one that there is."""
        if pointer.button != Qt.MouseButton.LeftButton or self.host is None:
            return
        self._cursor = pointer
        if self._first is None:
            self._held = self._end_under(pointer)
            if self._held is None:
                self._first = pointer.plan
        elif math.dist(self._first, pointer.plan) > 2 * pointer.px_per_screen:
            self._second = pointer.plan
            self._close_popup()
            self._popup = give_distance(self.desk, self.host, pointer.screen, self._first, self._second, "known")
            self._popup.gone.connect(self._on_popup_gone)
        self._say()
        self.repaint.emit()

    def move(self, pointer: Pointer) -> None:
        """Let the second end, or the one that is held, follow the mouse."""
        self._cursor = pointer
        self.repaint.emit()

    def release(self, pointer: Pointer) -> None:
        """Put a dragged end."""
        if self._held is None or pointer.button != Qt.MouseButton.LeftButton:
            return
        held, self._held = self._held, None
        self.desk.session.apply(self.tr("Move end of distance"), lambda before: _moved(before, held, pointer.plan))
        self.repaint.emit()

    def key(self, event: QKeyEvent) -> bool:
        """Take Backspace."""
        return event.key() == Qt.Key.Key_Backspace and self.take_back()

    def cancel(self) -> bool:
        """Drop a drag, or the distance that is under way."""
        if self._held is not None:
            self._held = None
            self.repaint.emit()
            return True
        return self.take_back()

    def take_back(self) -> bool:
        """Take the last click back."""
        if self._second is not None:
            self._second = None
            self._close_popup()
        elif self._first is not None:
            self._first = None
        else:
            return False
        self._say()
        self.repaint.emit()
        return True

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """Draw the distance that is under way."""
        if self._held is not None and self._cursor is not None:
            known = _distance(self.desk.session.project, self._held)
            still = known.end_px if self._held[2] == "start_px" else known.start_px
            draw_measured(painter, frame.point(still), self._cursor.screen, "", style=Qt.PenStyle.DashLine)
            return
        end = self._second or (None if self._cursor is None else self._cursor.plan)
        if self._first is not None and end is not None:
            length = self.tr("{count} px").format(count=self.desk.quantities.number(math.dist(self._first, end), 1))
            start, there = frame.point(self._first), frame.point(end)
            if (there - start).manhattanLength() > 2:
                draw_measured(painter, start, there, length, style=Qt.PenStyle.DashLine)

    def _on_popup_gone(self) -> None:
        self._popup = None
        self._first = self._second = None
        self._say()
        self.repaint.emit()

    def _close_popup(self) -> None:
        if self._popup is not None:
            self._popup.gone.disconnect(self._on_popup_gone)
            self._popup.drop()
            self._popup = None

    def _end_under(self, pointer: Pointer) -> _Held | None:
        project = self.desk.session.project
        kinds: tuple[tuple[Literal["known", "check"], tuple[KnownDistance, ...]], ...] = (
            ("known", project.known_distances),
            ("check", project.check_distances),
        )
        ends: tuple[Literal["start_px"], Literal["end_px"]] = ("start_px", "end_px")
        for kind, distances in kinds:
            for index, known in enumerate(distances):
                for end in ends:
                    if math.dist(getattr(known, end), pointer.plan) <= pointer.reach:
                        return kind, index, end
        return None

    def _say(self) -> None:
        if self._first is None:
            self.say(self.tr("Click one end of a distance that you know, such as the scale bar; ends can be dragged."))
        elif self._second is None:
            self.say(self.tr("Click the other end; Backspace takes the first one back."))
        else:
            self.say(self.tr("Type the length in plan, and press Enter."))


def _distance(project: Project, held: _Held) -> KnownDistance:
    return (project.known_distances if held[0] == "known" else project.check_distances)[held[1]]


def _moved(project: Project, held: _Held, place: Place) -> Project:
    from bobdesk.project import edits

    known = _distance(project, held)
    changed = replace(known, start_px=place) if held[2] == "start_px" else replace(known, end_px=place)
    if held[0] == "known":
        return edits.change_known_distance(project, held[1], changed)
    return edits.change_check_distance(project, held[1], changed)

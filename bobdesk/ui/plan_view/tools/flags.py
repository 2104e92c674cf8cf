"""Set start and finish, or cut the final climb: a click or a drag along the line."""

from __future__ import annotations

import math
from typing import Literal

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QPainter

from bobdesk.arrays import FloatArray
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.flags import draw_cut, draw_flag
from bobdesk.ui.plan_view.near import distances_along, nearest_on_line, place_at
from bobdesk.ui.plan_view.space import Frame, digitised_points
from bobdesk.ui.plan_view.tools.tool import Pointer, Tool
from bobdesk.ui.theme import colours

Flag = Literal["set_start", "set_finish", "cut"]
# A flag may be put from further away than a thing is hit: it snaps to the line anyway.
_SNAP = 3.0


class FlagTool(Tool):
    """Puts one flag; each of the three can be dragged by any of these tools.

    Parameters
    ----------
    name
        Which flag a click puts.
    """

    def __init__(self, name: Flag, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(desk, parent)
        self.name = name
        self._flag: Flag = name
        self._held: Flag | None = None
        self._at: float | None = None

    @property
    def is_dragging(self) -> bool:
        """Whether a flag follows the mouse."""
        return self._held is not None

    def start(self) -> None:
        """Say what to do."""
        self._say()

    def stop(self) -> None:
        """Drop a drag."""
        self.reset()

    def refresh(self) -> None:
        """Drop a drag, and say what can be done now."""
        self._held, self._at = None, None
        self._say()

    def reset(self) -> None:
        """Hold nothing."""
        self._held, self._at = None, None
        self.repaint.emit()

    def press(self, pointer: Pointer) -> None:
        """Take hold of a flag, or of the one to be put here."""
        if pointer.button != Qt.MouseButton.LeftButton:
            return
        points = self._points()
        if points is None:
            self.desk.notices.refuse(self.tr("There is no line yet; draw or trace it first"))
            return
        self._at = self._snapped(points, pointer)
        if self._at is None:
            self.desk.notices.refuse(self.tr("Click on the line"))
            return
        self._held = self._flag_under(points, pointer) or self._flag
        self.repaint.emit()

    def move(self, pointer: Pointer) -> None:
        """Let the flag follow along the line."""
        points = self._points()
        self._at = None if points is None else self._snapped(points, pointer, anywhere=self._held is not None)
        self.repaint.emit()

    def leave(self) -> None:
        """Show no flag while the mouse is elsewhere."""
        if self._held is None:
            self._at = None
            self.repaint.emit()

    def release(self, pointer: Pointer) -> None:
        """Put the flag."""
        if pointer.button != Qt.MouseButton.LeftButton or self._held is None:
            return
        held, at = self._held, self._at
        self.reset()
        if at is not None:
            self._put(held, at)

    def cancel(self) -> bool:
        """Drop a drag."""
        if self._held is None:
            return False
        self.reset()
        return True

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """Draw the flag where it would be put."""
        points = self._points()
        if points is None or self._at is None:
            return
        place, way = place_at(points, self._at)
        at = frame.point(place)
        painter.setOpacity(0.75)
        flag = self._held or self._flag
        if flag == "cut":
            draw_cut(painter, at, (way[0], way[1] * frame.y_sign), self.tr("Cut"))
        elif flag == "set_start":
            draw_flag(painter, at, colours().start, self.tr("Start"))
        else:
            draw_flag(painter, at, colours().finish, self.tr("Finish"), chequered=True)

    def _points(self) -> FloatArray | None:
        points = digitised_points(self.desk.session.project)
        return None if points is None or len(points) < 2 else points

    def _snapped(self, points: FloatArray, pointer: Pointer, *, anywhere: bool = False) -> float | None:
        near = nearest_on_line(points, pointer.plan)
        return near.along if anywhere or near.away <= _SNAP * pointer.reach else None

    def _flag_under(self, points: FloatArray, pointer: Pointer) -> Flag | None:
        """Return the flag that stands under the mouse, this tool's own first."""
        extent = self.desk.session.project.extent
        whole = float(distances_along(points)[-1])
        standing: dict[Flag, float | None] = {
            "set_start": extent.start,
            "set_finish": whole if extent.finish is None else extent.finish,
            "cut": extent.cut_off,
        }
        for flag in (self._flag, *standing):
            along = standing[flag]
            if along is not None:
                place = place_at(points, min(along, whole))[0]
                if math.dist(place, pointer.plan) <= pointer.reach:
                    return flag
        return None

    def _put(self, flag: Flag, at: float) -> None:
        from bobdesk.project import edits

        if flag == "set_start":
            self.desk.session.apply(self.tr("Set start"), lambda before: edits.set_start(before, at))
        elif flag == "set_finish":
            self.desk.session.apply(self.tr("Set finish"), lambda before: edits.set_finish(before, at))
        else:
            self.desk.session.apply(self.tr("Cut final climb"), lambda before: edits.cut_final_climb(before, at))

    def _say(self) -> None:
        if self._points() is None:
            self.say(self.tr("There is no line yet; draw or trace it first."))
        elif self._flag == "set_start":
            self.say(self.tr("Click the line where the track starts; flags can be dragged."))
        elif self._flag == "set_finish":
            self.say(self.tr("Click the line where the track finishes; flags can be dragged."))
        else:
            self.say(self.tr("Click the line at its lowest point: what climbs behind it is cut off."))

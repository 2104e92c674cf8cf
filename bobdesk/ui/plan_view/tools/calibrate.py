"""Add control points by a click and their coordinates, and move them."""

from __future__ import annotations

import math

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QPainter

from bobdesk.plan.control_points import ControlPoint
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.control_points import draw_target
from bobdesk.ui.plan_view.popup import Field, Popup
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.tools.tool import Pointer, Tool

_A_DRAG = 4.0


class CalibrateTool(Tool):
    """A click on a point selects it, a drag moves it, a click elsewhere adds one."""

    name = "calibrate"

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(desk, parent)
        self._held: int | None = None
        self._pressed: Pointer | None = None
        self._now: Pointer | None = None
        self._new: Pointer | None = None
        self._popup: Popup | None = None

    @property
    def is_dragging(self) -> bool:
        """Whether a point follows the mouse."""
        return self._held is not None and self._has_moved()

    def start(self) -> None:
        """Say what to do."""
        self._say()

    def stop(self) -> None:
        """Drop a drag and the form."""
        self.reset()

    def refresh(self) -> None:
        """Drop a drag: the point may be gone."""
        self._held = None

    def reset(self) -> None:
        """Hold nothing."""
        self._held = self._pressed = self._now = self._new = None
        self._close_popup()
        self.repaint.emit()

    def press(self, pointer: Pointer) -> None:
        """Take hold of a point, or ask for the coordinates of a new one."""
        if pointer.button != Qt.MouseButton.LeftButton or self.host is None:
            return
        self._pressed = self._now = pointer
        self._held = self._point_under(pointer)
        if self._held is not None:
            self.desk.selection.control_point = self._held
            self._close_popup()
        else:
            self._ask(pointer)
        self.repaint.emit()

    def move(self, pointer: Pointer) -> None:
        """Let a held point follow the mouse."""
        self._now = pointer
        if self._held is not None:
            self.repaint.emit()

    def release(self, pointer: Pointer) -> None:
        """Put a dragged point."""
        if pointer.button != Qt.MouseButton.LeftButton or self._held is None:
            return
        self._now = pointer
        held, moved, place = self._held, self._has_moved(), self._dragged_to()
        self._held = None
        if moved:
            from bobdesk.project import edits

            self.desk.session.apply(
                self.tr("Move control point"),
                lambda before: edits.move_control_point(before, held, place[0], place[1]),
            )
        self.repaint.emit()

    def delete(self) -> bool:
        """Take the selected point away."""
        from bobdesk.project import edits

        index = self.desk.selection.control_point
        if index is None or index >= len(self.desk.session.project.control_points):
            return False
        if self.desk.session.apply(
            self.tr("Remove control point"), lambda before: edits.remove_control_point(before, index)
        ):
            self.desk.selection.control_point = None
        return True

    def cancel(self) -> bool:
        """Drop a drag, or the point that waits for its coordinates."""
        if self._held is None and self._new is None:
            return False
        self.reset()
        self._say()
        return True

    def let_go(self) -> None:
        """Drop a drag; a point that waits for its coordinates goes on waiting."""
        if self._held is not None:
            self._held = None
            self.repaint.emit()

    def take_back(self) -> bool:
        """Take back a point that waits for its coordinates."""
        return self._new is not None and self.cancel()

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """Draw a dragged or a new point."""
        if self._new is not None:
            draw_target(painter, frame.point(self._new.plan), self._next_name(), chosen=True, used=True)
        elif self._held is not None and self._has_moved():
            point = self.desk.session.project.control_points[self._held]
            draw_target(painter, frame.point(self._dragged_to()), point.name, chosen=True, used=point.used)

    def _has_moved(self) -> bool:
        if self._pressed is None or self._now is None:
            return False
        way = self._now.screen - self._pressed.screen
        return math.hypot(way.x(), way.y()) >= _A_DRAG

    def _dragged_to(self) -> tuple[float, float]:
        """Return the point's own place moved as the mouse was: a grip beside the middle does not shift it."""
        if self._held is None or self._pressed is None or self._now is None:
            return 0.0, 0.0
        point = self.desk.session.project.control_points[self._held]
        return (
            point.x_px + self._now.plan[0] - self._pressed.plan[0],
            point.y_px + self._now.plan[1] - self._pressed.plan[1],
        )

    def _point_under(self, pointer: Pointer) -> int | None:
        found = [
            (math.dist((point.x_px, point.y_px), pointer.plan), index)
            for index, point in enumerate(self.desk.session.project.control_points)
        ]
        return min(found)[1] if found and min(found)[0] <= 1.3 * pointer.reach else None

    def _ask(self, pointer: Pointer) -> None:
        if self.host is None:
            return
        self._close_popup()
        self._new = pointer
        quantities = self.desk.quantities
        x, y = (quantities.length_factor * value for value in _guess(self.desk.session.project, pointer.plan))
        fields = [
            Field(self.tr("X (east)"), round(x, 3), quantities.length_unit),
            Field(self.tr("Y (north)"), round(y, 3), quantities.length_unit),
        ]
        title = self.tr("Position of point {name}").format(name=self._next_name())
        self._popup = Popup(self.host, pointer.screen, title, fields, self._add)
        self._popup.gone.connect(self._on_popup_gone)
        self._say()

    def _add(self, values: list[float]) -> bool:
        from bobdesk.project import edits

        if self._new is None:
            return True
        x_m, y_m = (value / self.desk.quantities.length_factor for value in values)
        point = ControlPoint(self._new.plan[0], self._new.plan[1], x_m, y_m, self._next_name())
        added = self.desk.session.apply(
            self.tr("Add control point"), lambda before: edits.add_control_point(before, point)
        )
        if added:
            self.desk.selection.control_point = len(self.desk.session.project.control_points) - 1
        return added

    def _next_name(self) -> str:
        taken = {point.name for point in self.desk.session.project.control_points}
        return next(name for name in map(str, range(1, len(taken) + 2)) if name not in taken)

    def _on_popup_gone(self) -> None:
        self._popup, self._new = None, None
        self._say()
        self.repaint.emit()

    def _close_popup(self) -> None:
        if self._popup is not None:
            self._popup.gone.disconnect(self._on_popup_gone)
            self._popup.drop()
            self._popup = None

    def _say(self) -> None:
        if self._new is not None:
            self.say(self.tr("Type the point's coordinates, and press Enter; Esc drops it."))
        else:
            self.say(self.tr("Click a place whose coordinates you know; drag points to move them, Delete removes."))


def _guess(project: Project, place: tuple[float, float]) -> tuple[float, float]:
    """Return the metres that the present scale gives a place; zeros without one."""
    from bobdesk.project import derive

    found = derive.calibration(project).value
    if found is None or not found.scale_known:
        return 0.0, 0.0
    x, y = found.to_metres([place])[0]
    return float(x), float(y)

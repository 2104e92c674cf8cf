"""The mouse on a strip: click, pan, zoom, a dragged stretch, levels and marks."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, Qt
from PySide6.QtGui import QContextMenuEvent, QMouseEvent, QPainter, QPen, QWheelEvent

from bobdesk.ui.strips.contents import shade
from bobdesk.ui.strips.overlay import Overlay, StripPointer
from bobdesk.ui.strips.strip_painting import Geometry

if TYPE_CHECKING:
    from bobdesk.ui.strips.strip import Strip

_A_DRAG = 4.0
_NEAR_LEVEL = 5.0
_NEAR_MARK = 9.0
_NOTCH = 1.25
_PIXELS_A_NOTCH = 60.0


@dataclass
class _Grip:
    """What the button holds."""

    kind: Literal["overlay", "level", "mark", "range", "box", "pan"]
    pressed: QPointF
    now: QPointF
    overlay: Overlay | None = None
    key: str = ""
    index: int = 0
    low: float = 0.0
    high: float = 0.0
    moved: bool = False


class StripMouse(QObject):
    """Filters the events of one strip."""

    def __init__(self, strip: Strip) -> None:
        super().__init__(strip)
        self._strip = strip
        self._grip: _Grip | None = None
        strip.installEventFilter(self)

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        """Take what concerns the mouse."""
        kind = event.type()
        if isinstance(event, QMouseEvent):
            if kind == QEvent.Type.MouseButtonPress:
                self._press(event)
            elif kind == QEvent.Type.MouseButtonDblClick:
                self._double_click(event)
            elif kind == QEvent.Type.MouseMove:
                self._move(event)
            elif kind == QEvent.Type.MouseButtonRelease:
                self._release(event)
            return True
        if isinstance(event, QWheelEvent):
            self._wheel(event)
            return True
        if isinstance(event, QContextMenuEvent):
            self._strip.menu_wanted.emit(event.globalPos())
            return True
        return False

    def level_now(self, key: str, value: float) -> float:
        """Return where a level is while it may be dragged."""
        grip = self._grip
        if grip is None or grip.kind != "level" or grip.key != key or not grip.moved:
            return value
        return self._value_at(grip.now)

    def cancel(self, *, keep_place: bool = False) -> bool:
        """Drop what is under way; with `keep_place` a pan stays where it is."""
        grip, self._grip = self._grip, None
        if grip is None:
            return False
        if grip.kind == "overlay" and grip.overlay is not None:
            grip.overlay.cancel()
        elif grip.kind == "level":
            self._strip.level_cancelled.emit(grip.key)
        elif grip.kind == "mark":
            self._strip.mark_cancelled.emit(grip.key)
        elif grip.kind == "pan" and not keep_place:
            self._strip.axis.show(grip.low, grip.high)
        self._strip.update()
        return True

    def cancel_mark(self) -> None:
        """Let go of a mark."""
        if self._grip is not None and self._grip.kind == "mark":
            self.cancel()

    def paint(self, painter: QPainter, on: Geometry) -> None:
        """Draw a stretch or a box that is being dragged."""
        grip = self._grip
        if grip is None or not grip.moved or grip.kind not in ("range", "box"):
            return
        box = QRectF(grip.pressed, grip.now).normalized()
        if grip.kind == "range":
            box = QRectF(box.left(), on.area.top(), box.width(), on.area.height())
        painter.fillRect(box, shade("accent", 40))
        painter.setPen(QPen(shade("accent"), 1.0, Qt.PenStyle.DashLine))
        painter.drawRect(box)

    def _press(self, event: QMouseEvent) -> None:
        if self._grip is not None:
            return
        at, on = event.position(), self._strip.geometry_now()
        if event.button() == Qt.MouseButton.MiddleButton:
            self._hold("pan", at)
        elif event.button() == Qt.MouseButton.LeftButton:
            self._press_left(StripPointer(at, on, event.modifiers()))

    def _press_left(self, pointer: StripPointer) -> None:
        at = pointer.at
        mark = self.mark_at(pointer)
        if mark is not None:
            self._hold("mark", at, key=mark[0], index=mark[1])
            return
        for overlay in reversed(self._strip.overlays):
            if overlay.press(pointer):
                self._hold("overlay", at, overlay=overlay)
                return
        level = self._level_at(pointer)
        if pointer.holds(Qt.KeyboardModifier.ShiftModifier):
            self._hold("range", at)
        elif pointer.holds(Qt.KeyboardModifier.ControlModifier):
            self._hold("box", at)
        elif level is not None:
            self._hold("level", at, key=level)
        else:
            self._hold("pan", at)

    def _hold(
        self,
        kind: Literal["overlay", "level", "mark", "range", "box", "pan"],
        at: QPointF,
        *,
        overlay: Overlay | None = None,
        key: str = "",
        index: int = 0,
    ) -> None:
        axis = self._strip.axis
        self._grip = _Grip(kind, at, at, overlay, key, index, axis.low, axis.high)

    def _move(self, event: QMouseEvent) -> None:
        grip, strip = self._grip, self._strip
        pointer = StripPointer(event.position(), strip.geometry_now(), event.modifiers())
        if grip is None:
            self._show_cursor(pointer)
            return
        grip.now = pointer.at
        way = grip.now - grip.pressed
        grip.moved = grip.moved or math.hypot(way.x(), way.y()) >= _A_DRAG
        if grip.kind == "overlay" and grip.overlay is not None:
            grip.overlay.move(pointer)
        elif not grip.moved:
            return
        elif grip.kind == "pan":
            by = way.x() * pointer.on.metres_per_pixel
            strip.axis.show(grip.low - by, grip.high - by)
            strip.setCursor(Qt.CursorShape.ClosedHandCursor)
        elif grip.kind == "level":
            strip.level_dragged.emit(grip.key, self._value_at(grip.now))
        elif grip.kind == "mark":
            strip.mark_dragged.emit(grip.key, grip.index, pointer.station, self._value_at(grip.now))
        strip.update()

    def _release(self, event: QMouseEvent) -> None:
        grip, strip = self._grip, self._strip
        if grip is None or event.button() not in (Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton):
            return
        self._grip = None
        pointer = StripPointer(event.position(), strip.geometry_now(), event.modifiers())
        grip.now = pointer.at
        if grip.kind == "overlay" and grip.overlay is not None:
            grip.overlay.release(pointer)
        elif not grip.moved:
            if event.button() == Qt.MouseButton.LeftButton:
                strip.station_clicked.emit(pointer.station, event.modifiers())
        elif grip.kind == "range":
            first, last = sorted((pointer.on.station(grip.pressed.x()), pointer.station))
            strip.range_selected.emit(first, last)
        elif grip.kind == "box":
            self._zoom_to(grip, pointer.on)
        elif grip.kind == "level":
            strip.level_dropped.emit(grip.key, self._value_at(grip.now))
        elif grip.kind == "mark":
            strip.mark_dropped.emit(grip.key, grip.index, pointer.station, self._value_at(grip.now))
        self._show_cursor(pointer)
        strip.update()

    def _double_click(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._strip.axis.fit()
            self._strip.fit()

    def _zoom_to(self, grip: _Grip, on: Geometry) -> None:
        first, last = sorted((on.station(grip.pressed.x()), on.station(grip.now.x())))
        low, high = sorted((on.value(grip.pressed.y()), on.value(grip.now.y())))
        if abs(grip.now.y() - grip.pressed.y()) > _A_DRAG * 2:
            self._strip.own_range = (low, high)
        if abs(grip.now.x() - grip.pressed.x()) > _A_DRAG * 2:
            self._strip.axis.show(first, last)
        self._strip.refresh()

    def _wheel(self, event: QWheelEvent) -> None:
        strip, on = self._strip, self._strip.geometry_now()
        pixels, notches = event.pixelDelta(), event.angleDelta()
        up, aside = (pixels.y() / _PIXELS_A_NOTCH, pixels.x() / _PIXELS_A_NOTCH)
        if pixels.isNull():
            up, aside = notches.y() / 120, notches.x() / 120
        if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            up, aside = 0.0, aside or up
        if abs(aside) > abs(up):
            strip.axis.pan(-aside * 0.1 * (strip.axis.high - strip.axis.low))
        elif event.position().x() < on.area.left():
            low, high = strip.own_range or strip.usual_range()
            stays, factor = on.value(event.position().y()), _NOTCH**-up
            strip.own_range = (stays + (low - stays) * factor, stays + (high - stays) * factor)
            strip.refresh()
        else:
            strip.axis.zoom(_NOTCH**up, on.station(event.position().x()))
        event.accept()

    def _show_cursor(self, pointer: StripPointer) -> None:
        shape = Qt.CursorShape.ArrowCursor
        if self.mark_at(pointer) is not None:
            shape = Qt.CursorShape.SizeAllCursor
        else:
            found = [overlay.cursor_at(pointer) for overlay in reversed(self._strip.overlays)]
            taken = next((one for one in found if one is not None), None)
            if taken is not None:
                shape = taken
            elif self._level_at(pointer) is not None:
                shape = Qt.CursorShape.SizeVerCursor
        self._strip.setCursor(shape)

    def _value_at(self, at: QPointF) -> float:
        on = self._strip.geometry_now()
        shown = on.value(min(max(at.y(), on.area.top()), on.area.bottom()))
        return self._strip.from_shown(shown)

    def _level_at(self, pointer: StripPointer) -> str | None:
        for key, level in self._strip.levels.items():
            if level.is_draggable:
                y = pointer.on.y(float(self._strip.to_shown(np.array([level.value]))[0]))
                if abs(y - pointer.at.y()) <= _NEAR_LEVEL and pointer.on.area.contains(pointer.at):
                    return key
        return None

    def mark_at(self, pointer: StripPointer) -> tuple[str, int] | None:
        """Return the key and the index of a mark that can be dragged."""
        for key, marks in self._strip.marks.items():
            if not marks.is_draggable or not len(marks.stations):
                continue
            shown = self._strip.to_shown(marks.values)
            for index, (station, value) in enumerate(zip(marks.stations.tolist(), shown.tolist(), strict=True)):
                way = pointer.at - QPointF(pointer.on.x(station), pointer.on.y(value))
                if math.hypot(way.x(), way.y()) <= _NEAR_MARK:
                    return key, index
        return None

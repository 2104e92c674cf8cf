"""Zoom and pan: where the view looks, kept in floating point so that nothing creeps."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QMouseEvent, QNativeGestureEvent, QTransform, QWheelEvent
from PySide6.QtWidgets import QGraphicsView

from bobdesk.ui.plan_view.space import Frame, Space

# A notch of the wheel, 120 eighths of a degree, zooms by this; a touchpad's pixels in proportion.
_NOTCH = 1.25
_PIXELS_A_NOTCH = 60.0
_LARGEST_OF_PIXEL, _LARGEST_OF_METRE = 64.0, 400.0
_SMALLEST_SHARE = 0.15
_MARGIN = 0.05
# The scene reaches so many times the plan's size beyond it, so that any place can come to the middle.
_ROOM = 8.0


class Navigation:
    """Where one view looks: the scene's point in its middle, and screen pixels per scene unit."""

    def __init__(self, view: QGraphicsView) -> None:
        self._view = view
        self.space = Space("nothing", QRectF(0, 0, 1, 1))
        self._centre = QPointF()
        self._scale = 1.0
        # What `fit` has shown, as long as nothing was zoomed or panned since.
        self._fitted: QRectF | None = None
        self._held_at: QPointF | None = None
        self.space_is_down = False

    @property
    def is_panning(self) -> bool:
        """Whether a pan is under way."""
        return self._held_at is not None

    def enter(self, space: Space) -> None:
        """Take another space; where the view looks stays until `fit`."""
        self.space = space
        size = max(space.bounds.width(), space.bounds.height()) * _ROOM
        self._view.setSceneRect(space.bounds.adjusted(-size, -size, size, size))
        self._look()

    def frame(self) -> Frame:
        """Return what is shown now."""
        shown = self._view.viewportTransform()
        port = self._view.viewport()
        return Frame(shown.m11(), shown.dx(), shown.dy(), self.space.y_sign, port.width(), port.height())

    def fit(self, part: QRectF) -> None:
        """Show a part of the scene as large as it goes."""
        port = self._view.viewport().rect()
        least = 40.0 / self._largest()
        width, height = max(part.width(), least), max(part.height(), least)
        self._scale = (1 - 2 * _MARGIN) * min(port.width() / width, port.height() / height)
        self._centre = part.center()
        self._look()
        self._fitted = QRectF(part)

    def show(self, point: QPointF) -> None:
        """Bring a point of the scene to the middle."""
        self._fitted = None
        self._centre = QPointF(point)
        self._look()

    def zoom(self, factor: float, at: QPointF | None = None) -> None:
        """Zoom, with the point of the viewport `at` staying where it is; the middle if there is none."""
        self._fitted = None
        port = QRectF(self._view.viewport().rect())
        offset = (port.center() if at is None else at) - port.center()
        stays = self._centre + offset / self._scale
        self._scale = min(max(self._scale * factor, self._smallest()), self._largest())
        self._centre = stays - offset / self._scale
        self._look()

    def zoom_to(self, scale: float) -> None:
        """Show so many screen pixels per scene unit, about the middle."""
        self.zoom(scale / self._scale)

    def pan(self, by: QPointF) -> None:
        """Move the plan with the hand, screen pixels."""
        self._fitted = None
        self._centre -= by / self._scale
        self._look()

    def refresh(self) -> None:
        """After the viewport got another size, show again what was fitted, or else the same place."""
        if self._fitted is not None:
            self.fit(self._fitted)
        else:
            self._look()

    def press(self, event: QMouseEvent) -> bool:
        """Begin to pan with the middle button, or the left one while Space is down; return whether it was that."""
        middle = event.button() == Qt.MouseButton.MiddleButton
        if not (middle or (self.space_is_down and event.button() == Qt.MouseButton.LeftButton)):
            return False
        self._held_at = event.position()
        return True

    def move(self, event: QMouseEvent) -> bool:
        """Go on with a pan."""
        if self._held_at is None:
            return False
        self.pan(event.position() - self._held_at)
        self._held_at = event.position()
        return True

    def release(self, event: QMouseEvent) -> bool:
        """End a pan."""
        if self._held_at is None:
            return False
        if event.button() in (Qt.MouseButton.MiddleButton, Qt.MouseButton.LeftButton):
            self._held_at = None
        return True

    def wheel(self, event: QWheelEvent) -> None:
        """Zoom at the cursor, by notches or by a touchpad's pixels."""
        pixels, angle = event.pixelDelta().y(), event.angleDelta().y()
        notches = pixels / _PIXELS_A_NOTCH if pixels else angle / 120.0
        if notches:
            self.zoom(_NOTCH**notches, event.position())

    def native_gesture(self, event: QNativeGestureEvent) -> bool:
        """Zoom by a pinch on a touchpad."""
        if event.gestureType() != Qt.NativeGestureType.ZoomNativeGesture:
            return False
        self.zoom(1.0 + event.value(), event.position())
        return True

    def _smallest(self) -> float:
        port, all_of_it = self._view.viewport().rect(), self.space.bounds
        fitting = min(port.width() / max(all_of_it.width(), 1e-9), port.height() / max(all_of_it.height(), 1e-9))
        return min(_SMALLEST_SHARE * fitting, 1.0)

    def _largest(self) -> float:
        return _LARGEST_OF_METRE if self.space.kind == "coordinates" else _LARGEST_OF_PIXEL

    def _look(self) -> None:
        bounds = self.space.bounds
        self._scale = min(max(self._scale, self._smallest()), self._largest())
        self._centre = QPointF(
            min(max(self._centre.x(), bounds.left()), bounds.right()),
            min(max(self._centre.y(), bounds.top()), bounds.bottom()),
        )
        self._view.setTransform(QTransform.fromScale(self._scale, self._scale))
        self._view.centerOn(self._centre)

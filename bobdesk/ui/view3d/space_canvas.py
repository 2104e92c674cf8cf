"""The part of the 3D view that draws, and takes mouse and keys."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from bobdesk.ui.theme import colours
from bobdesk.ui.view3d.camera import Camera
from bobdesk.ui.view3d.scene import Scene, draw, with_floor

_NEAR = 12.0
_TURN = math.radians(0.4)
_KEY_TURN = math.radians(5.0)
_CLICK = 4.0


class SpaceCanvas(QWidget):
    """Left drag orbits, middle or right drag (or Shift) pans, the wheel zooms at the mouse; a click picks.

    Signals
    -------
    hovered
        Row of the line under the mouse (int), or -1.
    picked
        Row that was clicked, or -1, and whether it is to be added to the selection.
    """

    hovered = Signal(int)
    picked = Signal(int, bool)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("space_canvas")
        self.setAccessibleName(self.tr("The result in three dimensions"))
        self.setAccessibleDescription(
            self.tr("Arrow keys turn, plus and minus zoom, 1 shows the front, 3 the side, 7 the top, F everything")
        )
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.camera = Camera()
        self.empty_text = ""
        self._scene: Scene | None = None
        self._is_fitted = True
        self._pressed: QPointF | None = None
        self._last = QPointF()
        self._moved = False

    def sizeHint(self) -> QSize:
        """Be as large as the plan."""
        return QSize(800, 500)

    @property
    def scene(self) -> Scene | None:
        """What is drawn."""
        return self._scene

    def show_scene(self, scene: Scene | None) -> None:
        """Draw something else; the view stays, but follows a line that is fitted."""
        self._scene = scene
        if scene is not None and self._is_fitted:
            self._fit()
        self.update()

    def fit(self) -> None:
        """Show everything."""
        self._is_fitted = True
        self._fit()
        self.update()

    def look(self, turn: float, tilt: float) -> None:
        """Look from another side, degrees, at everything."""
        self.camera = self.camera.looking(turn, tilt)
        self.fit()

    def exaggerate(self, factor: float) -> None:
        """Draw heights larger."""
        self.camera = replace(self.camera, exaggeration=factor)
        if self._is_fitted:
            self._fit()
        self.update()

    def row_at(self, place: QPointF) -> int:
        """Return the row of the line nearest to a place, the nearer to the viewer of two, or -1."""
        if self._scene is None:
            return -1
        places, depths = self.camera.seen(self._scene.points, self.width(), self.height())
        apart = np.hypot(places[:, 0] - place.x(), places[:, 1] - place.y())
        near = np.flatnonzero(apart <= _NEAR)
        if not len(near):
            return -1
        # Where lines cross in the picture, the one in front is meant.
        rank = apart[near] + 1e-3 * (depths[near] - depths[near].min())
        return int(near[rank.argmin()])

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw the scene."""
        painter = QPainter(self)
        if self._scene is None:
            of = colours()
            painter.fillRect(self.rect(), QColor(of.canvas))
            painter.setPen(QColor(of.muted))
            painter.drawText(QRectF(self.rect()), Qt.AlignmentFlag.AlignCenter, self.empty_text)
        else:
            draw(painter, self._scene, self.camera, QRectF(self.rect()))
        painter.end()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep everything in sight."""
        super().resizeEvent(event)
        if self._is_fitted:
            self._fit()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin to turn or pan."""
        self._pressed = self._last = event.position()
        self._moved = False

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Turn or pan, or mark the place under the mouse."""
        at = event.position()
        if self._pressed is None:
            self.hovered.emit(self.row_at(at))
            return
        if not self._moved and (at - self._pressed).manhattanLength() < _CLICK:
            return
        by = at - self._last
        self._last, self._moved = at, True
        shift = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
        if event.buttons() & Qt.MouseButton.LeftButton and not shift:
            self._move(self.camera.orbited(-_TURN * by.x(), _TURN * by.y()), fitted=self._is_fitted)
        else:
            self._move(self.camera.panned(by.x(), by.y()), fitted=False)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Pick what was clicked."""
        if self._pressed is not None and not self._moved and event.button() == Qt.MouseButton.LeftButton:
            adds = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
            self.picked.emit(self.row_at(event.position()), adds)
        self._pressed = None

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom at the mouse."""
        factor = 1.2 ** (event.angleDelta().y() / 120)
        at = event.position() - QPointF(self.width() / 2, self.height() / 2)
        self._move(self.camera.zoomed(factor, at.x(), at.y()), fitted=False)
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Turn, zoom, and look from the usual sides."""
        key = Qt.Key(event.key())
        turns = {
            Qt.Key.Key_Left: (_KEY_TURN, 0.0),
            Qt.Key.Key_Right: (-_KEY_TURN, 0.0),
            Qt.Key.Key_Up: (0.0, _KEY_TURN),
            Qt.Key.Key_Down: (0.0, -_KEY_TURN),
        }
        sides = {Qt.Key.Key_1: (0.0, 0.0), Qt.Key.Key_3: (90.0, 0.0), Qt.Key.Key_7: (0.0, 90.0)}
        if key in turns:
            self._move(self.camera.orbited(*turns[key]), fitted=self._is_fitted)
        elif key in sides and not event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            self.look(*sides[key])
        elif key in (Qt.Key.Key_Plus, Qt.Key.Key_Equal):
            self._move(self.camera.zoomed(1.2, 0, 0), fitted=False)
        elif key == Qt.Key.Key_Minus:
            self._move(self.camera.zoomed(1 / 1.2, 0, 0), fitted=False)
        elif key in (Qt.Key.Key_F, Qt.Key.Key_0):
            self.fit()
        else:
            super().keyPressEvent(event)

    def _move(self, camera: Camera, *, fitted: bool) -> None:
        self.camera = camera
        self._is_fitted = fitted
        if fitted:
            self._fit()
        self.update()

    def _fit(self) -> None:
        if self._scene is not None:
            self.camera = self.camera.fitted(
                with_floor(self._scene), max(self.width(), 50), max(self.height() - 60, 50)
            )

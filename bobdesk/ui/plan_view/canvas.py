"""Mouse, wheel and keys of the plan view: what pans and zooms is done here, the rest goes to the tool in hand."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QContextMenuEvent,
    QFocusEvent,
    QKeyEvent,
    QMouseEvent,
    QNativeGestureEvent,
    QPainter,
    QResizeEvent,
    QSinglePointEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QFrame, QGraphicsScene, QGraphicsView, QMenu, QWidget

from bobdesk.ui.plan_view.navigation import Navigation
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.tools.tool import Pointer, Tool
from bobdesk.ui.theme import colours


class Canvas(QGraphicsView):
    """A view that can be zoomed and panned in every tool.

    Signals
    -------
    pointer_moved
        Where the mouse is, (x, y) in plan units, or None when it has left.
    view_changed
        Zoom or place are others.
    """

    pointer_moved = Signal(object)
    view_changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.context_menu_maker: Callable[[], QMenu] | None = None
        self.navigation = Navigation(self)
        self._pointer: Pointer | None = None
        self.setScene(QGraphicsScene(self))
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setTransformationAnchor(QGraphicsView.ViewportAnchor.NoAnchor)
        self.setResizeAnchor(QGraphicsView.ViewportAnchor.NoAnchor)
        # What stands still on the screen (scale bar, loupe) would be smeared by partial updates.
        self.setViewportUpdateMode(QGraphicsView.ViewportUpdateMode.FullViewportUpdate)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAcceptDrops(False)
        self.viewport().setAcceptDrops(False)
        self.viewport().setMouseTracking(True)
        self.setMinimumSize(240, 160)

    @property
    def pointer(self) -> Pointer | None:
        """Where the mouse is, if it is over the plan."""
        return self._pointer

    def tool_in_hand(self) -> Tool:
        """Return the tool that gets mouse and keys."""
        raise NotImplementedError

    def cancel(self) -> bool:
        """Esc; return whether there was something to drop."""
        return False

    def nudge(self, event: QKeyEvent) -> bool:
        """Take an arrow key; return whether something was moved."""
        return False

    def frame_now(self) -> Frame:
        """Return what is shown now."""
        return self.navigation.frame()

    def drawBackground(self, painter: QPainter, rect: QRectF) -> None:  # type: ignore[override]
        """Fill what no picture covers."""
        painter.fillRect(rect, QColor(colours().canvas))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin to pan, or hand over to the tool."""
        if self.navigation.press(event):
            self.show_cursor()
        elif event.button() != Qt.MouseButton.RightButton:
            self.tool_in_hand().press(self._taken(event))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Pan, or hand over to the tool."""
        if self.navigation.move(event):
            self.view_changed.emit()
            self._taken(event)
        else:
            self.tool_in_hand().move(self._taken(event))
        self.pointer_moved.emit(self._taken(event).plan)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End a pan, or hand over to the tool."""
        if self.navigation.release(event):
            self.show_cursor()
        elif event.button() != Qt.MouseButton.RightButton:
            self.tool_in_hand().release(self._taken(event))

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Hand over to the tool."""
        if not self.navigation.press(event) and event.button() == Qt.MouseButton.LeftButton:
            self.tool_in_hand().double_click(self._taken(event))

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom at the cursor."""
        self.navigation.wheel(event)
        self._taken(event)
        self.view_changed.emit()
        event.accept()

    def viewportEvent(self, event: QEvent) -> bool:
        """Zoom by a pinch; notice when the mouse leaves."""
        if isinstance(event, QNativeGestureEvent) and self.navigation.native_gesture(event):
            self.view_changed.emit()
            return True
        if event.type() == QEvent.Type.Leave:
            self._pointer = None
            self.tool_in_hand().leave()
            self.pointer_moved.emit(None)
        return super().viewportEvent(event)

    def event(self, event: QEvent) -> bool:
        """Keep keys that mean something to the tool now from becoming an action's."""
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            plain = event.key() in (Qt.Key.Key_Escape, Qt.Key.Key_Space)
            if plain or self.tool_in_hand().takes_key(event):
                event.accept()
                return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Take Space for panning, Esc, arrows, and what the tool takes."""
        if event.key() == Qt.Key.Key_Space:
            self.navigation.space_is_down = True
            self.show_cursor()
        elif event.key() == Qt.Key.Key_Escape:
            if not self.cancel():
                event.ignore()
        elif not (self.tool_in_hand().key(event) or self.nudge(event)):
            event.ignore()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        """Put the hand away with Space."""
        if event.key() == Qt.Key.Key_Space and not event.isAutoRepeat():
            self.navigation.space_is_down = False
            self.show_cursor()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Forget a Space that is released elsewhere; a drag ends, for Esc goes elsewhere too. A menu does not count."""
        if event.reason() not in (Qt.FocusReason.PopupFocusReason, Qt.FocusReason.MenuBarFocusReason):
            self.tool_in_hand().let_go()
        self.navigation.space_is_down = False
        self.show_cursor()
        super().focusOutEvent(event)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Show the actions that can be done here."""
        if self.context_menu_maker is not None:
            self.context_menu_maker().popup(event.globalPos())
        event.accept()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Go on looking at the same place."""
        super().resizeEvent(event)
        self.navigation.refresh()
        self.view_changed.emit()

    def show_cursor(self) -> None:
        """Show the cursor of the pan or of the tool."""
        if self.navigation.is_panning:
            shape = Qt.CursorShape.ClosedHandCursor
        elif self.navigation.space_is_down:
            shape = Qt.CursorShape.OpenHandCursor
        else:
            shape = self.tool_in_hand().cursor
        self.viewport().setCursor(shape)

    def pointer_at(self, at: QPointF) -> Pointer:
        """Return what the mouse would point at, at a place of the viewport."""
        frame = self.frame_now()
        plan = ((at.x() - frame.left) / frame.scale, (at.y() - frame.top) / (frame.scale * frame.y_sign))
        return Pointer(plan, at, frame.per_screen, Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier)

    def _taken(self, event: QSinglePointEvent) -> Pointer:
        there = self.pointer_at(event.position())
        button = event.button() if isinstance(event, QMouseEvent) else Qt.MouseButton.NoButton
        self._pointer = Pointer(there.plan, there.screen, there.px_per_screen, button, event.modifiers())
        return self._pointer

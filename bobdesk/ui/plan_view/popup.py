"""A small form beside a click: a length, or the two coordinates of a point."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QDialogButtonBox, QFormLayout, QFrame, QLabel, QWidget

from bobdesk.ui.widgets.spin import Spin

_AWAY = 14


@dataclass(frozen=True)
class Field:
    """One number of the form: what it is called, its first value, unit, digits and range."""

    label: str
    value: float
    unit: str
    digits: int = 3
    least: float = -1e9
    most: float = 1e9


class Popup(QFrame):
    """Enter takes the numbers, Esc drops the form.

    Parameters
    ----------
    host
        What the form lies on.
    beside
        The click, pixels of the host.
    taken
        Called with the numbers in the order of the fields; returns whether they could be used.

    Signals
    -------
    gone
        The form was closed, whether its numbers were used or not.
    """

    gone = Signal()

    def __init__(
        self,
        host: QWidget,
        beside: QPointF,
        title: str,
        fields: Sequence[Field],
        taken: Callable[[list[float]], bool],
    ) -> None:
        super().__init__(host)
        self.setObjectName("plan_popup")
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.setAutoFillBackground(True)
        self.setCursor(Qt.CursorShape.ArrowCursor)
        self.setAccessibleName(title)
        self._taken = taken
        self._boxes = [self._box(field) for field in fields]
        form = QFormLayout(self)
        form.setContentsMargins(12, 10, 12, 10)
        form.setSpacing(8)
        heading = QLabel(title, self)
        heading.setProperty("kind", "heading")
        form.addRow(heading)
        for field, box in zip(fields, self._boxes, strict=True):
            label = QLabel(field.label, self)
            label.setBuddy(box)
            form.addRow(label, box)
        standard = QDialogButtonBox.StandardButton
        buttons = QDialogButtonBox(standard.Ok | standard.Cancel, self)
        buttons.accepted.connect(self.take)
        buttons.rejected.connect(self.drop)
        form.addRow(buttons)
        self.adjustSize()
        self._put(beside)
        self.show()
        self._boxes[0].setFocus(Qt.FocusReason.PopupFocusReason)
        self._boxes[0].selectAll()

    @property
    def boxes(self) -> list[Spin]:
        """The fields to type in."""
        return self._boxes

    def take(self) -> None:
        """Use the numbers; the form stays while they cannot be used."""
        for box in self._boxes:
            if box.say_what_is_wrong():
                box.setFocus(Qt.FocusReason.OtherFocusReason)
                return
            box.interpretText()
        if self._taken([box.value() for box in self._boxes]):
            self.drop()

    def drop(self) -> None:
        """Close without doing anything."""
        host = self.parentWidget()
        self.hide()
        self.deleteLater()
        if host is not None:
            view = host.parentWidget()
            (view or host).setFocus(Qt.FocusReason.PopupFocusReason)
        self.gone.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Take or drop; no other key goes on to the plan."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.take()
        elif event.key() == Qt.Key.Key_Escape:
            self.drop()
        event.accept()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Keep Enter and Esc in a field from becoming an action's."""
        if event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
            return True
        # A box would put its number from before in the place of a text that it cannot read.
        if (
            event.type() == QEvent.Type.KeyPress
            and isinstance(event, QKeyEvent)
            and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        ):
            self.take()
            return True
        if isinstance(watched, Spin) and event.type() == QEvent.Type.KeyPress and isinstance(event, QKeyEvent):
            leaves = event.key() in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab)
            return leaves and watched.say_what_is_wrong()
        return super().eventFilter(watched, event)

    def _box(self, field: Field) -> Spin:
        box = Spin(field.label, self)
        box.setDecimals(field.digits)
        box.setRange(field.least, field.most)
        box.setValue(field.value)
        box.setSuffix(f" {field.unit}")
        box.setButtonSymbols(Spin.ButtonSymbols.NoButtons)
        box.setMinimumWidth(150)
        box.setToolTip(field.label)
        box.installEventFilter(self)
        return box

    def _put(self, beside: QPointF) -> None:
        """Lie beside the click, inside the host."""
        host = self.parentWidget()
        if host is None:
            return
        at = QPoint(round(beside.x()) + _AWAY, round(beside.y()) + _AWAY)
        if at.x() + self.width() > host.width():
            at.setX(round(beside.x()) - _AWAY - self.width())
        if at.y() + self.height() > host.height():
            at.setY(round(beside.y()) - _AWAY - self.height())
        self.move(max(at.x(), 0), max(at.y(), 0))

"""A magnified piece of the plan around the mouse, in a corner where the mouse is not."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPaintEvent
from PySide6.QtWidgets import QWidget

from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.layer import Layer
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import pen
from bobdesk.ui.plan_view.tools.tool import Pointer
from bobdesk.ui.theme import colours

_SIZE = 176
_LABEL = 40
_AWAY = 16
_TIMES = 4.0
_LARGEST = 40.0


class Loupe(QWidget):
    """A circle with a crosshair, and the coordinates below.

    Parameters
    ----------
    layers
        Returns the layers that are seen through it.
    """

    def __init__(self, desk: Desk, layers: Callable[[], list[Layer]], parent: QWidget) -> None:
        super().__init__(parent)
        self.desk = desk
        self._layers = layers
        self._host = parent
        self._pointer: Pointer | None = None
        self._frame: Frame | None = None
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setAccessibleName(self.tr("Loupe"))
        self.resize(_SIZE + 2, _SIZE + _LABEL)
        self.hide()

    def look(self, pointer: Pointer | None, frame: Frame) -> None:
        """Show what lies around the mouse; None hides the loupe."""
        self._pointer, self._frame = pointer, frame
        self.setVisible(pointer is not None)
        if pointer is None:
            return
        right = frame.width - self.width() - _AWAY
        near = QRectF(right, _AWAY, self.width(), self.height()).adjusted(-60, -60, 60, 60)
        self.move(_AWAY if near.contains(pointer.screen) else right, _AWAY)
        # An update of its own would have the plan below painted a second time.
        self._host.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Paint circle, crosshair and coordinates."""
        if self._pointer is None or self._frame is None:
            return
        of = colours()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        circle = QRectF(2, 2, _SIZE - 4, _SIZE - 4)
        path = QPainterPath()
        path.addEllipse(circle)
        painter.save()
        painter.setClipPath(path)
        painter.fillPath(path, QColor(of.canvas))
        frame = self._magnified(self._pointer, self._frame)
        for layer in self._layers():
            painter.save()
            layer.draw(painter, frame)
            painter.restore()
        painter.restore()
        middle = circle.center()
        arm = circle.width() / 2
        for shade, width in ((of.base, 3.0), (of.control_point, 1.0)):
            painter.setPen(pen(shade, width, alpha=150 if width > 1 else 255))
            for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1)):
                painter.drawLine(middle + QPointF(x, y) * 5, middle + QPointF(x, y) * (arm - 1))
        painter.setPen(pen(of.base, 4.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawEllipse(circle)
        painter.setPen(pen(of.text, 2.0))
        painter.drawEllipse(circle)
        self._paint_coordinates(painter)
        painter.end()

    def _magnified(self, pointer: Pointer, frame: Frame) -> Frame:
        scale = max(frame.scale, min(_TIMES * frame.scale, _LARGEST))
        middle = _SIZE / 2
        left, top = middle - pointer.plan[0] * scale, middle - pointer.plan[1] * scale * frame.y_sign
        return Frame(scale, left, top, frame.y_sign, _SIZE, _SIZE)

    def _paint_coordinates(self, painter: QPainter) -> None:
        of = colours()
        lines = self._coordinates()
        metrics = painter.fontMetrics()
        width = min(self.width(), max(metrics.horizontalAdvance(line) for line in lines) + 14)
        box = QRectF((_SIZE - width) / 2, _SIZE + 1, width, metrics.height() * len(lines) + 4)
        shade = QColor(of.base)
        shade.setAlpha(230)
        painter.setPen(pen(of.border, 1.0))
        painter.setBrush(shade)
        painter.drawRoundedRect(box, 3, 3)
        painter.setPen(QColor(of.text))
        painter.drawText(box, int(Qt.AlignmentFlag.AlignCenter), "\n".join(lines))

    def _coordinates(self) -> list[str]:
        """Return pixels and, where there is a scale, metres."""
        if self._pointer is None:
            return [""]
        x, y = self._pointer.plan
        quantities, project = self.desk.quantities, self.desk.session.project
        in_metres: tuple[float, float] | None = None
        lines: list[str] = []
        if project.source is not None:
            in_metres = (x, y)
        else:
            lines.append(self.tr("{x} · {y} px").format(x=quantities.number(x, 1), y=quantities.number(y, 1)))
            if project.calibration.way != "points" or project.control_points or project.known_distances:
                from bobdesk.project import derive

                found = derive.calibration(project).value
                if found is not None and found.scale_known:
                    metres = found.to_metres([(x, y)])[0]
                    in_metres = (float(metres[0]), float(metres[1]))
        if in_metres is not None:
            one, other = (quantities.length(value, 2, unit=False) for value in in_metres)
            lines.append(f"{one} · {other} {quantities.length_unit}")
        return lines

"""A drawing that is kept as a picture once it is wanted a second time: while zooming, nothing is."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter, QPixmap

from bobdesk.ui.plan_view.space import Frame


class HeldPicture:
    """Draws the same as `draw` does, at the price of a picture."""

    def __init__(self) -> None:
        self._seen: tuple[object, ...] | None = None
        self._held: QPixmap | None = None

    def paint(
        self, painter: QPainter, frame: Frame, key: tuple[object, ...], draw: Callable[[QPainter], None]
    ) -> QPixmap | None:
        """Draw what `draw` draws in pixels of the screen; return the picture, if there is one.

        Parameters
        ----------
        key
            What the drawing follows from: compared by identity, or else as equal.
        """
        wanted = (*key, frame, painter.device().devicePixelRatioF())
        is_known = self._seen is not None and _same(self._seen, wanted)
        self._seen = wanted
        if not is_known:
            self._held = None
            draw(painter)
            return None
        if self._held is None:
            self._held = transparent(painter, frame)
            inside = QPainter(self._held)
            draw(inside)
            inside.end()
        painter.drawPixmap(0, 0, self._held)
        return self._held


def transparent(painter: QPainter, frame: Frame) -> QPixmap:
    """Return an empty picture as large as the view."""
    ratio = painter.device().devicePixelRatioF()
    made = QPixmap(round(ratio * frame.width), round(ratio * frame.height))
    made.setDevicePixelRatio(ratio)
    made.fill(Qt.GlobalColor.transparent)
    return made


def _same(one: tuple[object, ...], other: tuple[object, ...]) -> bool:
    return len(one) == len(other) and all(a is b or a == b for a, b in zip(one, other, strict=True))

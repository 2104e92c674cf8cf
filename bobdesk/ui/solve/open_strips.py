"""The strips show what the data leave open: the band, profiles at random, the error band, and where to measure next."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen
from PySide6.QtWidgets import QApplication, QMenu

from bobdesk.arrays import FloatArray
from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.solve.open_data import open_data_of
from bobdesk.ui.strips.contents import Band, Bundle, shade
from bobdesk.ui.strips.overlay import Overlay
from bobdesk.ui.strips.profile_strips import LIKELY, POSSIBLE
from bobdesk.ui.strips.strip_painting import Geometry

if TYPE_CHECKING:
    from bobdesk.ui.strips.strip_stack import StripStack

_OUTER, _INNER, _DRAWN = "outer", "inner", "drawn"
# Faint curves that can still be told apart.
_FEW = 30
_LEVELS = (0.05, 0.25, 0.75, 0.95)


class OpenStrips(QObject):
    """Feeds gradient and elevation strip; everything is laid over the line as it is now, at equal shares."""

    def __init__(self, desk: Desk, stack: StripStack) -> None:
        super().__init__(stack)
        self._desk = desk
        self._stack = stack
        self._now = alignment_now(desk)
        self._open = open_data_of(desk)
        self._drawn: object = None
        self._place = AdviceOverlay(desk)
        stack.elevation.add_overlay(self._place)
        stack.add_menu("eye", self.tr("What the data leave open"), self.fill_menu)
        self._open.changed.connect(self._draw)
        self._now.changed.connect(self._draw)
        desk.session.changed.connect(lambda _before, _after: self._draw())
        stack.installEventFilter(self)
        self._draw()

    def fill_menu(self, menu: QMenu) -> None:
        """Let each of them be shown or hidden."""
        for name, text, tip in (
            ("band", self.tr("&Band of all possible elevations"),
             self.tr("Every elevation that length, height difference, limits and known elevations allow")),
            ("profiles", self.tr("&Profiles at random"),
             self.tr("Profiles drawn evenly among all possible ones, and where half and 90 % of them lie; with no"
                     " largest change of gradient nearly all are rough and keep near the middle")),
            ("error_band", self.tr("&Error band of the result (95 %)"),
             self.tr("How far the real track may lie from the result")),
        ):  # fmt: skip
            action = menu.addAction(text)
            action.setToolTip(tip)
            action.setStatusTip(tip)
            action.setCheckable(True)
            action.setChecked(self._open.is_shown(name))
            action.toggled.connect(partial(self._open.show, name))
        menu.setToolTipsVisible(True)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Draw in the colours of another palette."""
        if event.type() == QEvent.Type.PaletteChange:
            self._drawn = None
            self._draw()
        return super().eventFilter(watched, event)

    def _length(self, own: float) -> float:
        value = self._now.value
        return own if value is None else value.line.length

    def _draw(self) -> None:
        found = self._open
        budget = found.budget if found.is_shown("error_band") else None
        run = self._desk.session.project.run
        length = self._length(0.0)
        # Everything but the advice is drawn anew only if it is another one: this is called with each edit.
        drawn = (found.band, found.profiles, budget, length, run)
        if drawn != self._drawn:
            self._drawn = drawn
            self._draw_band()
            self._draw_profiles()
            self._draw_errors()
        self._place.follow(length)
        self._stack.elevation.update()

    def _draw_band(self) -> None:
        found = self._open.band
        band = None
        if found is not None:
            # Far above the start there is nothing to be read: it would only press the profile flat.
            high = np.minimum(found.highest, 1.15 * float(found.highest[0]))
            band = Band(self._length(found.length) * found.shares, np.minimum(found.lowest, high), high)
        self._stack.elevation.set_band(POSSIBLE, band)

    def _draw_profiles(self) -> None:
        found = self._open.profiles
        gradient, elevation = self._stack.gradient, self._stack.elevation
        if found is None:
            for strip in (gradient, elevation):
                strip.set_bundle(_DRAWN, None)
                strip.set_band(_OUTER, None)
                strip.set_band(_INNER, None)
            return
        stations = self._length(1.0) * found.shares
        # A gradient holds from one station to the next.
        corners, gradients = np.repeat(stations, 2)[1:-1], np.repeat(found.gradients, 2, axis=1)
        smooth = self._desk.session.project.limits.gradient_change is not None
        for strip, at, values, lines in (
            (gradient, corners, gradients, smooth),
            (elevation, stations, found.elevations, True),
        ):
            strip.set_bundle(_DRAWN, Bundle(at, values[:_FEW]) if lines else None)
            low, lower, upper, high = np.quantile(values, _LEVELS, axis=0)
            strip.set_band(_OUTER, Band(at, low, high, "preview", 30))
            strip.set_band(_INNER, Band(at, lower, upper, "preview", 45))

    def _draw_errors(self) -> None:
        budget = self._open.budget if self._open.is_shown("error_band") else None
        gradient, elevation = self._stack.gradient, self._stack.elevation
        if budget is None:
            gradient.set_band(LIKELY, None)
            elevation.set_band(LIKELY, None)
            return
        own = float(budget.stations[-1])
        stations = budget.stations * (self._length(own) / own)
        colour = elevation.run_colour

        def around(values: FloatArray, half: FloatArray) -> Band:
            return Band(stations, values - half, values + half, colour, 34, has_edges=True)

        gradient.set_band(LIKELY, around(budget.line.gradients, budget.gradient))
        elevation.set_band(LIKELY, around(budget.line.elevations, budget.elevation))


class AdviceOverlay(Overlay):
    """A line and a hollow diamond where one more known elevation would help most."""

    def __init__(self, desk: Desk) -> None:
        self._desk = desk
        self._open = open_data_of(desk)
        self._station: float | None = None
        self._height = 0.0

    def follow(self, length: float) -> None:
        """Take the place from the newest advice, on a line of this length, m."""
        found = self._open.advice
        if found is None or length <= 0 or not self._open.is_current("advice"):
            self._station = None
            return
        self._station = found.station * (length / float(found.stations[-1]))
        band = found.band_after
        self._height = 0.5 * float(band.lowest[found.best] + band.highest[found.best])

    def paint_above(self, painter: QPainter, on: Geometry) -> None:
        """Draw the place."""
        if self._station is None or not on.low <= self._station <= on.high:
            return
        x, y = on.x(self._station), on.y(self._height * self._desk.quantities.length_factor)
        painter.setPen(QPen(shade("accent"), 1.4, Qt.PenStyle.DashLine))
        painter.drawLine(QPointF(x, on.area.top()), QPointF(x, on.area.bottom()))
        painter.setPen(QPen(shade("accent"), 1.6))
        painter.setBrush(shade("base"))
        size = 6.0
        painter.drawPolygon([QPointF(x, y - size), QPointF(x + size, y), QPointF(x, y + size), QPointF(x - size, y)])
        painter.setBrush(Qt.BrushStyle.NoBrush)
        font = QApplication.font()
        painter.setFont(font)
        metrics = QFontMetricsF(font)
        text = "◇? " + self._desk.quantities.length(self._station, 0)
        width = metrics.horizontalAdvance(text) + 8
        left = x + 5 if x + 5 + width < on.area.right() else x - 5 - width
        box = QRectF(left, on.area.top() + 2, width, metrics.height())
        painter.fillRect(box, shade("base", 200))
        painter.setPen(shade("accent"))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)

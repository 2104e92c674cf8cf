"""One strip: curves by station, drawn by a painter, so that screen, PNG and SVG are the same."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QPen, QPixmap, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from bobdesk.arrays import FloatArray
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.strips import strip_painting as paint
from bobdesk.ui.strips.contents import Band, Bundle, Curve, Level, Marks, shade
from bobdesk.ui.strips.overlay import Overlay, StripPointer
from bobdesk.ui.strips.station_axis import StationAxis
from bobdesk.ui.strips.strip_mouse import StripMouse
from bobdesk.ui.strips.strip_painting import Geometry, Words

_ROOM = 0.08


def as_it_is(values: FloatArray) -> FloatArray:
    """Return SI values for what is shown in SI."""
    return values


class Strip(QWidget):
    """Shows curves, bands, levels and marks, each known by a key; setting a key anew replaces it.

    Parameters
    ----------
    axis
        Shared with the other strips.
    title
        Of the quantity: "Curvature".

    Signals
    -------
    station_clicked
        Station, m, and the keyboard modifiers.
    range_selected
        First and last station of a dragged stretch, m.
    level_dragged, level_dropped
        Key, and value in SI, while it is dragged and at the end; `level_cancelled` (key) after Esc.
    mark_dragged, mark_dropped
        Key, index, station and value; `mark_cancelled` (key) after Esc.
    menu_wanted
        Global position of a right click.
    """

    station_clicked = Signal(float, Qt.KeyboardModifier)
    range_selected = Signal(float, float)
    level_dragged = Signal(str, float)
    level_dropped = Signal(str, float)
    level_cancelled = Signal(str)
    mark_dragged = Signal(str, int, float, float)
    mark_dropped = Signal(str, int, float, float)
    mark_cancelled = Signal(str)
    menu_wanted = Signal(object)

    def __init__(self, axis: StationAxis, quantities: Quantities, title: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.axis = axis
        self._quantities = quantities
        self.title = title
        self.unit: Callable[[], str] = str
        self.to_shown: Callable[[FloatArray], FloatArray] = as_it_is
        self.from_shown: Callable[[float], float] = float
        self.starts_at_zero = False
        self._note = ""
        self._empty = ""
        self.curves: dict[str, Curve] = {}
        self.bands: dict[str, Band] = {}
        self.bundles: dict[str, Bundle] = {}
        self.levels: dict[str, Level] = {}
        self.marks: dict[str, Marks] = {}
        self.overlays: list[Overlay] = []
        self.cursor_station: float | None = None
        self.selected_range: tuple[float, float] | None = None
        self.has_axis = False
        self.own_range: tuple[float, float] | None = None
        self._range: tuple[float, float] | None = None
        self._held: QPixmap | None = None
        self._held_for: object = None
        self._mouse = StripMouse(self)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumHeight(58)
        self.setAccessibleName(title)
        axis.changed.connect(self.update)
        quantities.changed.connect(self.refresh)

    def set_curve(self, key: str, curve: Curve | None) -> None:
        """Show a curve, or take it away with None."""
        self._set(self.curves, key, curve)

    def set_band(self, key: str, band: Band | None) -> None:
        """Fill the area between two curves, or take it away."""
        self._set(self.bands, key, band)

    def set_bundle(self, key: str, bundle: Bundle | None) -> None:
        """Show many faint curves behind all others, or take them away."""
        self._set(self.bundles, key, bundle)

    def set_level(self, key: str, level: Level | None) -> None:
        """Show a horizontal line, or take it away."""
        self._set(self.levels, key, level)

    def set_marks(self, key: str, marks: Marks | None) -> None:
        """Show points as diamonds, or take them away."""
        self._set(self.marks, key, marks)

    def add_overlay(self, overlay: Overlay) -> None:
        """Let an overlay draw and take the mouse."""
        self.overlays.append(overlay)
        self.update()

    def set_note(self, note: str) -> None:
        """Say something at the right of the title: the values at the cursor, a legend."""
        if note != self._note:
            self._note = note
            self.setAccessibleDescription(note)
            self.update()

    def set_empty(self, sentence: str) -> None:
        """Say why there is nothing to see, while there is no curve."""
        self._empty = sentence
        self.update()

    def refresh(self) -> None:
        """Draw everything anew, in the colours and units in force."""
        self._held = self._range = None
        self.update()

    def geometry_now(self) -> Geometry:
        """Return where stations and values lie now."""
        return self.geometry_in(float(self.width()), float(self.height()))

    def geometry_in(self, width: float, height: float) -> Geometry:
        """Return where stations and values lie in a picture of a size."""
        bottom, top = self.own_range or self.usual_range()
        area = paint.plot_area(width, height, has_axis=self.has_axis)
        return Geometry(area, self.axis.low, self.axis.high, bottom, top)

    def usual_range(self) -> tuple[float, float]:
        """Return the range of values, in shown units, that everything which counts fits into."""
        if self._range is None:
            self._range = self._range_of_contents()
        return self._range

    def fit(self) -> None:
        """Show all values."""
        self.own_range = None
        self.update()

    def cancel(self, *, keep_place: bool = False) -> bool:
        """Drop what the mouse is doing; return whether there was something."""
        return self._mouse.cancel(keep_place=keep_place)

    def cancel_mark(self) -> None:
        """Let go of a mark that is being dragged."""
        self._mouse.cancel_mark()

    def place_at(self, at: QPoint) -> tuple[float, float]:
        """Return station and value at a point of the widget."""
        on = self.geometry_now()
        return on.station(at.x()), self.from_shown(on.value(at.y()))

    def mark_at(self, key: str, at: QPoint) -> int | None:
        """Return the index of the mark at a point of the widget."""
        pointer = StripPointer(QPointF(at), self.geometry_now(), Qt.KeyboardModifier.NoModifier)
        found = self._mouse.mark_at(pointer)
        return found[1] if found is not None and found[0] == key else None

    def draw(self, painter: QPainter, width: float, height: float, *, held: QPixmap | None = None) -> None:
        """Draw the strip in a size; `held` are curves that were drawn before."""
        on = self.geometry_in(width, height)
        painter.fillRect(QRectF(0, 0, width, height), shade("base"))
        painter.save()
        painter.setClipRect(on.area.adjusted(-1, 0, 1, 0))
        for overlay in self.overlays:
            overlay.paint_below(painter, on)
        if self.selected_range is not None:
            first, last = (on.x(station) for station in self.selected_range)
            painter.fillRect(QRectF(first, on.area.top(), last - first, on.area.height()), shade("accent", 46))
        painter.restore()
        full = bool(self.curves or self.marks or self.bands)
        paint.draw_frame(painter, on, self._words(), width, full=full)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setClipRect(on.area.adjusted(-1, -1, 1, 1))
        if held is not None:
            painter.drawPixmap(0, 0, held)
        else:
            self._draw_curves(painter, on)
        for key, level in self.levels.items():
            paint.draw_level(painter, on, level, self._shown(self._mouse.level_now(key, level.value)))
        painter.setClipRect(on.area.adjusted(-8, -8, 8, 8))
        for marks in self.marks.values():
            paint.draw_marks(painter, on, marks, self.to_shown)
        for overlay in self.overlays:
            overlay.paint_above(painter, on)
        self._draw_cursor(painter, on)
        self._mouse.paint(painter, on)
        painter.setClipping(False)
        if not full:
            paint.draw_empty(painter, on, self._empty)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw what changes with the mouse; the curves are kept as a picture."""
        painter = QPainter(self)
        self.draw(painter, float(self.width()), float(self.height()), held=self._held_curves())
        painter.end()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Draw the curves anew."""
        super().resizeEvent(event)
        self._held = None

    def changeEvent(self, event: QEvent) -> None:
        """Take other colours or letters."""
        super().changeEvent(event)
        if event.type() in (QEvent.Type.PaletteChange, QEvent.Type.FontChange, QEvent.Type.StyleChange):
            self._held = None
            self.update()

    def sizeHint(self) -> QSize:
        """Return a size in which the numbers at the left do not crowd."""
        return QSize(600, 104)

    def _range_of_contents(self) -> tuple[float, float]:
        counted = (curve for curve in self.curves.values() if curve.counts)
        parts = [self.to_shown(curve.values if curve.counted is None else curve.counted) for curve in counted]
        parts += [self.to_shown(marks.values) for marks in self.marks.values() if len(marks.values)]
        parts += [self.to_shown(np.array([level.value])) for level in self.levels.values() if level.counts]
        parts += [self.to_shown(edge) for band in self.bands.values() for edge in (band.low, band.high)]
        finite = [part[np.isfinite(part)] for part in parts]
        finite = [part for part in finite if len(part)]
        if not finite:
            return 0.0, 1.0
        low, high = min(float(part.min()) for part in finite), max(float(part.max()) for part in finite)
        if self.starts_at_zero:
            low, high = min(low, 0.0), max(high, 0.0)
        room = _ROOM * (high - low) if high > low else max(abs(high), 1.0) * 0.1
        return (low if self.starts_at_zero and low == 0.0 else low - room), high + room

    def _draw_curves(self, painter: QPainter, on: Geometry) -> None:
        for band in self.bands.values():
            paint.draw_band(painter, on, band, self.to_shown)
        for bundle in self.bundles.values():
            paint.draw_bundle(painter, on, bundle, self.to_shown)
        for curve in self.curves.values():
            paint.draw_curve(painter, on, curve, self.to_shown)

    def _held_curves(self) -> QPixmap:
        on, ratio = self.geometry_now(), self.devicePixelRatioF()
        wanted = (on, ratio)
        if self._held is None or self._held_for != wanted:
            self._held = QPixmap(round(ratio * self.width()), round(ratio * self.height()))
            self._held.setDevicePixelRatio(ratio)
            self._held.fill(Qt.GlobalColor.transparent)
            painter = QPainter(self._held)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setClipRect(on.area.adjusted(-1, -1, 1, 1))
            self._draw_curves(painter, on)
            painter.end()
            self._held_for = wanted
        return self._held

    def _draw_cursor(self, painter: QPainter, on: Geometry) -> None:
        if self.cursor_station is None:
            return
        x = round(on.x(self.cursor_station)) + 0.5
        painter.setPen(QPen(shade("text"), 1.0, Qt.PenStyle.DashLine))
        painter.drawLine(round(x), round(on.area.top()), round(x), round(on.area.bottom()))

    def _words(self) -> Words:
        unit = self._quantities
        return Words(
            self.title, self.unit(), self._note, self._empty, unit.number,
            unit.length_factor, unit.length_unit, self.has_axis,
        )  # fmt: skip

    def _shown(self, value: float) -> float:
        return float(self.to_shown(np.array([value]))[0])

    def _set(self, into: dict[str, object] | dict, key: str, value: object | None) -> None:  # type: ignore[type-arg]
        if value is None:
            if into.pop(key, None) is None:
                return
        else:
            into[key] = value
        self._held = self._range = None
        self.update()

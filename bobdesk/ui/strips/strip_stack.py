"""The strips under the plan, one below the other, with one axis and one cursor."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, QPoint, Qt, Signal
from PySide6.QtGui import QAction, QFocusEvent, QHideEvent, QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QMenu, QSizePolicy, QSplitter, QToolButton, QVBoxLayout, QWidget

from bobdesk.alignment.range_figures import range_figures
from bobdesk.alignment.segments import segment_at
from bobdesk.ui.desk import Desk
from bobdesk.ui.icons import icon
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.segments.boundary_drag import BoundaryDrag
from bobdesk.ui.segments.design import design_of
from bobdesk.ui.segments.operations import operations
from bobdesk.ui.strips.curvature_strip import CurvatureStrip
from bobdesk.ui.strips.design_overlay import DesignOverlay
from bobdesk.ui.strips.profile_strips import ElevationStrip, GradientStrip
from bobdesk.ui.strips.range_card import RangeCard
from bobdesk.ui.strips.segment_overlay import SegmentOverlay
from bobdesk.ui.strips.station_axis import StationAxis
from bobdesk.ui.strips.strip import Strip
from bobdesk.ui.strips.strip_saving import StripSaving

_NOTCH = 1.25


class StripStack(QWidget):
    """Curvature, gradient and elevation; other parts of the program may add curves to them, or strips of their own.

    Signals
    -------
    range_selected
        First and last station of a dragged stretch, m.
    """

    range_selected = Signal(float, float)

    def __init__(self, desk: Desk, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("strips")
        self.setAccessibleName(self.tr("Strips by station"))
        self.setAccessibleDescription(
            self.tr("Left and right move the cursor, or the selected boundary; plus and minus zoom; 0 shows all")
        )
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._desk = desk
        self._now = alignment_now(desk)
        self._operations = operations(desk)
        self.axis = StationAxis(self)
        self.drag = BoundaryDrag(desk, self)
        self.curvature = CurvatureStrip(desk, self.axis, self)
        self.gradient = GradientStrip(desk, self.axis, self)
        self.elevation = ElevationStrip(desk, self.axis, self)
        self._strips: list[Strip] = []
        self._segment_actions: list[QAction] = []
        self._menu_fillers: list[Callable[[QMenu, Strip, QPoint], object]] = []
        self._saving = StripSaving(desk, self)
        self._splitter = QSplitter(Qt.Orientation.Vertical, self)
        self._splitter.setChildrenCollapsible(False)
        self._splitter.setHandleWidth(1)
        self.card = RangeCard(desk.quantities, self)
        self._buttons: list[tuple[QToolButton, str]] = []
        self._menus: list[tuple[str, Callable[[QMenu], None]]] = []
        self._put_together()
        for strip in (self.curvature, self.gradient, self.elevation):
            self.add_strip(strip)
        self._design = design_of(desk)
        self.curvature.add_overlay(DesignOverlay(desk))
        self._connect()
        self._follow()

    @property
    def strips(self) -> tuple[Strip, ...]:
        """All strips, from the top."""
        return tuple(self._strips)

    def add_strip(self, strip: Strip) -> None:
        """Put one more strip below the others; it takes part in cursor, axis and segments."""
        strip.add_overlay(SegmentOverlay(self._desk, self.drag, has_handles=not self._strips))
        strip.station_clicked.connect(self._on_clicked)
        strip.range_selected.connect(self.select_range)
        strip.menu_wanted.connect(lambda at: self.menu_at(at).popup(at))
        strip.installEventFilter(self)
        for one in self._strips:
            one.has_axis = False
        strip.has_axis = True
        self._strips.append(strip)
        self._splitter.addWidget(strip)
        self._mark_station()

    def set_segment_actions(self, actions: list[QAction]) -> None:
        """Put actions into the context menu, and let their keys act here."""
        self._segment_actions = actions
        for action in actions:
            self.addAction(action)

    def add_to_menu(self, fill: Callable[[QMenu, Strip, QPoint], object]) -> None:
        """Have a function put more into the context menu of a strip, for a point of it."""
        self._menu_fillers.append(fill)

    def select_range(self, first: float, last: float) -> None:
        """Show the figures of a stretch."""
        value = self._now.value
        if value is None:
            return
        stations, profile = self.elevation.stations, self.elevation.profile
        elevations = None if stations is None or profile is None else (stations, profile.elevations)
        figures = range_figures(value.line.stations, value.bends, first, last, profile=elevations)
        for strip in self._strips:
            strip.selected_range = (figures.start, figures.end)
            strip.update()
        self.card.show_figures(figures)
        self._desk.selection.stretch = (figures.start, figures.end)
        self.range_selected.emit(figures.start, figures.end)

    def add_menu(self, icon_name: str, text: str, fill: Callable[[QMenu], None]) -> None:
        """Put a button with a menu below the others, and the menu into the context menu too."""
        self._menus.append((text, fill))
        button = self._tool(icon_name, text, lambda: self._show_menu(button, fill))
        self._tools.insertWidget(self._tools.count() - 1, button)

    def clear_range(self) -> bool:
        """Select no stretch; return whether there was one."""
        had = self.curvature.selected_range is not None
        for strip in self._strips:
            strip.selected_range = None
            strip.update()
        self.card.show_figures(None)
        self._desk.selection.stretch = None
        return had

    def fit(self) -> None:
        """Show the whole line and all values."""
        self.axis.fit()
        for strip in self._strips:
            strip.fit()

    def cancel(self) -> bool:
        """Esc: drop a drag, or the selected stretch, or what is selected; return whether there was something."""
        dropped = [strip.cancel() for strip in self._strips]
        return any(dropped) or self.clear_range() or self._operations.select_nothing()

    def let_go(self) -> None:
        """Drop a drag whose ground has changed: another step, another document, the keyboard elsewhere."""
        for strip in self._strips:
            strip.cancel(keep_place=True)

    def hideEvent(self, event: QHideEvent) -> None:
        """Hold nothing that is not seen."""
        self.let_go()
        super().hideEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Hold nothing when the keyboard goes, and Esc with it; a menu does not count."""
        if event.reason() not in (Qt.FocusReason.PopupFocusReason, Qt.FocusReason.MenuBarFocusReason):
            self.let_go()
        super().focusOutEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move cursor or boundary, zoom, cancel."""
        key = Qt.Key(event.key())
        ways = {Qt.Key.Key_Left: -1.0, Qt.Key.Key_Right: 1.0}
        if key in ways:
            self._step(ways[key], event.modifiers())
        elif key in (Qt.Key.Key_Plus, Qt.Key.Key_Equal):
            self._zoom(_NOTCH)
        elif key == Qt.Key.Key_Minus:
            self._zoom(1 / _NOTCH)
        elif key == Qt.Key.Key_0:
            self.fit()
        elif key in (Qt.Key.Key_Home, Qt.Key.Key_End):
            self._go_to(0.0 if key == Qt.Key.Key_Home else self.axis.length)
        elif key == Qt.Key.Key_Delete and self._desk.selection.boundary is not None:
            self._operations.delete_boundary()
        elif not (key == Qt.Key.Key_Escape and self.cancel()):
            super().keyPressEvent(event)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take the keyboard with a click on any strip."""
        if event.type() == QEvent.Type.MouseButtonPress:
            self.setFocus(Qt.FocusReason.MouseFocusReason)
        return super().eventFilter(watched, event)

    def changeEvent(self, event: QEvent) -> None:
        """Draw the icons in the colours of another palette."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            for button, name in self._buttons:
                button.setIcon(icon(name))
            self.card.refresh_icons()

    def _put_together(self) -> None:
        tools = self._tools = QVBoxLayout()
        tools.setContentsMargins(3, 4, 3, 4)
        tools.setSpacing(2)
        for name, text, do in (
            ("fit-all", self.tr("Show the whole line (0)"), self.fit),
            ("zoom-in", self.tr("Zoom in (+)"), lambda: self._zoom(_NOTCH)),
            ("zoom-out", self.tr("Zoom out (−)"), lambda: self._zoom(1 / _NOTCH)),
            ("export", self.tr("Save a strip as picture or table"), self._show_save_menu),
        ):
            tools.addWidget(self._tool(name, text, do))
        self._save_button = self._buttons[-1][0]
        tools.addStretch(1)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(0)
        row.addLayout(tools)
        row.addWidget(self._splitter, 1)
        row.addWidget(self.card)
        self.card.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Preferred)

    def _tool(self, name: str, text: str, do: Callable[[], object]) -> QToolButton:
        button = QToolButton(self)
        button.setIcon(icon(name))
        button.setAutoRaise(True)
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        button.setToolTip(text)
        button.setAccessibleName(text)
        button.clicked.connect(do)
        self._buttons.append((button, name))
        return button

    def _connect(self) -> None:
        selection = self._desk.selection
        self._now.changed.connect(self._follow)
        selection.station_changed.connect(self._mark_station)
        selection.segments_changed.connect(self._on_selection)
        selection.boundary_changed.connect(self._on_selection)
        selection.stretch_changed.connect(self._on_stretch)
        self._desk.quantities.changed.connect(self._mark_station)
        self._desk.session.document_changed.connect(self._on_document)
        self._desk.session.changed.connect(self.let_go)
        self._design.changed.connect(self.curvature.update)
        self.card.closed.connect(self.clear_range)
        for strip in (self.gradient, self.elevation):
            strip._later.changed.connect(self._mark_station)

    def _follow(self) -> None:
        value = self._now.value
        if value is not None:
            self.axis.set_length(value.line.length)
        if not self._now.is_preview:
            self._mark_station()
        self._on_selection()

    def _on_selection(self) -> None:
        for strip in self._strips:
            strip.update()

    def _on_stretch(self) -> None:
        stretch = self._desk.selection.stretch
        if stretch == self.curvature.selected_range:
            return
        if stretch is None:
            self.clear_range()
        else:
            self.select_range(*stretch)

    def _on_document(self) -> None:
        self.clear_range()
        self.fit()

    def _mark_station(self) -> None:
        station = self._desk.selection.station
        for strip in self._strips:
            strip.cursor_station = station
            strip.update()
        bend = self.curvature.readout(station)
        if station is not None and bend:
            bend = self.tr("station {station} · {rest}").format(
                station=self._desk.quantities.length(station), rest=bend
            )
        self.curvature.set_note(bend)
        for strip in (self.gradient, self.elevation):
            strip.set_note(strip.readout(station))

    def _on_clicked(self, station: float, modifiers: Qt.KeyboardModifier) -> None:
        segments = self._now.segments
        station = min(max(station, 0.0), self.axis.length)
        if not segments:
            return
        add = bool(modifiers & Qt.KeyboardModifier.ShiftModifier)
        self._operations.select(segment_at(segments, station), station=station, add=add)

    def _step(self, way: float, modifiers: Qt.KeyboardModifier) -> None:
        by = way * self.curvature.geometry_now().metres_per_pixel
        if modifiers & Qt.KeyboardModifier.ShiftModifier:
            by *= 10
        elif modifiers & Qt.KeyboardModifier.ControlModifier:
            by *= 0.1
        if not self._operations.nudge(by):
            station = self._desk.selection.station
            self._go_to((0.0 if station is None else station) + by)

    def _go_to(self, station: float) -> None:
        station = min(max(station, 0.0), self.axis.length)
        self._desk.selection.station = station
        self.axis.bring_in(station)

    def _zoom(self, factor: float) -> None:
        station = self._desk.selection.station
        inside = station is not None and self.axis.low <= station <= self.axis.high
        self.axis.zoom(factor, station if inside and station is not None else 0.5 * (self.axis.low + self.axis.high))

    def menu_at(self, at: QPoint) -> QMenu:
        """Return the context menu of a place on the screen."""
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        for action in self._segment_actions:
            if action.isEnabled():
                menu.addAction(action)
        strip = self._strip_at(at)
        menu.addSeparator()
        for fill in self._menu_fillers:
            fill(menu, strip, strip.mapFromGlobal(at))
        menu.addSeparator()
        menu.addAction(icon("fit-all"), self.tr("Show the whole line"), self.fit)
        if self.curvature.selected_range is not None:
            menu.addAction(self.tr("Close the selected stretch"), self.clear_range)
        menu.addSeparator()
        for text, fill_one in self._menus:
            fill_one(menu.addMenu(text))
        self._saving.fill_menu(menu, strip)
        return menu

    def _show_save_menu(self) -> None:
        def fill(menu: QMenu) -> None:
            for strip in self._strips:
                self._saving.fill_menu(menu.addMenu(strip.title), strip)

        self._show_menu(self._save_button, fill)

    def _show_menu(self, button: QToolButton, fill: Callable[[QMenu], None]) -> None:
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        fill(menu)
        menu.popup(button.mapToGlobal(QPoint(button.width(), 0)))

    def _strip_at(self, at: QPoint) -> Strip:
        inside = [strip for strip in self._strips if strip.rect().contains(strip.mapFromGlobal(at))]
        return inside[0] if inside else self._strips[0]

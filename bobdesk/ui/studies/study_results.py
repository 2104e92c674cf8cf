"""The right side of the study: its rows as a table, a table of colours and curves."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from PySide6.QtCore import QRectF, QSignalBlocker, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import (
    QComboBox,
    QHBoxLayout,
    QLabel,
    QScrollArea,
    QStackedWidget,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from bobdesk.track.study_pivot import AXES, Row, is_failed, value_of
from bobdesk.ui.desk import Desk
from bobdesk.ui.newest import Newest
from bobdesk.ui.plots.chart import draw_chart, size_with_legend
from bobdesk.ui.plots.chart_view import ChartView, HeatMapView
from bobdesk.ui.plots.heat_map import HeatMap, HeatMapLayout
from bobdesk.ui.plots.study_drawings import axis_titles, figure_titles
from bobdesk.ui.studies.rows_table import RowsModel, RowsTable
from bobdesk.ui.studies.study_columns import study_columns
from bobdesk.ui.studies.study_pictures import PictureChoice, StudyPicture, study_picture
from bobdesk.ui.studies.wrapping_row import wrapping_row
from bobdesk.ui.theme import on_paper

_REDRAW_EVERY_MS = 400
_CHART_SIZE = QSize(1000, 520)
_SHARPNESS = 2


class StudyResults(QWidget):
    """Shows the rows that there are; pictures follow them a little later.

    Signals
    -------
    page_changed
        Another page is shown.
    """

    page_changed = Signal()

    def __init__(self, desk: Desk, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._rows: tuple[Row, ...] = ()
        self.hint = QLabel(
            self.tr(
                "A study solves plans in every combination of what is chosen at the left, and shows the difference.\n\n"
                "Choose, see how many solves that makes, and press Solve. You can go on working meanwhile."
            ),
            self,
        )
        self.hint.setProperty("kind", "muted")
        self.hint.setWordWrap(True)
        self.hint.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.hint.setMargin(40)
        self.model = RowsModel(
            study_columns(desk.quantities),
            problem=lambda row: value_of(row, "message") if is_failed(row) else "",
            parent=self,
        )
        self.table = RowsTable(self.tr("Rows of the study"), self.model, self)
        self.heat_view = HeatMapView(self.tr("Figure as a table of colours"), self)
        self.chart_view = ChartView(self.tr("Figure as curves"), self)
        self.figure = self._combo(self.tr("Figure"), self.tr("Which figure the picture shows"))
        self.down = self._combo(self.tr("Rows"), self.tr("What stands at the rows of the table of colours"))
        self.across = self._combo(self.tr("Columns"), self.tr("What stands above its columns"))
        self.curve_figure = self._combo(self.tr("Figure"), self.tr("Which figure the curves show"))
        self.over = self._combo(self.tr("Over"), self.tr("What the curves go over; each other combination has its own"))
        self._clock = QTimer(self)
        self._clock.setSingleShot(True)
        self._clock.setInterval(_REDRAW_EVERY_MS)
        self._clock.timeout.connect(self._draw)
        self._is_wanted_now = False
        self._newest = Newest(desk.runner, self.tr("Drawing the study"), self)
        self._axes_chosen = False
        self._lay_out()
        self._connect()

    @property
    def rows(self) -> tuple[Row, ...]:
        """The rows, in the order of the study."""
        return self._rows

    @property
    def has_picture(self) -> bool:
        """Whether the page that is shown is a picture with something in it."""
        return bool(self._rows) and self.pages.currentIndex() > 0

    def begin(self) -> None:
        """Show that a study has begun: no rows yet, and axes that suit it will be chosen."""
        self._axes_chosen = False
        self.show_rows(())
        self.stack.setCurrentWidget(self.pages)

    def show_rows(self, rows: Sequence[Row]) -> None:
        """Show these rows."""
        self._rows = tuple(rows)
        self.model.show_rows(self._rows)
        self.table.fit_columns()
        if rows:
            self.stack.setCurrentWidget(self.pages)
        self._later()

    def add_rows(self, rows: Sequence[Row]) -> None:
        """Show more rows, as they come."""
        if not rows:
            return
        first = not self._rows
        self._rows = (*self._rows, *rows)
        self.model.add_rows(rows)
        if first:
            self.table.fit_columns()
        self._later()

    def picture(self, kind: str) -> bytes:
        """Return the picture that is shown, on paper, as the bytes of a .png or .svg."""
        from bobdesk.ui.plots.study_picture import picture_bytes, picture_font

        choice = self._choice()
        title = self._figure_now.currentText() if choice.is_heat_map else ""
        drawing = study_picture(self._rows, choice, title=title).drawing
        with on_paper():
            if isinstance(drawing, HeatMap):
                laid_out = HeatMapLayout(drawing, picture_font())
                return picture_bytes(laid_out.draw, laid_out.size, kind, sharpness=_SHARPNESS)
            size = size_with_legend(drawing, picture_font(), _CHART_SIZE)
            draw = partial(draw_chart, whole=QRectF(0, 0, size.width(), size.height()), chart=drawing)
            return picture_bytes(draw, size, kind, sharpness=_SHARPNESS)

    @property
    def _figure_now(self) -> QComboBox:
        return self.figure if self.pages.currentWidget() is self._heat_page else self.curve_figure

    def _choice(self) -> PictureChoice:
        axes = [combo.currentData() if self._axes_chosen else "" for combo in (self.down, self.across, self.over)]
        return PictureChoice(self.pages.currentWidget() is self._heat_page, self._figure_now.currentData(), *axes)

    def _combo(self, name: str, tip: str) -> QComboBox:
        combo = QComboBox(self)
        combo.setAccessibleName(name)
        combo.setToolTip(tip)
        return combo

    def _lay_out(self) -> None:
        for combo in (self.down, self.across, self.over):
            for axis, title in axis_titles().items():
                combo.addItem(title, axis)
        for combo in (self.figure, self.curve_figure):
            for figure, title in figure_titles().items():
                combo.addItem(title, figure)
        scroll = QScrollArea(self)
        scroll.setWidget(self.heat_view)
        scroll.setFrameShape(QScrollArea.Shape.NoFrame)
        scroll.setBackgroundRole(QPalette.ColorRole.Base)
        self._heat_page = self._page(
            [(self.tr("Figure"), self.figure), (self.tr("Rows"), self.down), (self.tr("Columns"), self.across)], scroll
        )
        self._curves_page = self._page(
            [(self.tr("Figure"), self.curve_figure), (self.tr("Over"), self.over)], self.chart_view
        )
        self.pages = QTabWidget(self)
        self.pages.addTab(self.table, self.tr("Table"))
        self.pages.addTab(self._heat_page, self.tr("Heat map"))
        self.pages.addTab(self._curves_page, self.tr("Curves"))
        self.stack = QStackedWidget(self)
        self.stack.addWidget(self.hint)
        self.stack.addWidget(self.pages)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.stack)

    def _page(self, fields: Sequence[tuple[str, QComboBox]], picture: QWidget) -> QWidget:
        page = QWidget(self)
        pairs = []
        for text, combo in fields:
            pair = QWidget(page)
            label = QLabel(text, pair)
            label.setBuddy(combo)
            row = QHBoxLayout(pair)
            row.setContentsMargins(0, 0, 8, 0)
            row.addWidget(label)
            row.addWidget(combo)
            pairs.append(pair)
        column = QVBoxLayout(page)
        column.addWidget(wrapping_row(page, pairs))
        column.addWidget(picture, 1)
        return page

    def _connect(self) -> None:
        for combo in (self.figure, self.curve_figure):
            combo.activated.connect(self._draw_now)
        for combo in (self.down, self.across, self.over):
            combo.activated.connect(self._on_axis)
        self._newest.answered.connect(self._show_picture)
        self.pages.currentChanged.connect(self._on_page)
        self._desk.quantities.changed.connect(self._on_units)

    def _on_axis(self) -> None:
        self._axes_chosen = True
        self._draw_now()

    def _draw_now(self) -> None:
        self._is_wanted_now = True
        self._draw()

    def _on_page(self) -> None:
        self._draw_now()
        self.page_changed.emit()

    def _on_units(self) -> None:
        self.model.refresh()
        self.table.fit_columns()

    def _later(self) -> None:
        if not self._clock.isActive():
            self._clock.start()

    def _draw(self) -> None:
        self._clock.stop()
        rows, choice = self._rows, self._choice()
        if not rows:
            self._newest.drop()
            self.heat_view.show_map(None)
            self.chart_view.show_chart(None)
        elif self.pages.currentWidget() is self.table:
            self._newest.drop()
        elif self._newest.is_busy and not self._is_wanted_now:
            # One that is being worked out is shown first, or rows that keep coming would leave none.
            self._later()
        else:
            self._is_wanted_now = False
            self._newest.ask(lambda: study_picture(rows, choice))

    def _show_picture(self, picture: StudyPicture) -> None:
        choice = picture.choice
        if not self._rows or choice.is_heat_map != (self.pages.currentWidget() is self._heat_page):
            return
        for combo in (self.figure, self.curve_figure):
            self._offer(combo, picture.figures)
        with QSignalBlocker(self._figure_now):
            self._figure_now.setCurrentIndex(max(0, self._figure_now.findData(choice.figure)))
        for combo, axis in ((self.down, choice.down), (self.across, choice.across), (self.over, choice.over)):
            combo.setCurrentIndex(AXES.index(axis))
        if isinstance(picture.drawing, HeatMap):
            self.heat_view.show_map(picture.drawing)
        else:
            self.chart_view.show_chart(picture.drawing)

    def _offer(self, combo: QComboBox, figures: Sequence[str]) -> None:
        """Offer the figures that any row has, and keep the chosen one if it is among them."""
        if [combo.itemData(at) for at in range(combo.count())] == list(figures):
            return
        chosen = combo.currentData()
        with QSignalBlocker(combo):
            combo.clear()
            for figure in figures:
                combo.addItem(figure_titles()[figure], figure)
            combo.setCurrentIndex(max(combo.findData(chosen), 0))

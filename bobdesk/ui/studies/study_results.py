"""The right side of the study: its rows as a table, a table of colours and curves."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QRectF, QSignalBlocker, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QPainter, QPalette
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

from bobdesk.track.study_pivot import AXES, Row, figures_in, is_failed, value_of, varied
from bobdesk.ui.desk import Desk
from bobdesk.ui.plots.chart import draw_chart
from bobdesk.ui.plots.chart_view import ChartView, HeatMapView
from bobdesk.ui.plots.heat_map import HeatMapLayout
from bobdesk.ui.plots.study_drawings import axis_titles, chart, figure_titles, heat_map
from bobdesk.ui.studies.rows_table import RowsModel, RowsTable
from bobdesk.ui.studies.study_columns import study_columns
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

        draw: Callable[[QPainter], object]
        with on_paper():
            if self.pages.currentWidget() is self._heat_page:
                figure = self.figure.currentData()
                made = heat_map(self._rows, *self._axes(), figure, title=figure_titles()[figure])
                laid_out = HeatMapLayout(made, picture_font())
                return picture_bytes(laid_out.draw, laid_out.size, kind, sharpness=_SHARPNESS)
            figure = self.curve_figure.currentData()
            drawn = chart(self._rows, self.over.currentData(), figure, title="")
            area = QRectF(0, 0, _CHART_SIZE.width(), _CHART_SIZE.height())
            draw = lambda painter: draw_chart(painter, area, drawn)  # noqa: E731
            return picture_bytes(draw, _CHART_SIZE, kind, sharpness=_SHARPNESS)

    def _axes(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        down, across = self.down.currentData(), self.across.currentData()
        return (down,), () if across == down else (across,)

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
        row = QHBoxLayout()
        row.setSpacing(6)
        for text, combo in fields:
            label = QLabel(text, page)
            label.setBuddy(combo)
            row.addWidget(label)
            row.addWidget(combo)
            row.addSpacing(8)
        row.addStretch(1)
        column = QVBoxLayout(page)
        column.addLayout(row)
        column.addWidget(picture, 1)
        return page

    def _connect(self) -> None:
        for combo in (self.figure, self.down, self.across, self.curve_figure, self.over):
            combo.activated.connect(self._on_combo)
        self.pages.currentChanged.connect(self._on_page)
        self._desk.quantities.changed.connect(self._on_units)

    def _on_combo(self) -> None:
        self._axes_chosen = True
        self._draw()

    def _on_page(self) -> None:
        self._draw()
        self.page_changed.emit()

    def _on_units(self) -> None:
        self.model.refresh()
        self.table.fit_columns()

    def _later(self) -> None:
        if not self._clock.isActive():
            self._clock.start()

    def _draw(self) -> None:
        self._clock.stop()
        if not self._rows:
            self.heat_view.show_map(None)
            self.chart_view.show_chart(None)
            return
        self._offer_figures()
        if not self._axes_chosen:
            self._choose_axes()
        if self.pages.currentWidget() is self._heat_page:
            figure = self.figure.currentData()
            self.heat_view.show_map(heat_map(self._rows, *self._axes(), figure, title=""))
        elif self.pages.currentWidget() is self._curves_page:
            figure = self.curve_figure.currentData()
            self.chart_view.show_chart(chart(self._rows, self.over.currentData(), figure, title=""))

    def _offer_figures(self) -> None:
        """Offer the figures that any row has, and keep the chosen one if it is among them."""
        there = figures_in(self._rows) or tuple(figure_titles())
        for combo in (self.figure, self.curve_figure):
            if [combo.itemData(at) for at in range(combo.count())] == list(there):
                continue
            chosen = combo.currentData()
            with QSignalBlocker(combo):
                combo.clear()
                for figure in there:
                    combo.addItem(figure_titles()[figure], figure)
                combo.setCurrentIndex(max(combo.findData(chosen), 0))

    def _choose_axes(self) -> None:
        """Show what is varied, until the user chooses."""
        there = varied(self._rows)
        order = [axis for axis in ("segments", "plan", "known", "height_weight") if axis in there]
        down = order[0] if order else "segments"
        across = "method" if "method" in there else next((axis for axis in order if axis != down), "method")
        over = next((axis for axis in ("segments", "height_weight", "known", "plan") if axis in there), "segments")
        for combo, axis in ((self.down, down), (self.across, across), (self.over, over)):
            combo.setCurrentIndex(AXES.index(axis))

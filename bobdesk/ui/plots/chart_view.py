"""A chart, or a table of colours, on the screen."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QPoint, QRectF, QSize
from PySide6.QtGui import QHelpEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from bobdesk.ui.plots.chart import Chart, draw_chart
from bobdesk.ui.plots.heat_map import HeatMap, HeatMapLayout


class ChartView(QWidget):
    """Draws a chart as large as it is itself."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(name)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(240, 140)
        self.chart: Chart | None = None

    def sizeHint(self) -> QSize:
        """Ask for room to read it."""
        return QSize(640, 300)

    def show_chart(self, chart: Chart | None) -> None:
        """Draw another chart, or none."""
        self.chart = chart
        if chart is not None:
            self.setAccessibleDescription(", ".join([chart.y_label, *(each.name for each in chart.series)]))
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw the chart."""
        if self.chart is not None:
            painter = QPainter(self)
            painter.setFont(self.font())
            draw_chart(painter, QRectF(self.rect()), self.chart)
            painter.end()


class HeatMapView(QWidget):
    """Draws a table of colours; it is as large as that needs, and stands in a scroll area."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(name)
        self.laid_out: HeatMapLayout | None = None

    def show_map(self, heat_map: HeatMap | None) -> None:
        """Draw another table, or none."""
        self.laid_out = None if heat_map is None else HeatMapLayout(heat_map, self.font())
        self.setFixedSize(QSize(1, 1) if self.laid_out is None else self.laid_out.size)
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw the table."""
        if self.laid_out is not None:
            painter = QPainter(self)
            self.laid_out.draw(painter)
            painter.end()

    def event(self, event: QEvent) -> bool:
        """Say what is known of the cell under the mouse."""
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            tip = self.tip_at(event.pos())
            if tip:
                QToolTip.showText(event.globalPos(), tip, self)
            else:
                QToolTip.hideText()
            return True
        return super().event(event)

    def tip_at(self, point: QPoint) -> str:
        """Return what is said of the cell at a point."""
        if self.laid_out is None:
            return ""
        at = self.laid_out.cell_at(point)
        if at is None:
            return ""
        of = self.laid_out.map
        cell = of.cells[at]
        place = ", ".join(part for part in (of.down[at[0]], *of.across[at[1]]) if part)
        return "\n".join(part for part in (f"{place}: {cell.text}", cell.tip) if part)

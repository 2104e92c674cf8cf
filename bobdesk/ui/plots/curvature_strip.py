"""Curvature by station while the smoothing is being set: the fitted curve, the raw one faint behind it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from PySide6.QtCore import QEvent, QTimer
from PySide6.QtGui import QColor, QShowEvent
from PySide6.QtWidgets import QLabel, QStackedLayout, QWidget

from bobdesk.alignment.fit_settings import FitSettings
from bobdesk.arrays import FloatArray
from bobdesk.project import derive
from bobdesk.project.project import Project
from bobdesk.ui.derived import centreline_later, line_inputs, same_inputs
from bobdesk.ui.desk import Desk
from bobdesk.ui.newest import Newest
from bobdesk.ui.plots.decimated import decimated
from bobdesk.ui.plots.locale_axis import locale_axis
from bobdesk.ui.theme import colours

_DEBOUNCE_MS = 150
_HEIGHT = 150
# The raw curve may run out of the plot; the fitted one decides what is seen.
_ROOM = 1.25
_SMALLEST_RANGE = 1e-3
_FAINT = 110


@dataclass(frozen=True, eq=False)
class _Curves:
    stations: FloatArray
    fitted: FloatArray
    raw_stations: FloatArray
    raw: FloatArray


class CurvatureStrip(QWidget):
    """Follows the document, and a draft of the fit while one is being tried."""

    def __init__(self, desk: Desk, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._draft: FitSettings | None = None
        self._drawn_for: tuple[object, ...] | None = None
        self._asked = False
        self._curves: _Curves | None = None
        self._plot: Any = None
        self.setFixedHeight(_HEIGHT)
        self.setAccessibleName(self.tr("Curvature by station"))
        self.setToolTip(
            self.tr("Curvature of the centreline, left positive; the faint line is the curvature before smoothing")
        )
        self._stack = QStackedLayout(self)
        self._message = QLabel(self)
        self._message.setProperty("kind", "muted")
        self._message.setWordWrap(True)
        self._stack.addWidget(self._message)
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(_DEBOUNCE_MS)
        self._timer.timeout.connect(self._ask)
        self._newest = Newest(desk.runner, self.tr("Curvature"), self)
        self._newest.answered.connect(self._on_answered)
        self._newest.failed.connect(self._on_failed)
        # Once the centreline is there the curvature is nearly free; asked before, both would fit it.
        self._line = centreline_later(desk)
        self._line.changed.connect(self._on_line)
        desk.quantities.changed.connect(self._draw)

    @property
    def is_up_to_date(self) -> bool:
        """Whether nothing is still to be drawn."""
        return not (self._timer.isActive() or self._newest.is_busy)

    @property
    def curve(self) -> tuple[FloatArray, FloatArray] | None:
        """Stations, m, and fitted curvature, 1/m, as they are drawn."""
        return None if self._curves is None else (self._curves.stations, self._curves.fitted)

    def try_out(self, draft: FitSettings | None) -> None:
        """Show the curvature for other settings than the document's; None goes back to those."""
        if draft != self._draft:
            self._draft = draft
            self._later()

    def showEvent(self, event: QShowEvent) -> None:
        """Make up for what was not drawn while hidden."""
        super().showEvent(event)
        self._later()

    def changeEvent(self, event: QEvent) -> None:
        """Take the colours of another palette."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self._plot is not None:
            self._style()
            self._draw()

    def _on_line(self) -> None:
        if self._line.is_current:
            self._later()

    def _later(self) -> None:
        if self.isVisible() and not (self._asked and same_inputs(self._wanted(), self._drawn_for)):
            self._timer.start()

    def _wanted(self) -> tuple[object, ...] | None:
        project = self._desk.session.project
        inputs = line_inputs(project)
        return None if inputs is None else (*inputs, self._draft)

    def _ask(self) -> None:
        project = self._desk.session.project
        self._drawn_for, self._asked = self._wanted(), True
        if self._drawn_for is None:
            self._newest.drop()
            self._on_failed(self.tr("The curvature is shown here once there is a line."))
            return
        fit = self._draft or project.fit
        self._newest.ask(lambda: _curves(project, fit))

    def _on_answered(self, found: object) -> None:
        assert isinstance(found, _Curves)
        self._curves = found
        if self._plot is None:
            self._make_plot()
        self._stack.setCurrentWidget(self._plot)
        self._draw()

    def _on_failed(self, sentence: str) -> None:
        self._curves = None
        self._message.setText(sentence[:1].upper() + sentence[1:])
        self._stack.setCurrentWidget(self._message)

    def _make_plot(self) -> None:
        import pyqtgraph

        self._plot = pyqtgraph.PlotWidget(self, axisItems={side: locale_axis(side) for side in ("left", "bottom")})
        self._plot.setMenuEnabled(False)
        self._plot.setMouseEnabled(x=False, y=False)
        self._plot.hideButtons()
        self._plot.setFrameShape(self._plot.Shape.NoFrame)
        for shown in (self._plot, self._plot.viewport()):
            shown.setFocusPolicy(self.focusPolicy())
            shown.setAccessibleName(self.accessibleName())
        self._zero = pyqtgraph.InfiniteLine(pos=0, angle=0, movable=False)
        self._plot.addItem(self._zero)
        self._raw = self._plot.plot(antialias=True)
        self._fitted = self._plot.plot(antialias=True)
        self._stack.addWidget(self._plot)
        self._style()

    def _style(self) -> None:
        import pyqtgraph

        of = colours()
        self._plot.setBackground(of.base)
        self._zero.setPen(pyqtgraph.mkPen(of.grid, width=1))
        faint = QColor(of.muted)
        faint.setAlpha(_FAINT)
        self._raw.setPen(pyqtgraph.mkPen(faint, width=1))
        self._fitted.setPen(pyqtgraph.mkPen(of.accent, width=1))
        for side in ("left", "bottom"):
            axis = self._plot.getAxis(side)
            axis.setPen(pyqtgraph.mkPen(of.border, width=1))
            axis.setTextPen(pyqtgraph.mkPen(of.muted))
            axis.enableAutoSIPrefix(False)
            axis.setStyle(tickLength=-4, autoExpandTextSpace=True)

    def _draw(self) -> None:
        curves = self._curves
        if curves is None or self._plot is None:
            return
        unit = self._desk.quantities
        along, bend = unit.length_factor, 1 / unit.length_factor
        self._raw.setData(along * curves.raw_stations, bend * curves.raw)
        self._fitted.setData(along * curves.stations, bend * curves.fitted)
        of = colours()
        style = {"color": of.muted, "font-size": "8pt"}
        self._plot.setLabel("left", self.tr("Curvature") + f" 1/{unit.length_unit}", **style)
        self._plot.setLabel("bottom", self.tr("Station") + f" {unit.length_unit}", **style)
        highest = _ROOM * max(_SMALLEST_RANGE, float(np.abs(curves.fitted).max())) * bend
        self._plot.setXRange(0.0, along * float(curves.stations[-1]), padding=0.01)
        self._plot.setYRange(-highest, highest, padding=0)


def _curves(project: Project, fit: FitSettings) -> _Curves:
    """Return what is drawn; called on a thread."""
    from bobdesk.alignment.centreline import fit_centreline
    from bobdesk.alignment.curvature import curvature, curvature_by_differences

    line = fit_centreline(derive.working_polyline(project).needed(), fit)
    raw = curvature_by_differences(line.raw_points)
    return _Curves(*decimated(line.stations, curvature(line)), *decimated(line.stations, raw))

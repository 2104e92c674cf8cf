"""One picture of a result: plan, gradient and elevation by station, as PNG, SVG or PDF."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.solve.envelope import Envelope
from bobdesk.solve.targets import Targets
from bobdesk.track.centreline3d import Centreline3D
from bobdesk.ui.plots import palette
from bobdesk.ui.qt import application_without_screen

_SIZE = (1500, 1250)
_DPI = 96
_MOST_POINTS = 4000


def draw_line(line: Centreline3D, band: Envelope | None, targets: Targets, *, title: str, kind: str) -> bytes:
    """Draw a line and return the bytes of the picture.

    Parameters
    ----------
    line
        The 3D centreline.
    band
        The envelope behind the elevation, or None.
    targets
        For limits and known elevations.
    title
        Stands above the plan.
    kind
        ".png", ".svg" or ".pdf".

    Raises
    ------
    InputError
        If Qt cannot start.
    """
    application = application_without_screen()
    os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")
    import pyqtgraph as pg
    from PySide6.QtCore import Qt

    view = pg.GraphicsLayoutWidget(size=_SIZE)
    view.setBackground(palette.PAPER)
    layout = view.ci.layout
    layout.setRowStretchFactor(0, 5)
    layout.setRowStretchFactor(1, 2)
    layout.setRowStretchFactor(2, 3)
    _plan(view, line, title)
    gradient = _gradient(view, line, targets)
    elevation = _elevation(view, line, band, targets)
    elevation.setXLink(gradient)
    gradient.setXRange(0.0, float(line.stations[-1]), padding=0.02)
    view.setAttribute(Qt.WidgetAttribute.WA_DontShowOnScreen)
    view.show()
    application.processEvents()
    return _rendered(view, kind)


def _plan(view: Any, line: Centreline3D, title: str) -> None:
    import pyqtgraph as pg

    plot = view.addPlot(row=0, col=0, title=title)
    _style(plot, "x (m)", "y", "m")
    plot.setAspectLocked(True)
    x, y = line.points[:, 0], line.points[:, 1]
    # A straight is a thin line, a curve a thicker one: told apart without colour too.
    for kind, colour, width in (("straight", palette.STRAIGHT, 2), ("curve", palette.CURVE, 4)):
        path = _pieces(line, kind)
        plot.plot(*path.T, antialias=True, pen=pg.mkPen(colour, width=width), connect="finite", name=kind)
    for at, name, symbol in ((0, "Start", "o"), (-1, "Finish", "s")):
        plot.plot(x[[at]], y[[at]], pen=None, symbol=symbol, symbolSize=12, symbolBrush=palette.INK, symbolPen=None)
        label = pg.TextItem(name, color=palette.INK, anchor=(-0.15, 0.5))
        label.setPos(float(x[at]), float(y[at]))
        plot.addItem(label)
    legend = plot.addLegend(offset=(10, 10), labelTextColor=palette.INK)
    for item in plot.listDataItems()[:2]:
        legend.addItem(item, item.name())


def _pieces(line: Centreline3D, kind: str) -> FloatArray:
    """Return the points of all segments of a kind, (n, 2), with NaN between them.

    Points that a path only skips would be dots of its colour in an SVG.
    """
    pieces: list[FloatArray] = [np.full((1, 2), np.nan)]
    for index, segment in enumerate(line.segments):
        rows = np.flatnonzero(line.segment_of == index)
        if segment.kind == kind and len(rows):
            pieces += [line.points[rows[0] : rows[-1] + 2, :2], pieces[0]]
    return np.concatenate(pieces[1:]) if len(pieces) > 1 else pieces[0]


def _gradient(view: Any, line: Centreline3D, targets: Targets) -> Any:
    import pyqtgraph as pg

    plot = view.addPlot(row=1, col=0)
    _style(plot, "", "gradient", "%")
    _shade_curves(plot, line)
    thin = _thinned(len(line.stations))
    plot.plot(line.stations[thin], 100 * line.gradients[thin], antialias=True, pen=pg.mkPen(palette.PROFILE, width=2))
    largest, smallest = float(line.gradients.max()), float(line.gradients.min())
    for limit in (targets.min_gradient, targets.max_gradient):
        if smallest - 0.03 <= limit <= largest + 0.03:
            plot.addLine(y=100 * limit, pen=pg.mkPen(palette.LIMIT, style=pg.QtCore.Qt.PenStyle.DashLine))
    plot.addLine(y=0, pen=pg.mkPen(palette.FAINT))
    return plot


def _elevation(view: Any, line: Centreline3D, band: Envelope | None, targets: Targets) -> Any:
    import pyqtgraph as pg

    plot = view.addPlot(row=2, col=0)
    _style(plot, "station (m)", "elevation", "m")
    _shade_curves(plot, line)
    thin = _thinned(len(line.stations))
    if band is not None:
        thin_band = _thinned(len(band.stations))
        edges = [
            pg.PlotDataItem(band.stations[thin_band], edge[thin_band], pen=pg.mkPen(palette.BAND, width=1))
            for edge in (band.lowest, np.minimum(band.highest, 1.15 * targets.drop))
        ]
        plot.addItem(pg.FillBetweenItem(*edges, brush=pg.mkBrush(*palette.BAND_SHADE)))
    plot.plot(line.stations[thin], line.elevations[thin], antialias=True, pen=pg.mkPen(palette.PROFILE, width=3))
    legend = plot.addLegend(offset=(-10, 10), labelTextColor=palette.INK)
    legend.addItem(plot.listDataItems()[-1], "profile")
    if band is not None:
        broad = pg.mkPen((*palette.BAND_SHADE[:3], 90), width=9)
        legend.addItem(pg.PlotDataItem(pen=broad), "all that limits and known elevations allow")
    if targets.known:
        plot.plot(
            [known.station for known in targets.known],
            [known.elevation for known in targets.known],
            pen=None,
            symbol="d",
            symbolSize=13,
            symbolBrush=palette.PAPER,
            symbolPen=pg.mkPen(palette.KNOWN, width=2),
        )
        legend.addItem(plot.listDataItems()[-1], "known elevation")
    return plot


def _style(plot: Any, below: str, left: str, unit: str) -> None:
    import pyqtgraph as pg

    plot.showGrid(x=True, y=True, alpha=0.15)
    for side, text in (("bottom", below), ("left", f"{left} ({unit})")):
        axis = plot.getAxis(side)
        axis.enableAutoSIPrefix(False)
        axis.setPen(pg.mkPen(palette.FAINT))
        axis.setTextPen(pg.mkPen(palette.INK))
        if text:
            axis.setLabel(text, color=palette.INK)
    plot.getAxis("left").setWidth(62)
    plot.titleLabel.setAttr("color", palette.INK)
    if plot.titleLabel.text:
        plot.setTitle(plot.titleLabel.text, color=palette.INK, size="13pt")


def _shade_curves(plot: Any, line: Centreline3D) -> None:
    import pyqtgraph as pg

    for segment in line.segments:
        if segment.kind == "curve":
            region = pg.LinearRegionItem(
                (segment.start, segment.end), movable=False, brush=palette.CURVE_SHADE, pen=pg.mkPen(None)
            )
            region.setZValue(-10)
            plot.addItem(region)


def _thinned(count: int) -> slice:
    """Return a slice that leaves a few thousand points: what a picture can show."""
    return slice(None, None, max(1, count // _MOST_POINTS))


def _rendered(view: Any, kind: str) -> bytes:
    from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QRectF, QSize, QSizeF
    from PySide6.QtGui import QImage, QPageSize, QPainter, QPdfWriter
    from PySide6.QtSvg import QSvgGenerator

    content = QByteArray()
    buffer = QBuffer(content)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    width, height = _SIZE
    device: Any
    if kind == ".svg":
        device = QSvgGenerator()
        # Axes are recorded at the screen's resolution; at another one they would come out smaller.
        device.setResolution(_DPI)
        device.setOutputDevice(buffer)
        device.setSize(QSize(width, height))
        device.setViewBox(QRectF(0, 0, width, height))
    elif kind == ".pdf":
        device = QPdfWriter(buffer)
        device.setResolution(_DPI)
        size = QSizeF(72 * width / _DPI, 72 * height / _DPI)
        device.setPageSize(QPageSize(size, QPageSize.Unit.Point))
        device.setPageMargins(QMarginsF(0, 0, 0, 0))
    else:
        device = QImage(width, height, QImage.Format.Format_RGB32)
        device.fill(0xFFFFFFFF)
    painter = QPainter(device)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    view.render(painter, QRectF(0, 0, width, height), view.rect())
    painter.end()
    if kind == ".png":
        device.save(buffer, "PNG")
    buffer.close()
    view.close()
    return bytes(content.data())

"""A strip as a picture or as a table of numbers."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QRectF, QSize
from PySide6.QtGui import QImage, QImageWriter, QPainter
from PySide6.QtSvg import QSvgGenerator

from bobdesk.files.exporters.csv_flavours import FLAVOURS, to_csv
from bobdesk.ui.strips.contents import shade
from bobdesk.ui.strips.strip import Strip

_SHARPNESS = 2.0


def strip_png(strip: Strip) -> bytes:
    """Return the strip as it is shown, at twice its resolution."""
    width, height = strip.width(), strip.height()
    image = QImage(round(_SHARPNESS * width), round(_SHARPNESS * height), QImage.Format.Format_ARGB32_Premultiplied)
    image.setDevicePixelRatio(_SHARPNESS)
    image.fill(shade("base"))
    painter = QPainter(image)
    strip.draw(painter, width, height)
    painter.end()
    content = QByteArray()
    buffer = QBuffer(content)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    QImageWriter(buffer, QByteArray(b"png")).write(image)
    buffer.close()
    return bytes(content.data())


def strip_svg(strip: Strip) -> bytes:
    """Return the strip as it is shown, as lines and text."""
    width, height = strip.width(), strip.height()
    content = QByteArray()
    buffer = QBuffer(content)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    device = QSvgGenerator()
    device.setResolution(96)
    device.setOutputDevice(buffer)
    device.setSize(QSize(width, height))
    device.setViewBox(QRectF(0, 0, width, height))
    device.setTitle(strip.title)
    painter = QPainter(device)
    strip.draw(painter, width, height)
    painter.end()
    buffer.close()
    return bytes(content.data())


def strip_csv(strip: Strip) -> bytes:
    """Return all values of the curves, in SI, over the stations of the first one."""
    curves = [curve for curve in strip.curves.values() if curve.column]
    if not curves:
        return to_csv(("station_m",), [], FLAVOURS["default"])
    stations = curves[0].stations
    columns = [stations, *(np.interp(stations, curve.stations, curve.values) for curve in curves)]
    rows = [[f"{row[0]:.4f}", *(f"{value:.9g}" for value in row[1:])] for row in np.column_stack(columns).tolist()]
    return to_csv(("station_m", *(curve.column for curve in curves)), rows, FLAVOURS["default"])

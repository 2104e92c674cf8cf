"""The result in space as a file."""

from __future__ import annotations

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QRectF, QSize, QSizeF
from PySide6.QtGui import QImage, QPageSize, QPainter, QPdfWriter
from PySide6.QtSvg import QSvgGenerator

from bobdesk.ui.view3d.camera import Camera
from bobdesk.ui.view3d.scene import Scene, draw, with_floor

SIZE = (900, 500)
_DPI = 96


def scene_image(scene: Scene, camera: Camera, width: int, height: int, *, ratio: float = 1.0) -> QImage:
    """Return a picture of so many points, finer by `ratio`."""
    image = QImage(round(width * ratio), round(height * ratio), QImage.Format.Format_RGB32)
    image.setDevicePixelRatio(ratio)
    image.fill(0xFFFFFFFF)
    painter = QPainter(image)
    draw(painter, scene, camera, QRectF(0, 0, width, height))
    painter.end()
    return image


def scene_file(scene: Scene, camera: Camera, width: int, height: int, kind: str) -> bytes:
    """Return the bytes of a file; `kind` is .png, .svg or .pdf."""
    content = QByteArray()
    buffer = QBuffer(content)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    if kind == ".png":
        scene_image(scene, camera, width, height, ratio=2.0).save(buffer, "PNG")  # type: ignore[call-overload]
        buffer.close()
        return bytes(content.data())
    device: QSvgGenerator | QPdfWriter
    if kind == ".svg":
        device = QSvgGenerator()
        device.setResolution(_DPI)
        device.setOutputDevice(buffer)
        device.setSize(QSize(width, height))
        device.setViewBox(QRectF(0, 0, width, height))
    else:
        device = QPdfWriter(buffer)
        device.setResolution(_DPI)
        device.setPageSize(QPageSize(QSizeF(72 * width / _DPI, 72 * height / _DPI), QPageSize.Unit.Point))
        device.setPageMargins(QMarginsF(0, 0, 0, 0))
    painter = QPainter(device)
    draw(painter, scene, camera, QRectF(0, 0, width, height))
    painter.end()
    buffer.close()
    return bytes(content.data())


def fitted_picture(scene: Scene) -> bytes:
    """Return a PNG that shows everything."""
    camera = Camera().fitted(with_floor(scene), SIZE[0], SIZE[1] - 90)
    return scene_file(scene, camera, *SIZE, ".png")

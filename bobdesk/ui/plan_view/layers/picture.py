"""The plan's picture: of the halving copies the one that is nearest to the screen's resolution."""

from __future__ import annotations

import math
from collections.abc import Callable

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter

from bobdesk.progress import Progress
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_picture import DecodedPicture
from bobdesk.ui.plan_view.layers.layer import Layer
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.strokes import pen
from bobdesk.ui.runner import Job
from bobdesk.ui.theme import colours

# From this magnification on the picture's own pixels are shown as squares.
_PIXELS_SHOW = 3.0


_Seen = tuple[Frame, float, DecodedPicture, float, str]


class PictureLayer(Layer):
    """Draws the picture; while it is not ready its outline and how far the reading is."""

    name = "picture"

    def __init__(self, desk: Desk, frame: Callable[[], Frame]) -> None:
        super().__init__(desk, frame)
        self.strength = 1.0
        self._seen: _Seen | None = None
        self._still: QImage | None = None
        self._job: Job | None = None
        self._progress: Progress | None = None
        desk.picture.changed.connect(self._on_picture)
        self._on_picture()

    def concerns(self, before: Project, after: Project) -> bool:
        """Return whether there is another picture."""
        return before.picture is not after.picture

    def draw(self, painter: QPainter, frame: Frame) -> None:
        """Paint the picture, or what stands in for it."""
        decoded = self.desk.picture.decoded
        if decoded is not None:
            self._draw_decoded(painter, frame, decoded)
        elif self.desk.session.project.picture is not None:
            self._draw_instead(painter, frame)

    def _draw_decoded(self, painter: QPainter, frame: Frame, decoded: DecodedPicture) -> None:
        """Draw the picture; from the second frame on at the same place, as it was drawn before.

        While something is placed or dragged the picture stands still, and scaling it again would be the most
        expensive part of the frame.
        """
        ratio = painter.device().devicePixelRatioF()
        seen = (frame, ratio, decoded, self.strength, colours().canvas)
        if seen == self._seen:
            if self._still is None:
                self._still = _still(seen)
            painter.drawImage(0, 0, self._still)
            return
        if frame == self._frame():
            self._seen, self._still = seen, None
        painter.setOpacity(self.strength)
        draw_picture(painter, decoded.levels, frame)

    def _draw_instead(self, painter: QPainter, frame: Frame) -> None:
        of = colours()
        outline = _outline(self.desk.session.project.picture, frame)
        problem = self.desk.picture.problem
        if outline is not None:
            painter.fillRect(outline, QColor(of.paper))
            painter.setPen(pen(of.border, 1.0))
            painter.drawRect(outline)
        view = QRectF(0, 0, frame.width, frame.height)
        inside = view if outline is None else outline.intersected(view)
        if problem is not None:
            text = problem
        elif self._progress is not None:
            text = f"{self._progress.doing} … {round(100 * self._progress.fraction)} %"
        else:
            text = self.tr("Reading the picture …")
        flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
        inside = inside if inside.width() > 120 and inside.height() > 40 else view
        inside = inside.adjusted(16, 8, -16, -8)
        needed = painter.boundingRect(inside, int(flags), text).adjusted(-14, -10, 14, 10)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(pen(of.error if problem else of.border, 1.0))
        painter.setBrush(QColor(of.base))
        painter.drawRoundedRect(needed, 5, 5)
        painter.setPen(QColor(of.error if problem else of.text))
        painter.drawText(needed, int(flags), text)

    def _on_picture(self) -> None:
        job = self.desk.picture.job
        if job is not self._job:
            self._job, self._progress = job, None
            if job is not None:
                job.progressed.connect(self._on_progress)
        self._seen, self._still = None, None
        self.update()

    def _on_progress(self, progress: Progress) -> None:
        self._progress = progress
        self.update()


def _still(seen: _Seen) -> QImage:
    """Return the view with canvas and picture and nothing else."""
    frame, ratio, decoded, strength, canvas = seen
    image = QImage(math.ceil(frame.width * ratio), math.ceil(frame.height * ratio), QImage.Format.Format_RGB32)
    image.setDevicePixelRatio(ratio)
    image.fill(QColor(canvas))
    painter = QPainter(image)
    painter.setOpacity(strength)
    draw_picture(painter, decoded.levels, frame)
    painter.end()
    return image


def _outline(picture: object, frame: Frame) -> QRectF | None:
    size = getattr(picture, "size_px", None)
    if size is None:
        return None
    return QRectF(frame.point((-0.5, -0.5)), frame.point((size[0] - 0.5, size[1] - 0.5)))


def draw_picture(painter: QPainter, levels: tuple[QImage, ...], frame: Frame) -> None:
    """Draw what is in view of a picture given at full, half, quarter … size, with screen pixels' painter."""
    device = frame.scale * painter.device().devicePixelRatioF()
    index = min(max(0, math.floor(math.log2(1.0 / device) + 0.25)), len(levels) - 1) if device < 1 else 0
    level, factor = levels[index], float(2**index)
    first_x = max(0, math.floor(((0 - frame.left) / frame.scale + 0.5) / factor))
    first_y = max(0, math.floor(((0 - frame.top) / frame.scale + 0.5) / factor))
    last_x = min(level.width(), math.ceil(((frame.width - frame.left) / frame.scale + 0.5) / factor))
    last_y = min(level.height(), math.ceil(((frame.height - frame.top) / frame.scale + 0.5) / factor))
    if last_x <= first_x or last_y <= first_y:
        return
    source = QRectF(first_x, first_y, last_x - first_x, last_y - first_y)
    target = QRectF(
        frame.point((first_x * factor - 0.5, first_y * factor - 0.5)),
        frame.point((last_x * factor - 0.5, last_y * factor - 0.5)),
    )
    painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, device < _PIXELS_SHOW)
    painter.drawImage(target, level, source)

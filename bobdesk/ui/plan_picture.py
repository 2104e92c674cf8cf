"""The document's picture as pixels: decoded in the background whenever another one is shown."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QImage

from bobdesk.files.picture_process import decode_in_process
from bobdesk.plan.image import Pixels, PlanImage
from bobdesk.plan.raster import halving_pyramid
from bobdesk.progress import Progress
from bobdesk.project.project import Picture, Project
from bobdesk.ui.runner import Job, Runner
from bobdesk.ui.session import Session

_KEPT = 2
_DECODING = 0.8


@dataclass(frozen=True, eq=False)
class DecodedPicture:
    """A picture's pixels, and smaller copies of it for the screen.

    Attributes
    ----------
    image
        All pixels.
    levels
        The picture for the screen at full size, half size, a quarter …; they share memory with `arrays`.
    arrays
        Keeps the memory of `levels` alive.
    """

    image: PlanImage
    levels: tuple[QImage, ...]
    arrays: tuple[object, ...]


def decoded_picture_steps(picture: Picture) -> Generator[Progress, None, DecodedPicture]:
    """Decode a picture and make its smaller copies.

    Raises
    ------
    InputError
        If it cannot be decoded.
    """
    job = decode_in_process(picture.data, name=picture.name, page=picture.page, dpi=picture.dpi, world=None)
    while True:
        try:
            step = next(job)
        except StopIteration as end:
            image: PlanImage = end.value
            break
        yield Progress(_DECODING * step.fraction, step.doing)
    return (yield from with_levels_steps(image))


def with_levels_steps(image: PlanImage) -> Generator[Progress, None, DecodedPicture]:
    """Make the smaller copies of a decoded picture."""
    smaller = halving_pyramid(image.pixels)
    while True:
        try:
            fraction = next(smaller)
        except StopIteration as end:
            arrays: tuple[Pixels, ...] = end.value
            break
        yield Progress(_DECODING + (1 - _DECODING) * fraction, "Preparing the picture for the screen")
    pairs = [qimage(array) for array in arrays]
    return DecodedPicture(image, tuple(pair[0] for pair in pairs), tuple(pair[1] for pair in pairs))


def qimage(pixels: Pixels) -> tuple[QImage, object]:
    """Return a QImage over the memory of `pixels`, and what must be kept as long as it lives."""
    height, width = pixels.shape[:2]
    if pixels.dtype == np.bool_:
        packed = np.ascontiguousarray(np.packbits(pixels, axis=1))
        image = QImage(packed.data, width, height, packed.strides[0], QImage.Format.Format_Mono)
        image.setColorTable([0xFF000000, 0xFFFFFFFF])
        return image, packed
    whole = np.ascontiguousarray(pixels)
    kind = QImage.Format.Format_Grayscale8 if whole.ndim == 2 else QImage.Format.Format_RGB888
    return QImage(whole.data, width, height, whole.strides[0], kind), whole


class PlanPicture(QObject):
    """Follows the document.

    Signals
    -------
    changed
        Another picture, or it became ready, or it cannot be shown.
    """

    changed = Signal()

    def __init__(self, session: Session, runner: Runner, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._runner = runner
        self._kept: list[tuple[Picture, DecodedPicture]] = []
        self._decoded: DecodedPicture | None = None
        self._problem: str | None = None
        self._job: Job | None = None
        self._wanted: Picture | None = None
        session.changed.connect(self._on_changed)

    @property
    def decoded(self) -> DecodedPicture | None:
        """The picture, or None while it is not ready."""
        return self._decoded

    @property
    def image(self) -> PlanImage | None:
        """All pixels, or None while they are not ready."""
        return None if self._decoded is None else self._decoded.image

    @property
    def problem(self) -> str | None:
        """Why the picture cannot be shown."""
        return self._problem

    @property
    def job(self) -> Job | None:
        """The decoding that is under way."""
        return self._job

    def keep(self, picture: Picture, decoded: DecodedPicture) -> None:
        """Remember what was decoded already, before the picture becomes the document's."""
        self._kept = [(picture, decoded), *self._kept[: _KEPT - 1]]

    def _on_changed(self, _before: Project, after: Project) -> None:
        if after.picture is self._wanted:
            return
        if self._job is not None:
            self._job.stop()
            self._job = None
        self._wanted = after.picture
        self._decoded, self._problem = None, None
        if self._wanted is not None:
            self._decoded = self._remembered(self._wanted)
            if self._decoded is None:
                self._begin(self._wanted)
        self.changed.emit()

    def _remembered(self, picture: Picture) -> DecodedPicture | None:
        for known, decoded in self._kept:
            if known.data is picture.data and (known.page, known.dpi) == (picture.page, picture.dpi):
                return decoded
        return None

    def _begin(self, picture: Picture) -> None:
        def done(decoded: DecodedPicture) -> None:
            self.keep(picture, decoded)
            if picture is self._wanted:
                self._decoded, self._job = decoded, None
                self.changed.emit()

        def failed(sentence: str) -> None:
            if picture is self._wanted:
                self._problem, self._job = sentence, None
                self.changed.emit()

        self._job = self._runner.start(
            self.tr("Reading the picture"),
            lambda: decoded_picture_steps(picture),
            done=done,
            failed=failed,
            stopped=lambda: failed(self.tr("Reading the picture was stopped; open the project again to see it.")),
        )

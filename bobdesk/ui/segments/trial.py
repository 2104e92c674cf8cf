"""Something about segments that is tried in the background first, and done only if it works and still fits."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, Signal

from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.newest import Newest


class Trial(QObject):
    """One at a time: a newer one takes the place of one that is under way.

    Signals
    -------
    failed
        Why it does not work.
    """

    failed = Signal(str)

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._newest = Newest(desk.runner, self.tr("Finding the segments"), self)
        self._newest.answered.connect(self._on_answered)
        self._newest.failed.connect(self._on_failed)
        self._then: Callable[[object], object] | None = None
        self._wanted: SegmentationSettings | None = None

    @property
    def wanted(self) -> SegmentationSettings | None:
        """The settings that are being tried, if it is settings."""
        return self._wanted

    def ask(
        self,
        project: Project,
        function: Callable[[], object],
        then: Callable[[object], object],
        *,
        wanted: SegmentationSettings | None = None,
        lost: Callable[[], object] | None = None,
    ) -> None:
        """Call a function on a thread, and `then` with its answer if the document is still this project, or `lost`."""

        def done(found: object) -> None:
            # What was tried on another document, or another line, is worth nothing.
            if self._desk.session.project is project:
                then(found)
            elif lost is not None:
                lost()

        self._then, self._wanted = done, wanted
        self._newest.ask(function)

    def drop(self) -> None:
        """Forget what is under way."""
        self._newest.drop()
        self._then = self._wanted = None

    def _on_answered(self, found: object) -> None:
        then, self._then, self._wanted = self._then, None, None
        if then is not None:
            then(found)

    def _on_failed(self, sentence: str) -> None:
        self._then = self._wanted = None
        self.failed.emit(sentence)

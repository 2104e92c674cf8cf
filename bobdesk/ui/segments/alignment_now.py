"""Line and segments as every part of the window shows them: those of the document, or of a drag in mid-work."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from bobdesk.alignment.segments import Segments
from bobdesk.project import derive
from bobdesk.project.project import Project
from bobdesk.ui.derived import line_inputs, same_inputs
from bobdesk.ui.desk import Desk
from bobdesk.ui.newest import Newest
from bobdesk.ui.segments.alignment import Alignment, alignment_of

if TYPE_CHECKING:
    from bobdesk.alignment.segment_figures import SegmentFigures

_REMEMBERED = 12


class AlignmentNow(QObject):
    """Follows the document; one of it serves a whole window, so that plan, strips and table cannot disagree.

    Edits of segments on a known line are followed at once; a new line, or settings that were not tried
    before, are worked out in the background.

    Signals
    -------
    changed
        Line, segments or preview are others, or there are none.
    """

    changed = Signal()

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._known: Alignment | None = None
        self._preview: Alignment | None = None
        self._threshold: float | None = None
        self._line_of: tuple[object, ...] | None = None
        self._asked_for: Project | None = None
        self._automatic: list[Alignment] = []
        self._problem: str | None = None
        self._is_current = True
        self._newest = Newest(desk.runner, self.tr("Finding the segments"), self)
        self._newest.answered.connect(self._on_answered)
        self._newest.failed.connect(self._on_failed)
        desk.session.changed.connect(self._on_changed)
        desk.session.document_changed.connect(self._forget)
        self._follow(desk.session.project)

    @property
    def value(self) -> Alignment | None:
        """What is shown: the preview of a drag, or else the document's."""
        return self._preview or self._known

    @property
    def known(self) -> Alignment | None:
        """The document's, without a preview."""
        return self._known

    @property
    def segments(self) -> Segments:
        """The segments that are shown; none before there is a line."""
        return () if self.value is None else self.value.segments

    @property
    def figures(self) -> tuple[SegmentFigures, ...]:
        """The figures of the segments that are shown."""
        return () if self.value is None else self.value.figures

    @property
    def threshold(self) -> float | None:
        """The threshold that is shown, 1/m."""
        if self._threshold is not None:
            return self._threshold
        return None if self._known is None else self._known.threshold

    @property
    def problem(self) -> str | None:
        """Why there are no segments."""
        return self._problem

    @property
    def is_current(self) -> bool:
        """Whether what is known is of the document as it is now."""
        return self._is_current

    @property
    def is_preview(self) -> bool:
        """Whether a drag in mid-work is shown."""
        return self._preview is not None or self._threshold is not None

    @property
    def is_trying_threshold(self) -> bool:
        """Whether a threshold is being dragged."""
        return self._threshold is not None

    def preview(self, segments: Segments | None, *, threshold: float | None = None) -> None:
        """Show other segments without changing the document; None shows the document's again."""
        if segments is None or self._known is None:
            self._preview = None
        else:
            self._preview = self._known.with_segments(segments)
        self._threshold = threshold
        self.changed.emit()

    def _on_changed(self, _before: Project, after: Project) -> None:
        self._follow(after)

    def _follow(self, project: Project) -> None:
        inputs = line_inputs(project)
        self._preview = self._threshold = None
        if inputs is None:
            self._forget()
            return
        if self._is_current and self._known is not None and same_inputs(inputs, self._line_of):
            found = self._at_once(project, self._known)
            if found is not None:
                self._show(found)
                return
        self._line_of = inputs
        self._is_current = False
        self._asked_for = project
        self._newest.ask(lambda: alignment_of(project))
        self.changed.emit()

    def _at_once(self, project: Project, known: Alignment) -> Alignment | None:
        """Return what an edit of segments alone makes of the line, or None if it takes longer."""
        if project.segments is not None and project.segmentation == known.settings:
            return known.with_segments(derive.segments(project).needed())
        if project.segments is not None:
            same = next((one for one in self._automatic if one.settings == project.segmentation), None)
            return None if same is None else same.with_segments(derive.segments(project).needed())
        return next((one for one in self._automatic if one.settings == project.segmentation), None)

    def _on_answered(self, found: object) -> None:
        assert isinstance(found, Alignment)
        project = self._asked_for
        self._asked_for = None
        if self._automatic and self._automatic[-1].line is not found.line:
            self._automatic.clear()
        if project is not None and project.segments is None:
            self._automatic = [*self._automatic[-_REMEMBERED:], found]
        self._show(found)

    def _on_failed(self, sentence: str) -> None:
        self._known, self._preview, self._problem, self._is_current = None, None, sentence, True
        self._asked_for = None
        self.changed.emit()

    def _show(self, found: Alignment) -> None:
        self._known, self._problem, self._is_current = found, None, True
        self.changed.emit()

    def _forget(self) -> None:
        self._newest.drop()
        self._line_of, self._asked_for = None, None
        self._automatic.clear()
        had = self._known is not None or self._problem is not None
        self._known = self._preview = self._threshold = self._problem = None
        self._is_current = True
        if had:
            self.changed.emit()


def alignment_now(desk: Desk) -> AlignmentNow:
    """Return the one follower that all parts of a window share."""
    name = "alignment now"
    found = desk.session.findChild(AlignmentNow, name)
    if found is None:
        found = AlignmentNow(desk, desk.session)
        found.setObjectName(name)
    return found

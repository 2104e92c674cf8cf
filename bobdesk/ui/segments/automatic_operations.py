"""What can be done about segments that are found automatically: settings, detecting again, giving up corrections."""

from __future__ import annotations

from dataclasses import fields, replace

from PySide6.QtCore import QObject

from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segments, is_kept
from bobdesk.errors import InputError
from bobdesk.project import derive, segment_edits
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.notices import Remedy
from bobdesk.ui.segments.alignment import alignment_of
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.segments.operations import operations
from bobdesk.ui.segments.trial import Trial


class AutomaticOperations(QObject):
    """Tries in the background what takes time, and does it if it works."""

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._now = alignment_now(desk)
        self._operations = operations(desk)
        self._trial = Trial(desk, self)
        self._trial.failed.connect(self._on_trial_failed)

    def detect_again(self) -> None:
        """Find the segments anew in the background; what was corrected by hand stays."""
        project = self._desk.session.project
        if not self._operations.ready():
            return
        if project.segments is None:
            self._desk.notices.refuse(self.tr("The segments are automatic; nothing was corrected by hand."))
            return
        if all(is_kept(segment) for segment in project.segments):
            self._desk.notices.refuse(
                self.tr("Every segment is locked or made by hand, so there is nothing to detect again."),
                Remedy(self.tr("Back to automatic"), self.back_to_automatic),
            )
            return
        self._trial.ask(project, lambda: _detected_again(project), lambda found: self._take_detected(project, found))

    def _take_detected(self, project: Project, answer: object) -> None:
        assert isinstance(answer, tuple)
        (found, segments), before = answer, project.segments or ()
        if found is not project:
            self._operations.apply(self.tr("Detect again"), lambda _project: found)
        if segments != before:
            return
        kept = sum(is_kept(segment) for segment in before)
        if kept:
            text = self.tr(
                "Nothing changed: {kept} of {count} segments are locked or made by hand and stay,"
                " and with the same settings the others are found as they are."
            )
        else:
            text = self.tr("Nothing changed: with the same settings all {count} segments are found as they are.")
        remedy = (Remedy(self.tr("Back to automatic"), self.back_to_automatic),) if kept else ()
        self._desk.notices.note(text.format(kept=kept, count=len(before)), *remedy)

    def back_to_automatic(self) -> None:
        """Give up all corrections; undo brings them back."""
        if self._desk.session.project.segments is None:
            self._desk.notices.refuse(self.tr("The segments are automatic already."))
            return
        self._operations.select_nothing()
        self._operations.apply(self.tr("Back to automatic"), segment_edits.use_automatic_segments)

    def change_settings(self, **changes: object) -> None:
        """Change how segments are found: tried in the background, and kept if that works; changes merge."""
        project = self._desk.session.project
        # A change that is still being tried must not be lost to the next one.
        base = self._trial.wanted or project.segmentation
        settings: SegmentationSettings = replace(base, **changes)  # type: ignore[arg-type]
        if settings == base:
            if self._now.is_preview:
                self.drop_preview()
            return
        document = self._desk.session.document
        pending = {
            field.name: getattr(settings, field.name)
            for field in fields(settings)
            if getattr(settings, field.name) != getattr(project.segmentation, field.name)
        }
        # The trial fills the memory of what is derived, so that the edit itself takes no time.
        self._trial.ask(
            project,
            lambda: _tried(project, settings),
            lambda _found: self._take_settings(settings, key="segmentation " + " ".join(sorted(changes))),
            wanted=settings,
            lost=lambda: self._change_again(document, pending),
        )

    def _take_settings(self, settings: SegmentationSettings, *, key: str) -> None:
        self._operations.apply(
            self.tr("Change segmentation"), lambda before: segment_edits.set_segmentation(before, settings), key=key
        )
        segments = self._desk.session.project.segments
        if segments is not None and all(is_kept(segment) for segment in segments):
            self._desk.notices.refuse(
                self.tr("Every segment is locked or made by hand, so other settings change none of them."),
                Remedy(self.tr("Back to automatic"), self.back_to_automatic),
            )

    def _change_again(self, document: object, changes: dict[str, object]) -> None:
        """Begin again what another edit overtook; after an undo nobody wants it any more."""
        session = self._desk.session
        if session.document is document and session.redo_label is None:
            self.change_settings(**changes)

    def preview_threshold(self, threshold: float) -> None:
        """Show what another threshold would find, without changing the document."""
        project = self._desk.session.project
        settings = replace(project.segmentation, threshold=threshold)
        self._now.preview(self._now.segments if self._now.is_preview else None, threshold=threshold)

        def show(found: object) -> None:
            assert isinstance(found, tuple)
            if self._now.threshold is not None and self._now.is_preview:
                self._now.preview(found, threshold=threshold)

        self._trial.ask(project, lambda: _tried(project, settings), show)

    def drop_preview(self) -> None:
        """Show the document's segments again."""
        self._trial.drop()
        self._now.preview(None)

    def _on_trial_failed(self, sentence: str) -> None:
        self._now.preview(None)
        self._desk.notices.warn(sentence)


def automatic_operations(desk: Desk) -> AutomaticOperations:
    """Return the one set of operations that all parts of a window share."""
    name = "automatic operations"
    found = desk.session.findChild(AutomaticOperations, name)
    if found is None:
        found = AutomaticOperations(desk, desk.session)
        found.setObjectName(name)
    return found


def _tried(project: Project, settings: SegmentationSettings) -> Segments:
    """Return the segments that settings would give; called on a thread."""
    if not alignment_of(project).segments:
        raise InputError("there are no segments")
    return alignment_of(segment_edits.set_segmentation(project, settings)).segments


def _detected_again(project: Project) -> tuple[Project, Segments]:
    """Return the project with its segments detected again, and these; called on a thread."""
    found = segment_edits.detect_again(project)
    return found, derive.segments(found).needed()

"""Both rules side by side: how many segments each finds, and which boundaries they agree on."""

from __future__ import annotations

from dataclasses import dataclass, replace

from bobdesk.alignment.boundary_comparison import BoundaryComparison, boundaries_of, compare_boundaries
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segments
from bobdesk.project import derive
from bobdesk.project.project import Project
from bobdesk.ui.newest import Newest
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.widgets.facts import Facts
from bobdesk.ui.widgets.fold import Fold
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part


@dataclass(frozen=True, eq=False)
class RuleDifference:
    """What both rules find on the same line."""

    recommended: Segments
    published: Segments
    boundaries: BoundaryComparison


class RulesPart(Part):
    """Closed until it is asked for, since it finds the segments twice."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.heading.hide()
        self._now = alignment_now(self.desk)
        self._line: object = None
        self.fold = Fold(self.tr("Recommended and published rule side by side"), self)
        self.fold.toggled.connect(self._on_toggled)
        self.column.addWidget(self.fold)
        self.facts: Facts = panel.add_facts(self.fold.column)
        self.found = self.facts.add(self.tr("Found"))
        self.agree = self.facts.add(self.tr("Boundaries that agree"))
        self.apart = self.facts.add(self.tr("Of one rule alone"))
        self.score = self.facts.add(self.tr("F1 of the boundaries"))
        self._newest = Newest(self.desk.runner, self.tr("Comparing both rules"), self)
        self._newest.answered.connect(self._show)
        self._newest.failed.connect(self._on_failed)
        self._now.changed.connect(self._on_now)

    def _on_toggled(self, _on: bool) -> None:
        self._line = None
        self._on_now()

    def _on_now(self) -> None:
        value = self._now.known
        if not self.fold.is_open or value is None or self._now.is_preview:
            return
        wanted = (value.line, self.desk.session.project.segmentation)
        if self._line != wanted:
            self._line = wanted
            project = self.desk.session.project
            self._newest.ask(lambda: rule_difference(project))

    def _show(self, found: object) -> None:
        assert isinstance(found, RuleDifference)
        number, both = self.desk.quantities.number, found.boundaries
        text = self.tr("segments: recommended {first}, published {second}")
        self.found.setText(text.format(first=len(found.recommended), second=len(found.published)))
        text = self.tr("{count} within {metres}, {moved} of them moved")
        within = self.desk.quantities.length(both.within, 0)
        self.agree.setText(text.format(count=len(both.pairs), metres=within, moved=both.moved))
        text = self.tr("recommended {first}, published {second}")
        self.apart.setText(text.format(first=len(both.only_first), second=len(both.only_second)))
        self.score.setText(number(both.f1, 3))

    def _on_failed(self, sentence: str) -> None:
        self.found.setText(sentence)


def rule_difference(project: Project) -> RuleDifference:
    """Find the segments of a line by both rules; called on a thread.

    Raises
    ------
    InputError
        If there is no line yet.
    """
    from bobdesk.alignment.segmentation import detect_segments

    line = derive.centreline(project).needed()
    settings = project.segmentation
    recommended = detect_segments(line, replace(settings, rule="recommended"))
    published = detect_segments(line, replace(_published(settings), count=None))
    return RuleDifference(
        recommended, published, compare_boundaries(boundaries_of(recommended), boundaries_of(published))
    )


def _published(settings: SegmentationSettings) -> SegmentationSettings:
    return replace(settings, rule="published")

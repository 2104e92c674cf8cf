"""Whether the figures can hold together: a sentence that lives as one types, and what can be done about it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bobdesk.project.project import Project
from bobdesk.sentences import as_sentence
from bobdesk.ui.derived import DerivedLater, line_inputs
from bobdesk.ui.solve.feasibility_box import BoxKind, FeasibilityBox
from bobdesk.ui.solve.remedies import Remedies
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part

if TYPE_CHECKING:
    from bobdesk.solve.feasibility import Feasibility


def inputs_of(project: Project) -> tuple[object, ...] | None:
    """Return all that the answer depends on."""
    line = line_inputs(project)
    if line is None:
        return None
    return (
        *line,
        project.segmentation,
        project.segments,
        project.limits,
        project.known_elevations,
        project.solver,
    )


def _looked(project: Project) -> Feasibility:
    from bobdesk.project import derive
    from bobdesk.solve.feasibility import feasibility

    inputs = derive.run_inputs(project).needed()
    line = derive.centreline(project).needed()
    return feasibility(line, inputs.segments, inputs.targets, inputs.settings.pgd)


class FeasibilityPart(Part):
    """Asks in the background; blocks nothing."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Can these figures be met?"))
        self.heading.hide()
        self.box = FeasibilityBox(self)
        self.column.setContentsMargins(0, 2, 0, 0)
        self.column.addWidget(self.box)
        self._remedies = Remedies(self.desk, self)
        self.later = DerivedLater(
            self.desk, self.tr("Checking whether the figures can be met"), _looked, inputs_of, self
        )
        self.later.changed.connect(self._show)
        self.desk.quantities.changed.connect(self._show)
        self._show()

    def _show(self) -> None:
        found: Feasibility | None = self.later.value
        project = self.desk.session.project
        if found is None:
            self._say_why_not(project)
            return
        kind: BoxKind = "good" if found.feasible and not found.doubt else "doubt"
        sentence = self.desk.quantities.sentence(found.sentence)
        self.box.say(kind, sentence, self._remedies.offers(found), is_current=self.later.is_current)

    def _say_why_not(self, project: Project) -> None:
        text = self.later.problem
        if text is None:
            waiting = project.source is not None or project.trace is not None
            text = self.tr("Looking …") if waiting else self.tr("A centreline comes first.")
        against = self._remedies.contradiction(project)
        if self.later.problem is not None and against:
            sentence = self.desk.quantities.sentence(as_sentence(text))
            self.box.say("doubt", sentence, against, is_current=self.later.is_current)
            return
        offers = self._remedies.missing(project, None)
        self.box.say("waiting", as_sentence(text), offers, is_current=self.later.is_current)

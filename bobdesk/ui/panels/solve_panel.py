"""The panel of step 5: targets, whether they can be met, the run, and the runs."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.solve.advice_part import AdvicePart
from bobdesk.ui.solve.budget_part import BudgetPart
from bobdesk.ui.solve.convergence_part import ConvergencePart
from bobdesk.ui.solve.feasibility_part import FeasibilityPart
from bobdesk.ui.solve.known_part import KnownPart
from bobdesk.ui.solve.method_part import MethodPart
from bobdesk.ui.solve.run_part import RunPart
from bobdesk.ui.solve.runs_part import RunsPart
from bobdesk.ui.solve.targets_part import TargetsPart
from bobdesk.ui.widgets.panel import Panel


class SolvePanel(Panel):
    """What is known goes in at the top, what was found comes out below."""

    def __init__(self, desk: Desk, parent: QWidget | None = None) -> None:
        super().__init__(desk, parent)
        self.name_it(self.tr("Solve"))
        self.targets = TargetsPart(self)
        self.feasibility = FeasibilityPart(self)
        self.known = KnownPart(self)
        self.advice = AdvicePart(self, self.known)
        self.method = MethodPart(self)
        self.run = RunPart(self)
        self.convergence = ConvergencePart(self)
        self.runs = RunsPart(self)
        self.budget = BudgetPart(self)
        self.column.addStretch(1)
        desk.session.changed.connect(self._on_changed)
        self._show(desk.session.project)

    def _on_changed(self, _before: Project, after: Project) -> None:
        self._show(after)

    def _show(self, project: Project) -> None:
        for part in (self.targets, self.known, self.method, self.run, self.runs, self.budget):
            part.refresh(project)

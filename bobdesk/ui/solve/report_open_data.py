"""Error budget and design rules as a report shows them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QCoreApplication, QObject

from bobdesk.track.design_rules import Finding
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.solve.rule_words import RuleWords

if TYPE_CHECKING:
    from bobdesk.track.error_budget import ErrorBudget

Rows = list[tuple[str, ...]]


def source_named(source: str) -> str:
    """Return what a source of the error budget is called on the screen and on paper."""
    names = {
        "digitising": QCoreApplication.translate("ErrorBudget", "clicks or trace"),
        "calibration": QCoreApplication.translate("ErrorBudget", "calibration"),
        "rounding of the length": QCoreApplication.translate("ErrorBudget", "rounding, length"),
        "rounding of the drop": QCoreApplication.translate("ErrorBudget", "rounding, drop"),
        "usual swing of the gradient": QCoreApplication.translate("ErrorBudget", "usual swing"),
        "left open by the data": QCoreApplication.translate("ErrorBudget", "left open"),
        "all together": QCoreApplication.translate("ErrorBudget", "all together"),
    }
    return names.get(source, source)


class ReportOnOpenData(QObject):
    """Rows of two tables, in the user's units.

    Parameters
    ----------
    budget, why_no_budget
        The error budget, or why there is none.
    findings
        Of all rules that are used.
    """

    def __init__(
        self, quantities: Quantities, budget: ErrorBudget | None, why_no_budget: str, findings: tuple[Finding, ...]
    ) -> None:
        super().__init__()
        self._unit, self._budget, self._why, self._findings = quantities, budget, why_no_budget, findings
        self._words = RuleWords(quantities, self)

    def budget_heads(self) -> tuple[str, ...]:
        """Return the headings of the error budget."""
        return (
            self.tr("Source"), self.tr("Length in plan"), self.tr("Scale, %"), self.tr("Elevation, RMS"),
            self.tr("Gradient, RMS, %"),
        )  # fmt: skip

    def budget(self) -> Rows:
        """Return one row a source; none without a budget."""
        if self._budget is None:
            return []
        unit = self._unit
        return [
            (
                source_named(share.source),
                f"± {unit.length(share.plan_length, 2)}",
                f"± {unit.number(100 * share.scale, 3)}",
                f"± {unit.length(share.elevation, 2)}",
                f"± {unit.number(100 * share.gradient, 2)}",
            )
            for share in self._budget.shares
        ]

    def budget_sentence(self) -> str:
        """Return the budget in a sentence, or why there is none."""
        if self._budget is not None:
            return self._budget.sentence
        return self.tr("No error budget: {why}.").format(why=self._why)

    def rule_heads(self) -> tuple[str, ...]:
        """Return the headings of the design rules."""
        return (self.tr("Rule"), self.tr("Asked for"), self.tr("Found"), self.tr("Where"), self.tr("Source"))

    def rules(self) -> Rows:
        """Return one row a rule."""
        rows: Rows = []
        for found in self._findings:
            rule, words = found.rule, self._words
            if found.value is None:
                said = self.tr("not judged: {why}").format(why=found.why)
            else:
                mark = "✓" if found.verdict == "kept" else "!"
                said = f"{mark} {words.value(rule, found.value)} {words.unit(rule)}"
            where = words.stretches(found) if found.stretches else ""
            rows.append((rule.name, words.limits(rule), said, where, rule.source))
        return rows

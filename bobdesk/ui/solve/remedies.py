"""What can be done with one click about figures that contradict each other."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk

if TYPE_CHECKING:
    from bobdesk.solve.feasibility import Feasibility

Offer = tuple[str, Callable[[], object]]
_SAME_SCALE = 1e-4
# Of a length in space to the length in plan: far more than any track, and any error of a scale.
_FAR_TOO_LONG = 2.0


class Remedies(QObject):
    """Each offer is one undoable edit."""

    def __init__(self, desk: Desk, parent: QObject) -> None:
        super().__init__(parent)
        self._desk = desk

    def offers(self, found: Feasibility) -> list[Offer]:
        """Return what helps against what was found."""
        project = self._desk.session.project
        offers: list[Offer] = []
        if not found.feasible and found.reachable_length is not None:
            offers += self._lengths(project, found)
        if found.doubt:
            offers += self._third_of_three(project, found)
        if found.scale is not None and (not found.feasible or project.calibration.way == "unknown"):
            offers += self._scale(project, found.scale)
        return offers

    def missing(self, project: Project, plan_length: float | None) -> list[Offer]:
        """Return figures that follow from two that are given."""
        if project.targets.mean_gradient is None or project.targets.mean_gradient_is == "segments":
            return []
        if (project.targets.length is None) == (project.targets.drop is None):
            return []
        return self._third(project, plan_length, only_missing=True)

    def contradiction(self, project: Project) -> list[Offer]:
        """Return what helps against figures of which no track can have all: a drop of more than the length."""
        from bobdesk.project import edits

        chosen = project.targets
        length, drop = chosen.length, chosen.drop
        if length is None or drop is None:
            return []
        mean = chosen.mean_gradient if chosen.mean_gradient_is == "drop-per-length" else None
        if drop < length:
            return self._third(project, None) if mean is not None and mean <= 0 else []
        offers: list[Offer] = []
        if drop > length and _may_be_as_long(project, drop):
            # They stand in each other's fields.
            text = self.tr("Swap length and height difference")
            offers.append(
                self._offer(
                    text,
                    text,
                    lambda now: edits.set_drop(edits.set_length(now, drop), length),
                )
            )
        return offers + (self._third(project, None) if mean is not None and mean < 1 else [])

    def _lengths(self, project: Project, found: Feasibility) -> list[Offer]:
        from bobdesk.project import edits

        wanted, reachable = project.targets.length, found.reachable_length
        # Between the ends a run may miss a length because of dips: of no other one it is known to meet it.
        if wanted is None or reachable is None or reachable[0] < wanted < reachable[1]:
            return []
        # Rounded into the range, so that the figure is met and can be read.
        nearest = min(max(wanted, reachable[0] + 0.01), reachable[1] - 0.01)
        nearest = round(nearest, 2)
        if not reachable[0] <= nearest <= reachable[1]:
            return []
        text = self.tr("Use the length {length}").format(length=self._desk.quantities.length(nearest, 2))
        label = self.tr("Use a length that can be met")
        return [(text, lambda: self._desk.session.apply(label, lambda now: edits.set_length(now, nearest)))]

    def _third_of_three(self, project: Project, found: Feasibility) -> list[Offer]:
        return self._third(
            project, found.plan_length * (found.scale or 1.0 if project.calibration.way == "unknown" else 1)
        )

    def _third(self, project: Project, plan_length: float | None, *, only_missing: bool = False) -> list[Offer]:
        """Keep two of length, drop and mean gradient, and derive the third."""
        from bobdesk.project import edits

        chosen, unit = project.targets, self._desk.quantities
        by_plan = chosen.mean_gradient_is == "drop-per-plan"
        base = plan_length if by_plan else chosen.length
        offers: list[Offer] = []
        if chosen.drop is not None and base and chosen.drop < base and not only_missing:
            mean = round(chosen.drop / base, 6)
            offers.append(
                self._offer(
                    self.tr("Keep the others, mean gradient {value}").format(value=unit.gradient(mean)),
                    self.tr("Derive the mean gradient"),
                    lambda now: edits.set_mean_gradient(now, mean, chosen.mean_gradient_is),
                )
            )
        # No length or drop follows from a mean gradient that no track can have.
        mean_given = None if chosen.mean_gradient is None else max(chosen.mean_gradient, 0.0)
        if mean_given and base and (not only_missing or chosen.drop is None):
            drop = round(mean_given * base, 3)
            offers.append(
                self._offer(
                    self.tr("Keep the others, height difference {value}").format(value=unit.length(drop, 2)),
                    self.tr("Derive the height difference"),
                    lambda now: edits.set_drop(now, drop),
                )
            )
        if mean_given and chosen.drop is not None and not by_plan and (not only_missing or chosen.length is None):
            length = round(chosen.drop / mean_given, 3)
            if _may_be_as_long(project, length):
                offers.append(
                    self._offer(
                        self.tr("Keep the others, length {value}").format(value=unit.length(length, 2)),
                        self.tr("Derive the length"),
                        lambda now: edits.set_length(now, length),
                    )
                )
        return offers

    def _offer(self, text: str, label: str, edit: Callable[[Project], Project]) -> Offer:
        return text, lambda: self._desk.session.apply(label, edit)

    def _scale(self, project: Project, factor: float) -> list[Offer]:
        from bobdesk.project import derive, edits

        shown = self._desk.quantities.number(factor, 4)
        if project.calibration.way == "unknown" or abs(factor - 1) < _SAME_SCALE:
            return []
        if project.source is not None or project.picture is None:
            return [
                self._offer(
                    self.tr("Use f = {factor}: find the scale").format(factor=shown),
                    self.tr("Find the scale"),
                    edits.find_the_scale,
                )
            ]
        found = derive.calibration(project).value
        if found is None:
            return []
        metres = found.metres_per_pixel * factor
        return [
            self._offer(
                self.tr("Use f = {factor}: scale the plan").format(factor=shown),
                self.tr("Scale the plan by f"),
                lambda now: edits.scale_by_number(now, metres),
            )
        ]


def _may_be_as_long(project: Project, length: float) -> bool:
    """Return whether a length, m, is not far too long for this plan, as far as its scale is known."""
    from bobdesk.plan.polyline_geometry import arc_lengths
    from bobdesk.project import derive

    line = derive.polyline(project).value
    if line is None or not derive.scale_is_known(project):
        return True
    return length < _FAR_TOO_LONG * float(arc_lengths(line.vertices)[-1])

"""What the scale is worth: residuals, stretch, and the plan length that follows."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from bobdesk.errors import InputError
from bobdesk.plan.affine_check import check_affine
from bobdesk.plan.calibration import Calibration, plan_length_sigma
from bobdesk.plan.calibration_sentences import affine_sentence
from bobdesk.project import derive
from bobdesk.project.project import Project
from bobdesk.ui.derived import centreline_later
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part

if TYPE_CHECKING:
    from bobdesk.plan.calibration_fit import CalibrationFit

_FEWEST_FOR_AFFINE = 3


class ScaleFitPart(Part):
    """Rows of figures."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Fit"))
        facts = panel.add_facts(self.column)
        self.scale = facts.add(self.tr("Scale"))
        self.turned = facts.add(self.tr("Turned"))
        self.rms = facts.add(self.tr("RMS"))
        self.rms.setToolTip(
            self.tr(
                "Root of the mean of the squared distances between each click and its known position; "
                "differences of known distances count alike."
            )
        )
        self.length = facts.add(self.tr("Plan length that follows"))
        self.worth = facts.add(self.tr("± in length is worth"))
        self.worth.setToolTip(
            self.tr("By how much the mean gradient must change if the plan is so much longer or shorter.")
        )
        self._facts = facts
        self.affine = panel.add_label("", "muted", self.column)
        self.affine.setToolTip(self.tr("An affine fit beside the scale: whether the scan is stretched or sheared."))
        self._line = centreline_later(self.desk)
        self._line.changed.connect(self._show_length)
        self.desk.quantities.changed.connect(self._show_length)

    def refresh(self, project: Project, calibration: Calibration | None, fit: CalibrationFit | None) -> None:
        """Show what the scale of a project is worth."""
        self.setVisible(project.source is None and calibration is not None)
        if calibration is None:
            return
        number = self.desk.quantities.number
        sigma = calibration.scale_sigma
        text = self.tr("{scale} m per pixel").format(scale=_significant(number, calibration.metres_per_pixel))
        if sigma is not None:
            text += f" ± {_significant(number, 100 * sigma / calibration.metres_per_pixel, 2)} %"
        self.scale.setText(text if calibration.scale_known else self.tr("unknown"))
        self.turned.setText(self.desk.quantities.angle(calibration.rotation_rad, 2))
        by_points = project.calibration.way == "points" and fit is not None
        self._facts.show_row(self.rms, by_points)
        if fit is not None and by_points:
            self.rms.setText(self._rms(fit))
        self._show_affine(project, by_points=by_points)
        self._show_length()

    def _rms(self, fit: CalibrationFit) -> str:
        if fit.rms_m is None or fit.rms_px is None:
            return self.tr("no error estimate possible: just enough points; one more gives one")
        text = self.tr("{metres} ({pixels} px), degrees of freedom: {freedom}")
        return text.format(
            metres=self.desk.quantities.length(fit.rms_m, 2),
            pixels=self.desk.quantities.number(fit.rms_px, 1),
            freedom=fit.degrees_of_freedom,
        )

    def _show_affine(self, project: Project, *, by_points: bool) -> None:
        sentence = ""
        if by_points and sum(point.used for point in project.control_points) >= _FEWEST_FOR_AFFINE:
            try:
                sentence = affine_sentence(check_affine(project.control_points))
            except InputError as error:
                sentence = str(error)
        self.affine.setText(sentence)
        self.affine.setVisible(bool(sentence))

    def _show_length(self) -> None:
        derived = self._line.value
        line = None if derived is None else derived.value
        has_line = line is not None and self.desk.session.project.source is None
        self._facts.show_row(self.length, has_line)
        self._facts.show_row(self.worth, False)
        if line is None or not has_line:
            return
        sigma = self._length_sigma(line.length)
        worth = None if sigma is None else self._gradient_worth(line.length, sigma)
        self._facts.show_row(self.worth, worth is not None)
        length = self.desk.quantities.length
        text = length(line.length, 1)
        self.length.setText(text if sigma is None else f"{text} ± {length(sigma, 1)}")
        if worth is not None:
            text = self.tr("± {gradient} of mean gradient, if the length is met")
            self.worth.setText(text.format(gradient=self.desk.quantities.gradient(worth, 1)))

    def _length_sigma(self, length: float) -> float | None:

        calibration = derive.calibration(self.desk.session.project).value
        return None if calibration is None else plan_length_sigma(calibration, length)

    def _gradient_worth(self, plan_length: float, sigma: float) -> float | None:
        """Return what an error of the plan length is worth in mean gradient.

        A line of plan length P that falls evenly by the gradient i is P √(1 + i²) long; with that length
        held, di = (1 + i²) / i · dP / P.
        """
        drop = self.desk.session.project.targets.drop
        if drop is None or drop <= 0:
            return None
        gradient = drop / plan_length
        return (1 + gradient**2) / gradient * sigma / plan_length


def _significant(number: object, value: float, digits: int = 5) -> str:
    if not callable(number) or value <= 0:
        return "–"
    decimals = max(0, min(9, digits - 1 - math.floor(math.log10(value))))
    return str(number(value, decimals))

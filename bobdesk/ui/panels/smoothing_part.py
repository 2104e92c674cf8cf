"""Spacing and smoothing of the centreline, with the curvature that follows while one turns the knob."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QSignalBlocker

from bobdesk.project import edits
from bobdesk.project.project import Project
from bobdesk.ui.derived import centreline_later
from bobdesk.ui.newest import Newest
from bobdesk.ui.panels.plan_length import PlanLength, plan_length
from bobdesk.ui.plots.curvature_strip import CurvatureStrip
from bobdesk.ui.widgets.calm import Slider
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.spin import Spin

_SMALLEST_SPACING, _LARGEST_SPACING = 0.1, 10.0
_LONGEST_WAVE = 200.0
# The slider covers what is useful; the spin box goes further.
_SLIDER_LONGEST, _SLIDER_STEPS_A_METRE = 60, 2


class SmoothingPart(Part):
    """Two spin boxes, a slider, the curvature strip, and the plan length."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Centreline"))
        form = panel.add_form(self.column)
        self.spacing = Spin(self.tr("Distance between stations"), self)
        self.spacing.setDecimals(2)
        self.spacing.setSingleStep(0.1)
        panel.add_field(
            form,
            self.tr("Distance between stations"),
            self.spacing,
            self.tr("The centreline is divided into equal steps; more than 1 m cuts tight curves short"),
        )
        self.spacing.valueChanged.connect(self._on_spacing)
        self.wavelength = Spin(self.tr("Smoothing wavelength"), self)
        self.wavelength.setDecimals(1)
        panel.add_field(
            form,
            self.tr("Smoothing wavelength"),
            self.wavelength,
            self.tr("Waves that are shorter are taken for noise: 15 m suits traces, 20 m clicks, 0 smooths nothing"),
        )
        self.wavelength.valueChanged.connect(self._on_wavelength)
        self.slider = Slider(self.tr("Smoothing wavelength"), self)
        self.slider.setRange(0, _SLIDER_LONGEST * _SLIDER_STEPS_A_METRE)
        self.slider.setPageStep(5 * _SLIDER_STEPS_A_METRE)
        self.slider.setToolTip(self.tr("Drag to see what smoothing does to the curvature"))
        self.slider.valueChanged.connect(self._on_slider)
        self.slider.sliderReleased.connect(self._on_released)
        self.column.addWidget(self.slider)
        self.strip = CurvatureStrip(self.desk, self)
        self.column.addWidget(self.strip)
        figures = panel.add_facts(self.column)
        self.length = figures.add(self.tr("Plan length"))
        self.parts = figures.add(self.tr("± from"))
        self._figures = figures
        self._found: PlanLength | None = None
        self._line = centreline_later(self.desk)
        self._line.changed.connect(self._on_line)
        self._newest = Newest(self.desk.runner, self.tr("Plan length"), self)
        self._newest.answered.connect(self._on_length)
        self._newest.failed.connect(self._on_no_length)
        # The centreline may be there already, for other parts of the window.
        self._on_line()

    def refresh(self, project: Project) -> None:
        """Show the settings of a project."""
        unit = self.desk.quantities
        factor = unit.length_factor
        for spin in (self.spacing, self.wavelength):
            spin.show_unit(unit.length_unit)
        self.spacing.show_range(_SMALLEST_SPACING * factor, _LARGEST_SPACING * factor)
        self.wavelength.show_range(0.0, _LONGEST_WAVE * factor)
        self.spacing.show_value(project.fit.spacing * factor)
        if not self.slider.isSliderDown():
            self._show_wavelength(project.fit.wavelength)
        self._show_length()

    def _show_wavelength(self, metres: float) -> None:
        self.wavelength.show_value(metres * self.desk.quantities.length_factor)
        with QSignalBlocker(self.slider):
            self.slider.setValue(round(metres * _SLIDER_STEPS_A_METRE))

    def _on_spacing(self, shown: float) -> None:
        spacing = min(_LARGEST_SPACING, max(_SMALLEST_SPACING, shown / self.desk.quantities.length_factor))
        self.desk.session.apply(
            self.tr("Set distance between stations"),
            lambda project: edits.set_spacing(project, spacing),
            key="spacing",
        )

    def _on_wavelength(self, shown: float) -> None:
        self._set_wavelength(min(_LONGEST_WAVE, shown / self.desk.quantities.length_factor))

    def _on_slider(self, value: int) -> None:
        wavelength = value / _SLIDER_STEPS_A_METRE
        if self.slider.isSliderDown():
            self.wavelength.show_value(wavelength * self.desk.quantities.length_factor)
            self.strip.try_out(replace(self.desk.session.project.fit, wavelength=wavelength))
        else:
            self._set_wavelength(wavelength)

    def _on_released(self) -> None:
        self._set_wavelength(self.slider.value() / _SLIDER_STEPS_A_METRE)
        self.strip.try_out(None)

    def _set_wavelength(self, wavelength: float) -> None:
        if wavelength != self.desk.session.project.fit.wavelength:
            self.desk.session.apply(
                self.tr("Set smoothing"), lambda project: edits.set_smoothing(project, wavelength), key="smoothing"
            )

    def _on_line(self) -> None:
        if not self._line.is_current:
            return
        derived = self._line.value
        if derived is None or derived.value is None:
            self._newest.drop()
            self._on_no_length(self._line.problem or (derived.problem if derived is not None else "") or "")
            return
        project = self.desk.session.project
        self._newest.ask(lambda: plan_length(project))

    def _on_length(self, found: object) -> None:
        assert isinstance(found, PlanLength)
        self._found = found
        self._show_length()

    def _on_no_length(self, sentence: str) -> None:
        self._found = None
        self._show_length()
        self.length.setText(sentence[:1].upper() + sentence[1:] if sentence else "–")

    def _show_length(self) -> None:
        found, length = self._found, self.desk.quantities.length
        self._figures.show_row(self.parts, found is not None and found.sigma is not None)
        if found is None:
            return
        text = length(found.length, 1)
        if not found.is_scaled:
            text = self.tr("{length}, to be multiplied by the factor f").format(length=text)
        elif found.sigma is not None:
            text = f"{text} ± {length(found.sigma, 1)}"
        self.length.setText(text)
        parts = self.tr("scale {scale}, vertices {vertices} (1 sigma)")
        self.parts.setText(parts.format(scale=length(found.by_scale, 2), vertices=length(found.by_vertices, 2)))

"""The method, and what matters of it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtWidgets import QCheckBox, QComboBox, QWidget

from bobdesk.files.solvers import solver_methods
from bobdesk.project.project import Project
from bobdesk.solve.run import SolverMethod
from bobdesk.solve.settings import SolverSettings
from bobdesk.ui.widgets.fold import Fold
from bobdesk.ui.widgets.long_names import breakable, shortened
from bobdesk.ui.widgets.number_field import NumberField
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.spin import Spin

_PAPERS_RATE = 1e-5


class MethodPart(Part):
    """Settings are shown for the chosen method alone, and only when they are wanted."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Method"))
        self.heading.hide()
        form = panel.add_form(self.column)
        self.method = QComboBox(self)
        found = solver_methods()
        self._methods = [method.key for method in found.formats]
        for method in found.formats:
            text, tip = self._words(method)
            self.method.addItem(text)
            self.method.setItemData(self.method.count() - 1, tip, Qt.ItemDataRole.ToolTipRole)
        panel.add_field(form, self.tr("Method"), self.method, self.tr("How the gradients are found"))
        self.method.activated.connect(self._on_method)
        self.missing = panel.add_label("", "warning", self.column)
        for finding in found.findings:
            panel.add_label(
                f"! {breakable(finding.sentence[0].upper() + finding.sentence[1:])}.", "warning", self.column
            )
        self.fold = Fold(self.tr("Settings of the method"), self)
        self.column.addWidget(self.fold)
        self._pgd = self._section()
        self._published = self._section()
        self._add_pgd()
        self._add_published()
        self.desk.quantities.changed.connect(lambda: self.refresh(self.desk.session.project))

    def refresh(self, project: Project) -> None:
        """Show the settings of a project."""
        settings = project.solver
        unit = self.desk.quantities
        with QSignalBlocker(self.method), QSignalBlocker(self.meet_length):
            self.method.setCurrentIndex(
                self._methods.index(settings.method) if settings.method in self._methods else -1
            )
            self.meet_length.setChecked(settings.pgd.meet_length)
        self.transition.setSuffix(f" {unit.length_unit}")
        self.level_out.setSuffix(f" {unit.length_unit}")
        self.transition.show_value(settings.pgd.transition * unit.length_factor)
        self.level_out.show_value(settings.pgd.level_out * unit.length_factor)
        self.plausible.show_value(100 * settings.pgd.plausible)
        for name, field in self.weights.items():
            field.show_value(getattr(settings.weights, name))
        self.rate.show_value(_PAPERS_RATE if settings.rate is None else settings.rate)
        self.threshold.show_value(settings.threshold)
        is_here = settings.method in self._methods
        self.missing.setVisible(not is_here)
        if not is_here:
            text = self.tr("! The method “{name}” comes with a plug-in that is not here. Choose another one.")
            self.missing.setText(text.format(name=shortened(settings.method)))
        self._pgd.setVisible(settings.method == "pgd")
        self._published.setVisible(settings.method != "pgd")
        for field in (self.rate, self.threshold):
            field.setEnabled(settings.method == "published")

    def _words(self, method: SolverMethod) -> tuple[str, str]:
        """Return what a method is called here, and what is said of it."""
        second = self.tr("A second opinion on the published objective; holds drop and known elevations")
        return {
            "pgd": (
                self.tr("Projected gradient (recommended)"),
                self.tr("Drop, limits and known elevations hold exactly; smoothest profile that meets the length"),
            ),
            "published": (self.tr("As published"), self.tr("The method of Chen et al., to compare with")),
            "slsqp": ("SLSQP", second),
            "lbfgsb": ("L-BFGS-B", self.tr("A second opinion on the published objective; knows limits only")),
            "trustconstr": ("trust-constr", second),
            "de": (self.tr("Differential evolution"), self.tr("A slow, random search on the published objective")),
        }.get(method.key, (method.title, self.tr("From a plug-in")))

    def _section(self) -> QWidget:
        section = QWidget(self)
        self.fold.column.addWidget(section)
        return section

    def _add_pgd(self) -> None:
        form = _form_in(self._pgd)
        self.meet_length = QCheckBox(self.tr("Meet the length"), self)
        self.meet_length.setAccessibleName(self.meet_length.text())
        self.meet_length.setToolTip(
            self.tr("Let the gradient swing from segment to segment by as much as meets the length;"
                    " without it the profile is as smooth as can be")
        )  # fmt: skip
        form.addRow(self.meet_length)
        self.meet_length.toggled.connect(self._on_meet_length)
        self.plausible = self._spin(
            self.tr("Largest swing"), 0.1, 50, 1, self.tr("By how much gradients may swing to meet the length"), " %"
        )
        self.transition = self._spin(
            self.tr("Vertical transitions"), 0, 300, 1, self.tr("Length over which one gradient passes to the next")
        )
        self.level_out = self._spin(
            self.tr("Level out over"),
            0,
            1000,
            1,
            self.tr("Length before the lowest point over which the line levels out"),
        )
        for spin in (self.plausible, self.transition, self.level_out):
            self.panel.add_field(form, spin.accessibleName(), spin, spin.toolTip())
        self.plausible.valueChanged.connect(lambda value: self._set_pgd("plausible", plausible=value / 100))
        self.transition.valueChanged.connect(
            lambda value: self._set_pgd("transition", transition=value / self.desk.quantities.length_factor)
        )
        self.level_out.valueChanged.connect(
            lambda value: self._set_pgd("level out", level_out=value / self.desk.quantities.length_factor)
        )

    def _add_published(self) -> None:
        form = _form_in(self._published)
        self.weights: dict[str, NumberField] = {}
        for name, text, tip in (
            ("length", self.tr("a, length"), self.tr("Weight of the squared error of the length")),
            ("height", self.tr("b, height"), self.tr("Weight of the squared error of the height difference")),
            ("curvature", self.tr("c, curvature"), self.tr("Weight of the squared mean difference of curvatures")),
            ("gradient", self.tr("d, gradient"), self.tr("Weight of the squared error of the mean gradient")),
        ):
            field = NumberField(text, self.panel.refuse, self)
            self.weights[name] = field
            self.panel.add_field(form, text, field, tip)
            field.entered.connect(lambda value, name=name: self._set_weight(name, value))
        self.rate = NumberField(self.tr("η, learning rate"), self.panel.refuse, self)
        self.panel.add_field(
            form, self.tr("η, learning rate"), self.rate,
            self.tr("Size of the steps; the usual value is 0.00001, and smaller where the scale is unknown"),
        )  # fmt: skip
        self.threshold = NumberField(self.tr("δ, end"), self.panel.refuse, self)
        self.panel.add_field(
            form,
            self.tr("δ, end"),
            self.threshold,
            self.tr("The run ends once the objective changes by less than this"),
        )
        self.rate.entered.connect(self._on_rate)
        self.threshold.entered.connect(self._on_threshold)

    def _spin(self, name: str, low: float, high: float, digits: int, tip: str, suffix: str = "") -> Spin:
        spin = Spin(name, self)
        spin.setDecimals(digits)
        spin.setRange(low, high)
        spin.setSuffix(suffix)
        spin.setToolTip(tip)
        return spin

    def _set(self, label: str, key: str | None, **values: Any) -> bool:
        from bobdesk.project import edits

        settings: SolverSettings = replace(self.desk.session.project.solver, **values)
        return self.desk.session.apply(label, lambda project: edits.set_solver(project, settings), key=key)

    def _on_method(self, index: int) -> None:
        self._set(self.tr("Choose the method"), None, method=self._methods[index])

    def _on_meet_length(self, on: bool) -> None:
        self._set_pgd("meet length", meet_length=on)

    def _set_pgd(self, key: str, **values: Any) -> None:
        pgd = replace(self.desk.session.project.solver.pgd, **values)
        self._set(self.tr("Setting of the method"), f"pgd {key}", pgd=pgd)

    def _set_weight(self, name: str, value: float) -> None:
        if value < 0:
            self.panel.refuse(self.tr("A weight must be 0 or more."))
            return
        weights = replace(self.desk.session.project.solver.weights, **{name: value})
        self._set(self.tr("Weight of the objective"), f"weight {name}", weights=weights)

    def _on_rate(self, value: float) -> None:
        if value <= 0:
            self.panel.refuse(self.tr("The learning rate must be more than 0."))
            return
        self._set(self.tr("Learning rate"), "rate", rate=None if value == _PAPERS_RATE else value)

    def _on_threshold(self, value: float) -> None:
        if value <= 0:
            self.panel.refuse(self.tr("δ must be more than 0."))
            return
        self._set(self.tr("End of the run"), "threshold", threshold=value)


def _form_in(section: QWidget) -> Any:
    from PySide6.QtWidgets import QFormLayout

    form = QFormLayout(section)
    form.setContentsMargins(0, 0, 0, 0)
    form.setHorizontalSpacing(12)
    form.setVerticalSpacing(5)
    form.setRowWrapPolicy(QFormLayout.RowWrapPolicy.WrapLongRows)
    form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
    return form

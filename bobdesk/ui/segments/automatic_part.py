"""How segments are found: threshold, shortest, wanted number, rule and smoothing; every change is seen at once."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QSignalBlocker
from PySide6.QtWidgets import QCheckBox, QComboBox, QHBoxLayout, QWidget

from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.arrays import FloatArray
from bobdesk.project import derive, edits
from bobdesk.project.project import Project
from bobdesk.ui.derived import DerivedLater, line_inputs
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.segments.automatic_operations import automatic_operations
from bobdesk.ui.segments.gain_picture import GainPicture
from bobdesk.ui.widgets.fold import Fold
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.spin import Spin, WholeSpin

_MOST_SHOWN = 60


class AutomaticPart(Part):
    """Settings of the segmentation, each change one step of undo; a row of them on one field merges."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Found automatically"))
        self._now = alignment_now(self.desk)
        self._operations = automatic_operations(self.desk)
        form = panel.add_form(self.column)
        self.threshold, self.threshold_auto = self._add_threshold(form)
        self.count = WholeSpin(self.tr("Wanted number"), self)
        self.count.setRange(0, 999)
        self.count.setSpecialValueText(self.tr("automatic"))
        self.count.valueChanged.connect(lambda count: self._operations.change_settings(count=count or None))
        panel.add_field(
            form, self.tr("Wanted number"), self.count,
            self.tr("So many segments; a left and a right curve without a straight between them count as two"),
        )  # fmt: skip
        self.kept = panel.add_label("", "muted", self.column)
        self.shortest = Spin(self.tr("Shortest segment"), self)
        self.shortest.setDecimals(1)
        self.shortest.valueChanged.connect(self._on_shortest)
        panel.add_field(
            form, self.tr("Shortest segment"), self.shortest, self.tr("No segment becomes shorter than this")
        )
        self._form = form
        self.gain = GainPicture(self.desk.quantities, self)
        self.gain.count_chosen.connect(lambda count: self._operations.change_settings(count=count))
        self.column.addWidget(self.gain)
        self.fold = Fold(self.tr("More settings"), self)
        self.column.addWidget(self.fold)
        more = panel.add_form(self.fold.column)
        self.rule = QComboBox(self)
        self.rule.addItem(self.tr("recommended"), "recommended")
        self.rule.addItem(self.tr("as published"), "published")
        self.rule.activated.connect(self._on_rule)
        panel.add_field(
            more, self.tr("Rule"), self.rule,
            self.tr("Recommended: the best labels for the fitted curvature. As published: finite differences below"
                    " a threshold"),
        )  # fmt: skip
        self.cost = Spin(self.tr("Cost of a change"), self)
        self.cost.setDecimals(1)
        self.cost.valueChanged.connect(self._on_cost)
        panel.add_field(
            more, self.tr("Cost of a change"), self.cost,
            self.tr("What a change between left, straight and right must gain; larger means fewer segments"),
        )  # fmt: skip
        self.smoothing = Spin(self.tr("Smoothing of the line"), self)
        self.smoothing.setDecimals(1)
        self.smoothing.valueChanged.connect(self._on_smoothing)
        panel.add_field(
            more, self.tr("Smoothing of the line"), self.smoothing,
            self.tr("Waves that are shorter are taken for noise; the same setting as in step 3"),
        )  # fmt: skip
        self._more = more
        self._gains = DerivedLater(self.desk, self.tr("Comparing numbers of segments"), _gains, _gain_inputs, self)
        self._gains.changed.connect(self._show_gain)
        self._now.changed.connect(self.refresh)
        self.desk.session.changed.connect(self._on_changed)
        self.desk.quantities.changed.connect(self.refresh)
        self.refresh()

    def refresh(self) -> None:
        """Show the settings in force."""
        settings, unit = self.desk.session.project.segmentation, self.desk.quantities
        factor, suffix = unit.length_factor, f" {unit.length_unit}"
        with QSignalBlocker(self.rule):
            self.rule.setCurrentIndex(self.rule.findData(settings.rule))
        is_automatic = settings.threshold is None
        with QSignalBlocker(self.threshold_auto):
            self.threshold_auto.setChecked(is_automatic and not self._now.is_trying_threshold)
        shown = self._now.threshold or settings.threshold or 0.004
        self.threshold.setSuffix(f" 1/{unit.length_unit}")
        with QSignalBlocker(self.threshold):
            self.threshold.setDecimals(4 if shown / factor >= 1e-3 else 6)
        self.threshold.show_range(min(1e-4, shown) / factor, 1.0 / factor)
        self.threshold.show_value(shown / factor)
        self.count.show_value(settings.count or 0)
        self._show_kept(settings.count)
        for spin, value, most in (
            (self.shortest, settings.shortest, 100.0),
            (self.cost, settings.change_cost, 100.0),
            (self.smoothing, self.desk.session.project.fit.wavelength, 200.0),
        ):
            spin.setSuffix(suffix)
            spin.show_range(0.0, most * factor)
            spin.show_value(value * factor)
        is_recommended = settings.rule == "recommended"
        for form, field in ((self._form, self.count), (self._form, self.shortest), (self._more, self.cost)):
            form.setRowVisible(field, is_recommended)
        self.gain.setVisible(is_recommended)
        self.shortest.setEnabled(settings.count is None)
        self.cost.setEnabled(settings.count is None)
        self._show_gain()

    def _show_kept(self, wanted: int | None) -> None:
        """Say why there are more segments than were wanted, or fewer."""
        found = self._now.segments
        differs = self._now.is_current and bool(found) and wanted not in (None, len(found))
        self.kept.setVisible(differs)
        if differs:
            self.kept.setText(
                self.tr("{count} segments, since those that are locked or made by hand stay.").format(count=len(found))
            )

    def _add_threshold(self, form: object) -> tuple[Spin, QCheckBox]:
        spin = Spin(self.tr("Curvature threshold"), self)
        spin.setDecimals(4)
        spin.setSingleStep(0.0005)
        spin.valueChanged.connect(self._on_threshold)
        box = QCheckBox(self.tr("automatic"), self)
        tip = self.tr("Curvature above which a place counts as curved; drag the dashed line on the strip, too")
        box.setToolTip(self.tr("Find the threshold from the curvature itself"))
        box.setAccessibleName(self.tr("Automatic threshold"))
        box.toggled.connect(self._on_automatic)
        both = QWidget(self)
        row = QHBoxLayout(both)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(box)
        row.addWidget(spin, 1)
        both.setFocusProxy(spin)
        spin.setToolTip(tip)
        self.panel.add_field(form, self.tr("Curvature threshold"), both, tip)  # type: ignore[arg-type]
        return spin, box

    def _on_threshold(self, shown: float) -> None:
        self._operations.change_settings(threshold=round(shown * self.desk.quantities.length_factor, 6))

    def _on_automatic(self, on: bool) -> None:
        threshold = None if on else self._now.threshold
        self._operations.change_settings(threshold=threshold if threshold is None else round(threshold, 6))

    def _on_shortest(self, shown: float) -> None:
        self._operations.change_settings(shortest=round(shown / self.desk.quantities.length_factor, 3))

    def _on_cost(self, shown: float) -> None:
        self._operations.change_settings(change_cost=round(shown / self.desk.quantities.length_factor, 3))

    def _on_rule(self, _row: int) -> None:
        rule = self.rule.currentData()
        # The published rule knows no wanted number, and would refuse.
        changes = {"rule": rule, "count": None} if rule == "published" else {"rule": rule}
        self._operations.change_settings(**changes)

    def _on_smoothing(self, shown: float) -> None:
        wavelength = round(shown / self.desk.quantities.length_factor, 3)
        self.desk.session.apply(
            self.tr("Change smoothing"), lambda project: edits.set_smoothing(project, wavelength), key="smoothing"
        )

    def _on_changed(self, before: Project, after: Project) -> None:
        if before.segmentation != after.segmentation or before.fit != after.fit:
            self.refresh()

    def _show_gain(self) -> None:
        gain = self._gains.value
        if gain is not None:
            self.gain.show_gain(gain, len(self._now.segments))


def _gain_inputs(project: Project) -> tuple[object, ...] | None:
    inputs = line_inputs(project)
    settings = project.segmentation
    if inputs is None or settings.rule == "published":
        return None
    return (*inputs, _Held.of(replace(settings, count=None, shortest=3.0, change_cost=4.0)))


class _Held:
    """Settings that are the same object whenever they are equal, as followers compare by identity."""

    _known: dict[SegmentationSettings, SegmentationSettings] = {}  # noqa: RUF012 - shared on purpose

    @classmethod
    def of(cls, settings: SegmentationSettings) -> SegmentationSettings:
        return cls._known.setdefault(settings, settings)


def _gains(project: Project) -> FloatArray:
    from bobdesk.alignment.segmentation import fit_by_count

    line = derive.centreline(project).needed()
    count = len(derive.segments(replace(project, segments=None)).needed())
    return fit_by_count(line, project.segmentation, most=max(_MOST_SHOWN, 2 * count))

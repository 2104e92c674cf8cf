"""What is known of the track: the sets of targets, their figures, and the limits."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QInputDialog, QLabel, QMenu, QToolButton, QWidget

from bobdesk.project.project import Project
from bobdesk.solve.targets import STEEPEST_GRADIENT, MeanGradientDefinition
from bobdesk.ui.icons import icon
from bobdesk.ui.solve.preset_dialog import PresetDialog
from bobdesk.ui.solve.presets import Preset
from bobdesk.ui.solve.target_field import TargetField
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.typed_number import number_to_edit

_DEFINITIONS: tuple[MeanGradientDefinition, ...] = ("drop-per-length", "drop-per-plan", "segments")
# 1/m as per cent in ten metres.
_PERCENT_IN_TEN = 1000.0


class TargetsPart(Part):
    """Figures in the user's units; every key stroke that makes a number is an edit, and a row of them one step."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("What is known of the track"))
        self.sets = QComboBox(self)
        self.menu_button = QToolButton(self)
        self._form = panel.add_form(self.column)
        self._add_sets()
        self.length = self._figure(self.tr("Length (3D)"), self.tr("Length along the track, measured in space"))
        self.drop = self._figure(
            self.tr("Height difference"), self.tr("From the start down to the lowest point of the line")
        )
        self.mean = TargetField(self.tr("Mean gradient"), panel.refuse, self)
        self.definition = QComboBox(self)
        self._add_mean()
        self.lowest = TargetField(self.tr("Smallest gradient"), panel.refuse, self)
        self.highest = TargetField(self.tr("Largest gradient"), panel.refuse, self)
        self._add_limits()
        self.change = TargetField(self.tr("Largest change of gradient"), panel.refuse, self)
        self._add_change()
        self.scale = QComboBox(self)
        self._add_scale()
        self._labels()
        self.length.entered.connect(self._on_length)
        self.drop.entered.connect(self._on_drop)
        self.mean.entered.connect(self._on_mean)
        self.lowest.entered.connect(self._on_lowest)
        self.highest.entered.connect(self._on_highest)
        self.change.entered.connect(self._on_change)
        self.desk.quantities.changed.connect(self._on_units)

    def refresh(self, project: Project) -> None:
        """Show the targets of a project."""
        from bobdesk.project import derive

        unit = self.desk.quantities
        with QSignalBlocker(self.sets), QSignalBlocker(self.definition), QSignalBlocker(self.scale):
            self.sets.clear()
            self.sets.addItems([one.name for one in project.target_sets])
            self.sets.setCurrentIndex(project.chosen_targets)
            self.definition.setCurrentIndex(_DEFINITIONS.index(project.targets.mean_gradient_is))
            self.scale.setCurrentIndex(0 if derive.scale_is_known(project) else 1)
        self.rename_action.setEnabled(True)
        self.remove_action.setEnabled(len(project.target_sets) > 1)
        chosen = project.targets
        self.length.show_value(None if chosen.length is None else chosen.length * unit.length_factor)
        self.drop.show_value(None if chosen.drop is None else chosen.drop * unit.length_factor)
        self.mean.show_value(None if chosen.mean_gradient is None else unit.shown_gradient(chosen.mean_gradient))
        self.lowest.show_value(unit.shown_gradient(project.limits.min_gradient), digits=8)
        self.highest.show_value(unit.shown_gradient(project.limits.max_gradient), digits=8)
        change = project.limits.gradient_change
        self.change.show_value(None if change is None else _PERCENT_IN_TEN * change, digits=8)
        self.scale.setEnabled(project.picture is not None or project.source is not None)

    def _add_sets(self) -> None:
        row = QWidget(self)
        line = QHBoxLayout(row)
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(4)
        line.addWidget(self.sets, 1)
        self.menu_button.setText("…")
        self.menu_button.setIcon(icon("edit"))
        self.menu_button.setAccessibleName(self.tr("Change the sets of targets"))
        self.menu_button.setToolTip(self.tr("Add, rename or remove a set of targets; begin with public figures"))
        self.menu_button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self.menu_button)
        menu.addAction(self.tr("&Public figures…"), self._on_presets)
        menu.addSeparator()
        menu.addAction(self.tr("&Add a set…"), self._on_add)
        self.rename_action = menu.addAction(self.tr("&Rename…"), self._on_rename)
        self.remove_action = menu.addAction(self.tr("Re&move"), self._on_remove)
        self.menu_button.setMenu(menu)
        line.addWidget(self.menu_button)
        tip = self.tr("One set of targets for each start house: men, women, juniors")
        self.sets.setAccessibleName(self.tr("Set of targets"))
        self.panel.add_field(self._form, self.tr("Start house"), row, tip)
        self.sets.setToolTip(tip)
        self.sets.activated.connect(self._on_set)

    def _figure(self, text: str, tip: str) -> TargetField:
        field = TargetField(text, self.panel.refuse, self)
        self.panel.add_field(self._form, text, field, tip)
        return field

    def _add_mean(self) -> None:
        row = QWidget(self)
        line = QHBoxLayout(row)
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(4)
        for text, tip in (
            (self.tr("drop ÷ length"), self.tr("Height difference divided by the length in space")),
            (self.tr("drop ÷ plan"), self.tr("Height difference divided by the length in plan")),
            (self.tr("mean of segments"), self.tr("Mean of the gradients of all segments, as in the published method")),
        ):
            self.definition.addItem(text)
            self.definition.setItemData(self.definition.count() - 1, tip, Qt.ItemDataRole.ToolTipRole)
        tip = self.tr("How the mean gradient is defined: sources mean different things by it")
        self.definition.setAccessibleName(self.tr("Definition of the mean gradient"))
        self.definition.setToolTip(tip)
        self.definition.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.definition.setMinimumContentsLength(10)
        line.addWidget(self.mean, 2)
        line.addWidget(self.definition, 3)
        self.mean.setToolTip(self.tr("Leave it empty if it is unknown"))
        self.panel.add_field(self._form, self.tr("Mean gradient"), row, tip)
        self.definition.activated.connect(self._on_definition)

    def _add_limits(self) -> None:
        row = QWidget(self)
        line = QHBoxLayout(row)
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(4)
        line.addWidget(self.lowest)
        line.addWidget(self.highest)
        self.lowest.setToolTip(
            self.tr("No part of the track is flatter, or climbs more, than this; climbing is negative")
        )
        self.highest.setToolTip(self.tr("No part of the track is steeper than this"))
        tip = self.tr("Smallest and largest gradient, downhill positive")
        self.panel.add_field(self._form, self.tr("Gradient limits"), row, tip)

    def _add_change(self) -> None:
        self.change.setPlaceholderText(self.tr("not limited"))
        tip = self.tr(
            "How fast the gradient may change, for the band of possible elevations and where to measure next;"
            " 2 % in 10 m is usual. Results do not depend on it"
        )
        self.panel.add_field(self._form, self.tr("Change in 10 m") + ", %", self.change, tip)

    def _add_scale(self) -> None:
        self.scale.addItems([self.tr("known"), self.tr("unknown: find the factor f")])
        tip = self.tr("If the scale of the plan is unknown, it is found from the length")
        self.panel.add_field(self._form, self.tr("Plan scale"), self.scale, tip)
        self.scale.activated.connect(self._on_scale)

    def _labels(self) -> None:
        """Write the unit behind each label."""
        unit = self.desk.quantities
        fields: tuple[tuple[QWidget | None, str, str], ...] = (
            (self.length, self.tr("Length (3D)"), unit.length_unit),
            (self.drop, self.tr("Height difference"), unit.length_unit),
            (self.mean.parentWidget(), self.tr("Mean gradient"), unit.gradient_unit),
            (self.lowest.parentWidget(), self.tr("Gradient limits"), unit.gradient_unit),
        )
        for field, text, sign in fields:
            label = None if field is None else self._form.labelForField(field)
            if isinstance(label, QLabel):
                label.setText(f"{text}, {sign}")

    def _on_units(self) -> None:
        self._labels()
        self.refresh(self.desk.session.project)

    def _on_set(self, index: int) -> None:
        from bobdesk.project import edits

        self.desk.session.apply(self.tr("Choose targets"), lambda project: edits.choose_target_set(project, index))

    def _on_add(self) -> None:
        from bobdesk.project import edits

        name = self._asked_name(self.tr("Add a set of targets"), "")
        if name:
            begun = replace(self.desk.session.project.targets, name=name)
            self.desk.session.apply(self.tr("Add targets"), lambda project: edits.add_target_set(project, begun))

    def _on_rename(self) -> None:
        from bobdesk.project import edits

        name = self._asked_name(self.tr("Rename the set of targets"), self.desk.session.project.targets.name)
        if name:
            self.desk.session.apply(self.tr("Rename targets"), lambda project: edits.name_target_set(project, name))

    def _on_remove(self) -> None:
        from bobdesk.project import edits

        index = self.desk.session.project.chosen_targets
        self.desk.session.apply(self.tr("Remove targets"), lambda project: edits.remove_target_set(project, index))

    def _asked_name(self, title: str, before: str) -> str:
        name, wanted = QInputDialog.getText(self, title, self.tr("Name, such as the start house:"), text=before)
        return name.strip() if wanted else ""

    def _on_presets(self) -> None:
        dialog = PresetDialog(self.desk.quantities, self)
        dialog.taken.connect(self.take_preset)
        dialog.open()

    def take_preset(self, preset: Preset) -> None:
        """Begin with the public figures that the user has looked at."""
        from bobdesk.project import edits

        def edit(project: Project) -> Project:
            project = edits.set_drop(edits.set_length(project, preset.length), preset.drop)
            project = edits.set_mean_gradient(project, preset.mean_gradient)
            if preset.max_gradient is None or preset.max_gradient <= project.limits.min_gradient:
                return project
            return edits.set_limits(project, project.limits.min_gradient, preset.max_gradient)

        self.desk.session.apply(self.tr("Figures of {name}").format(name=preset.name), edit)

    def _on_length(self, shown: float | None) -> None:
        from bobdesk.project import edits

        metres = None if shown is None else shown / self.desk.quantities.length_factor
        self._apply(self.tr("Length"), "length", lambda project: edits.set_length(project, metres), self.length)

    def _on_drop(self, shown: float | None) -> None:
        from bobdesk.project import edits

        metres = None if shown is None else shown / self.desk.quantities.length_factor
        self._apply(self.tr("Height difference"), "drop", lambda project: edits.set_drop(project, metres), self.drop)

    def _on_mean(self, shown: float | None) -> None:
        from bobdesk.project import edits

        if not self._is_gradient(shown):
            self._bring_back(self.mean)
            return
        mean = None if shown is None else self.desk.quantities.meant_gradient(shown)
        named = _DEFINITIONS[self.definition.currentIndex()]
        self._apply(
            self.tr("Mean gradient"), "mean", lambda project: edits.set_mean_gradient(project, mean, named), self.mean
        )

    def _on_definition(self, index: int) -> None:
        from bobdesk.project import edits

        taken = self.desk.session.apply(
            self.tr("Definition of the mean gradient"),
            lambda project: edits.set_mean_gradient(project, project.targets.mean_gradient, _DEFINITIONS[index]),
        )
        if not taken:
            self.refresh(self.desk.session.project)

    def _on_lowest(self, shown: float | None) -> None:
        limits = self.desk.session.project.limits
        self._limits(shown, self.desk.quantities.shown_gradient(limits.max_gradient), self.lowest)

    def _on_highest(self, shown: float | None) -> None:
        limits = self.desk.session.project.limits
        self._limits(self.desk.quantities.shown_gradient(limits.min_gradient), shown, self.highest)

    def _limits(self, low: float | None, high: float | None, field: TargetField) -> None:
        from bobdesk.project import edits
        from bobdesk.project.project import Limits

        unit, usual = self.desk.quantities, Limits()
        low = unit.shown_gradient(usual.min_gradient) if low is None else low
        high = unit.shown_gradient(usual.max_gradient) if high is None else high
        if not (self._is_gradient(low) and self._is_gradient(high)):
            self._bring_back(field)
            return
        if low >= high:
            self.panel.refuse(
                self.tr("The smallest gradient, {low}, must be less than the largest, {high}.").format(
                    low=self._as_typed(low), high=self._as_typed(high)
                )
            )
            self._bring_back(field)
            return
        lowest, highest = unit.meant_gradient(low), unit.meant_gradient(high)
        self._apply(
            self.tr("Gradient limits"), "limits", lambda project: edits.set_limits(project, lowest, highest), field
        )

    def _on_change(self, shown: float | None) -> None:
        from bobdesk.project import edits
        from bobdesk.project.target_edits import STEEPEST_CHANGE

        most = _PERCENT_IN_TEN * STEEPEST_CHANGE
        if shown is not None and not 0 < shown <= most:
            self.panel.refuse(
                self.tr("The change in 10 m must be more than 0 % and at most {most} %, not {typed} %.").format(
                    most=self.desk.quantities.number(most, 0), typed=number_to_edit(shown)
                )
            )
            self._bring_back(self.change)
            return
        change = None if shown is None else shown / _PERCENT_IN_TEN
        self._apply(
            self.tr("Largest change of gradient"),
            "change",
            lambda project: edits.set_gradient_change(project, change),
            self.change,
        )

    def _on_scale(self, index: int) -> None:
        from bobdesk.project import edits

        def known(project: Project) -> Project:
            number = project.calibration.metres_per_pixel
            if number is not None and project.source is None and not project.control_points:
                return edits.scale_by_number(project, number)
            return edits.scale_by_points(project)

        if index:
            self.desk.session.apply(self.tr("Find the scale"), edits.find_the_scale)
        else:
            self.desk.session.apply(self.tr("Scale is known"), known)

    def _apply(self, label: str, key: str, edit: object, field: TargetField) -> None:
        """Do an edit; one that is refused while typing puts the old figure back."""
        if not self.desk.session.apply(label, edit, key=f"targets {key}"):  # type: ignore[arg-type]
            self._bring_back(field)

    def _bring_back(self, field: TargetField) -> None:
        field.setModified(False)
        self.refresh(self.desk.session.project)

    def _is_gradient(self, shown: float | None) -> bool:
        """Return whether what was typed can be a gradient; tell it in the unit in which it was typed if not."""
        unit = self.desk.quantities
        steepest = unit.shown_gradient(STEEPEST_GRADIENT)
        if shown is None or abs(shown) <= steepest:
            return True
        self.panel.refuse(
            self.tr("A gradient must lie between −{most} and {most}, downhill positive, not at {typed}.").format(
                most=self._as_typed(round(steepest, 1)), typed=self._as_typed(shown)
            )
        )
        return False

    def _as_typed(self, shown: float) -> str:
        return f"{number_to_edit(shown, 8).replace('-', '−')} {self.desk.quantities.gradient_unit}"

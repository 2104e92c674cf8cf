"""Our curves beside a designer's list: where they begin, how long they are, and their radius."""

from __future__ import annotations

import math

from PySide6.QtWidgets import QSizePolicy

from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.segments.design import DesignPair, design_of
from bobdesk.ui.segments.operations import operations
from bobdesk.ui.widgets.columns_model import Column, ColumnsModel
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.spin import Spin
from bobdesk.ui.widgets.table import Table

_FAR_IN_LENGTH, _FAR_IN_RADIUS = 5.0, 0.15


class DesignPart(Part):
    """Shown while there is a list."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Compared with a design"))
        self._design = design_of(self.desk)
        self._operations = operations(self.desk)
        self._pairs: tuple[DesignPair, ...] = ()
        self.sentence = panel.add_label("", "muted", self.column)
        form = panel.add_form(self.column)
        self.offset = Spin(self.tr("Station 0 of the list lies at"), self)
        self.offset.setDecimals(1)
        self.offset.valueChanged.connect(self._on_offset)
        panel.add_field(
            form,
            self.tr("Station 0 of the list lies at"),
            self.offset,
            self.tr("Designers often count from the timing start, which lies behind the start block"),
        )
        unit = self.desk.quantities
        self.model = ColumnsModel(
            (
                Column(lambda: "#", self.tr("Number of the curve in the list"), lambda row: str(row + 1)),
                Column(
                    lambda: self.tr("From {unit}").format(unit=unit.length_unit),
                    self.tr("Where the designed curve begins on this line"),
                    lambda row: unit.length(self._pairs[row].curve.start + self._design.offset, unit=False),
                ),
                Column(
                    lambda: self.tr("Length {unit}").format(unit=unit.length_unit),
                    self.tr("Designed length"),
                    lambda row: unit.length(self._pairs[row].curve.length, unit=False),
                ),
                Column(lambda: self.tr("Ours"), self.tr("Length of our segment"), self._our_length),
                Column(
                    lambda: self.tr("Radius {unit}").format(unit=unit.length_unit),
                    self.tr("Designed radius"),
                    lambda row: unit.length(self._pairs[row].curve.radius, unit=False),
                ),
                Column(lambda: self.tr("Ours"), self.tr("Radius of our segment"), self._our_radius, marks=True),
                Column(lambda: self.tr("Δ %"), self.tr("Our radius less the designed one"), self._radius_off),
                Column(lambda: self.tr("Side"), self.tr("Which way it turns; ours where it differs"), self._side,
                       is_number=False),
            ),
            lambda: len(self._pairs),
            panel.refuse,
            stands_out=self._stands_out,
            parent=self,
        )  # fmt: skip
        self.table = Table(self.tr("Design and ours"), self.model, fewest_rows=3, most_rows=10, parent=self)
        self.table.clicked.connect(lambda index: self._show(index.row()))
        self.table.fit_columns(("88", "8,888.8", "888.8", "888.8", "888.8", "888.8", "−88.8", "rechts ≠ links"))
        self.column.addWidget(self.table)
        flow = panel.add_buttons(self.column)
        close = panel.button(flow, self.tr("Stop comparing"), self.tr("Take the list away"), "close")
        close.clicked.connect(self._design.close)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
        self._design.changed.connect(self.refresh)
        unit.changed.connect(self._on_units)
        self._on_units()

    def refresh(self) -> None:
        """Show the list beside the segments as they are now."""
        found = self._design.list
        self.setVisible(found is not None)
        self._pairs = self._design.pairs()
        self.model.refresh()
        if found is None:
            return
        missing = sum(pair.segment is None for pair in self._pairs)
        off = [abs(self._off(pair)) for pair in self._pairs if math.isfinite(self._off(pair))]
        if len(found.curves) == 1:
            text = (
                self.tr("{name}: 1 curve, which has no counterpart in this line")
                if missing
                else self.tr("{name}: 1 curve; its radius differs by {percent} %")
            )
        elif not off:
            text = self.tr("{name}: {count} curves, none of which has a counterpart in this line")
        else:
            text = self.tr(
                "{name}: {count} curves, {missing} without a counterpart; radii differ by {percent} % at the median"
            )
        median = sorted(off)[len(off) // 2] if off else math.nan
        self.sentence.setText(
            text.format(
                name=found.name,
                count=len(found.curves),
                missing=missing,
                percent=self.desk.quantities.number(100 * median, 1),
            )
        )
        self.offset.show_value(self._design.offset * self.desk.quantities.length_factor)

    def _on_units(self) -> None:
        unit = self.desk.quantities
        self.offset.setSuffix(f" {unit.length_unit}")
        self.offset.show_range(-5000 * unit.length_factor, 5000 * unit.length_factor)
        self.model.refresh_headings()
        self.refresh()

    def _on_offset(self, shown: float) -> None:
        self._design.offset = shown / self.desk.quantities.length_factor

    def _show(self, row: int) -> None:
        pair = self._pairs[row]
        if pair.index is not None and pair.index < len(alignment_now(self.desk).segments):
            curve = pair.curve
            self._operations.select(pair.index, station=curve.start + self._design.offset + 0.5 * curve.length)

    def _our_length(self, row: int) -> str:
        segment = self._pairs[row].segment
        return self.desk.quantities.length(None if segment is None else segment.length, unit=False)

    def _our_radius(self, row: int) -> str:
        return self.desk.quantities.length(self._pairs[row].radius, unit=False)

    def _radius_off(self, row: int) -> str:
        return self.desk.quantities.number(100 * self._off(self._pairs[row]), 1)

    def _side(self, row: int) -> str:
        pair = self._pairs[row]
        words = {"left": self.tr("left"), "right": self.tr("right")}
        designed = words.get(pair.curve.side or "", "")
        return (
            f"{designed} ≠ {words[pair.side]}" if pair.side and designed and pair.side != pair.curve.side else designed
        )

    def _off(self, pair: DesignPair) -> float:
        return math.nan if pair.radius is None else (pair.radius - pair.curve.radius) / pair.curve.radius

    def _stands_out(self, row: int) -> str:
        pair = self._pairs[row]
        if pair.segment is None:
            return self.tr("No curve of ours lies here.")
        if pair.curve.side is not None and pair.side != pair.curve.side:
            return self.tr("Ours turns the other way.")
        if abs(self._off(pair)) > _FAR_IN_RADIUS and abs(pair.segment.length - pair.curve.length) > _FAR_IN_LENGTH:
            return self.tr("Radius and length differ from the design.")
        return ""

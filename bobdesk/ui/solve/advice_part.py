"""Where one more known elevation would help most, and one click to put it there."""

from __future__ import annotations

from PySide6.QtWidgets import QPushButton

from bobdesk.ui.solve.known_part import KnownPart
from bobdesk.ui.solve.open_data import open_data_of
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part


class AdvicePart(Part):
    """Asked for with a button; from then on the answer follows each edit."""

    def __init__(self, panel: Panel, known: KnownPart) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Where to measure next"))
        self.heading.hide()
        self.column.setContentsMargins(0, 0, 0, 0)
        self._known = known
        self._open = open_data_of(self.desk)
        flow = panel.add_buttons(self.column)
        self.ask_button: QPushButton = panel.button(
            flow,
            self.tr("Where would one more help most?"),
            self.tr("Show the station whose elevation, once known, makes all others surest"),
            "elevation",
        )
        self.ask_button.setCheckable(True)
        self.ask_button.setChecked(self._open.wants_advice)
        self.add_button: QPushButton = panel.button(
            flow, self.tr("Add it there"), self.tr("Add a known elevation at that station, and type it"), "plus"
        )
        self.sentence = panel.add_label("", "muted", self.column)
        self.ask_button.toggled.connect(self._open.want_advice)
        self.add_button.clicked.connect(self._on_add)
        self._open.changed.connect(self._show)
        self.desk.quantities.changed.connect(self._show)
        self._show()

    def _show(self) -> None:
        found, unit = self._open.advice, self.desk.quantities
        current = self._open.is_current("advice")
        self.add_button.setVisible(found is not None)
        self.add_button.setEnabled(current)
        self.sentence.setVisible(self._open.wants_advice)
        if found is not None and current:
            text = self.tr(
                "At {station}: the smooth profiles that are possible spread by {before} (root mean square), with it by"
                " {after}; and the band of the limits alone, {width} wide on the mean, gets {gain} narrower."
            )
            self.sentence.setText(
                text.format(
                    station=unit.length(self._own_station(), 0),
                    before=unit.length(found.spread),
                    after=unit.length(found.spread_after),
                    width=unit.length(found.band.mean_width),
                    gain=unit.length(found.gain),
                )
            )
        elif not current:
            self.sentence.setText(self.tr("Looking …"))
        else:
            self.sentence.setText(self._open.problem("advice") or self.tr("A centreline comes first."))

    def _own_station(self) -> float:
        from bobdesk.project.derive_open import own_station

        found = self._open.advice
        return 0.0 if found is None else own_station(self.desk.session.project, found)

    def _on_add(self) -> None:
        if self._open.advice is not None:
            self._known.begin(self._own_station())

"""Choose a known track's public figures, and confirm that they are only a beginning."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QDialog, QDialogButtonBox, QLabel, QVBoxLayout, QWidget

from bobdesk.ui.dialogs.guide_in_dialog import offer_guide
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.solve.presets import presets
from bobdesk.ui.widgets.columns_model import Column, ColumnsModel
from bobdesk.ui.widgets.table import Table


class PresetDialog(QDialog):
    """A table of tracks; the figures are taken once the user has said that they were compared with a source.

    Signals
    -------
    taken
        The `Preset` that the user wants.
    """

    taken = Signal(object)

    def __init__(self, quantities: Quantities, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._unit = quantities
        self.setWindowTitle(self.tr("Public figures"))
        self.setAccessibleName(self.windowTitle())
        self.resize(620, 520)
        column = QVBoxLayout(self)
        intro = QLabel(
            self.tr(
                "Published figures of known tracks, gathered second hand. Sources disagree by a few per cent, often"
                " because the drop is to the finish or to the lowest point."
            ),
            self,
        )
        intro.setWordWrap(True)
        column.addWidget(intro)
        self._found = presets()
        self.table = Table(
            self.tr("Tracks"),
            ColumnsModel(self._columns(), lambda: len(self._found), lambda _sentence: None, parent=self),
            most_rows=12,
            parent=self,
        )
        self.table.setSelectionMode(Table.SelectionMode.SingleSelection)
        self.table.fit_columns(("Pyeongchang (Alpensia) x", "88,888.8 m", "888.88 m", "88.88 %", "88.88 %", "88"))
        column.addWidget(self.table)
        self.confirmed = QCheckBox(self.tr("I shall compare these figures with a source of my own"), self)
        column.addWidget(self.confirmed)
        self._buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel, self)
        self.take_button = self._buttons.addButton(
            self.tr("Begin with these figures"), QDialogButtonBox.ButtonRole.AcceptRole
        )
        column.addWidget(self._buttons)
        self._buttons.accepted.connect(self._on_accepted)
        self._buttons.rejected.connect(self.reject)
        offer_guide(self, self._buttons)
        self.confirmed.toggled.connect(self._refresh)
        self.table.selectionModel().selectionChanged.connect(self._refresh)
        self.finished.connect(self.deleteLater)
        self._refresh()

    def _columns(self) -> tuple[Column, ...]:
        unit = self._unit
        return (
            Column(lambda: self.tr("Track"), self.tr("Name of the track"), lambda row: self._found[row].name,
                   is_number=False),
            Column(lambda: self.tr("Length"), self.tr("Race length"),
                   lambda row: unit.length(self._found[row].length, 1)),
            Column(lambda: self.tr("Drop"), self.tr("Height difference"),
                   lambda row: unit.length(self._found[row].drop, 1)),
            Column(lambda: self.tr("Mean grad."), self.tr("Mean gradient"),
                   lambda row: unit.gradient(self._found[row].mean_gradient)),
            Column(lambda: self.tr("Max grad."), self.tr("Largest gradient"),
                   lambda row: unit.gradient(self._found[row].max_gradient, 1)),
            Column(lambda: self.tr("Curves"), self.tr("Number of curves"), lambda row: str(self._found[row].curves)),
        )  # fmt: skip

    def _refresh(self) -> None:
        chosen = bool(self.table.selectionModel().selectedRows())
        self.take_button.setEnabled(chosen and self.confirmed.isChecked())

    def _on_accepted(self) -> None:
        rows = self.table.selectionModel().selectedRows()
        if rows:
            self.taken.emit(self._found[rows[0].row()])
        self.accept()

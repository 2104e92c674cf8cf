"""The table of segments: sorted as one likes, selected together with plan and strips, copied into a spreadsheet."""

from __future__ import annotations

from PySide6.QtCore import QItemSelection, QItemSelectionModel, QSortFilterProxyModel, Qt
from PySide6.QtGui import QContextMenuEvent, QGuiApplication, QKeyEvent, QKeySequence
from PySide6.QtWidgets import QAbstractItemView, QMenu, QWidget

from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.segments.kind_delegate import KindDelegate
from bobdesk.ui.segments.segments_model import KIND, SORT_ROLE, SegmentsModel
from bobdesk.ui.table_text import table_text
from bobdesk.ui.widgets.table import Table

_SAMPLES = {
    "#": "300", "from": "8,888.8", "to": "8,888.8", "length": "888.8", "radius": "888.8", "lock": "MM",
    "name": "Labyrinth 12", "side": "rechts", "turn": "888.8°", "gradient": "−88.88", "drop": "888.88", "fit": "88.88",
}  # fmt: skip


class SegmentsTable(Table):
    """Follows the one selection of the window."""

    def __init__(self, desk: Desk, parent: QWidget | None = None) -> None:
        self._desk = desk
        self._now = alignment_now(desk)
        self.segments = SegmentsModel(desk, parent)
        self._sorted = QSortFilterProxyModel(parent)
        self._sorted.setSourceModel(self.segments)
        self._sorted.setSortRole(SORT_ROLE)
        self._is_following = False
        super().__init__("", self._sorted, fewest_rows=8, most_rows=16, parent=parent)
        self.setAccessibleName(self.tr("Segments"))
        # Letters are keys of actions here (X, C, O, L), so they do not begin to edit.
        self.setEditTriggers(QAbstractItemView.EditTrigger.DoubleClicked | QAbstractItemView.EditTrigger.EditKeyPressed)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setItemDelegateForColumn(self.segments.column(KIND), KindDelegate(self.segments.kinds(), self))
        self.setSortingEnabled(True)
        self.sortByColumn(0, Qt.SortOrder.AscendingOrder)
        self.horizontalHeader().setSectionsMovable(True)
        self.actions_shown: list[object] = []
        self._fit()
        self.selectionModel().selectionChanged.connect(self._on_selected)
        self._sorted.modelReset.connect(self._follow)
        self._sorted.layoutChanged.connect(self._follow)
        desk.selection.segments_changed.connect(self._follow)
        desk.quantities.changed.connect(self._fit)
        self._follow()

    def copy(self) -> None:
        """Copy the selected rows, or all, as a spreadsheet takes them."""
        rows = [self._row_of(index.row()) for index in self.selectionModel().selectedRows()]
        chosen = sorted(rows) or list(range(self.segments.rowCount()))
        lines = [self.segments.headings(), *(self.segments.row_texts(row) for row in chosen)]
        QGuiApplication.clipboard().setText(table_text(lines))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Copy with the usual key."""
        if event.matches(QKeySequence.StandardKey.Copy):
            self.copy()
        else:
            super().keyPressEvent(event)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Repeat every edit with its key."""
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        for action in self.actions():
            if action.isEnabled():
                menu.addAction(action)
        menu.addSeparator()
        menu.addAction(self.tr("Copy as table\tCtrl+C"), self.copy)
        menu.popup(event.globalPos())

    def _fit(self) -> None:
        widest = max((word for _, word in self.segments.kinds()), key=len)
        samples = [_SAMPLES.get(self._name(number), f"MMM {widest}") for number in range(self.segments.columnCount())]
        self.fit_columns(tuple(samples))

    def _name(self, number: int) -> str:
        return next((name for name in _SAMPLES if self.segments.column(name) == number), KIND)

    def _row_of(self, shown: int) -> int:
        return self._sorted.mapToSource(self._sorted.index(shown, 0)).row()

    def _on_selected(self) -> None:
        if self._is_following:
            return
        rows = [self._row_of(index.row()) for index in self.selectionModel().selectedRows()]
        segments, selection = self._now.segments, self._desk.selection
        self._is_following = True
        selection.segments = rows
        if len(rows) == 1 and rows[0] < len(segments):
            segment = segments[rows[0]]
            station = selection.station
            if station is None or not segment.start <= station <= segment.end:
                selection.station = 0.5 * (segment.start + segment.end)
        self._is_following = False

    def _follow(self) -> None:
        """Select what is selected elsewhere."""
        if self._is_following:
            return
        self._is_following = True
        chosen = QItemSelection()
        first = None
        for row in self._desk.selection.segments:
            if row < self.segments.rowCount():
                shown = self._sorted.mapFromSource(self.segments.index(row, 0))
                chosen.select(shown, shown)
                first = first or shown
        flags = QItemSelectionModel.SelectionFlag
        self.selectionModel().select(chosen, flags.ClearAndSelect | flags.Rows)
        if first is not None:
            self.selectionModel().setCurrentIndex(first, flags.NoUpdate)
            self.scrollTo(first.siblingAtColumn(0))
        self._is_following = False

"""The look and manners of every table in a panel."""

from __future__ import annotations

from PySide6.QtCore import QAbstractItemModel, QSize, Qt
from PySide6.QtGui import QFontMetrics, QKeySequence, QResizeEvent, QShortcut
from PySide6.QtWidgets import QAbstractButton, QAbstractItemView, QHeaderView, QTableView, QWidget

_ROOM_IN_ROW = 8
# Between the columns of a narrow table, pixels.
_CLOSEST = 10


class Table(QTableView):
    """As high as its rows, between a fewest and a most; Tab leaves it, F2 or typing edits.

    Parameters
    ----------
    name
        For screen readers.
    fewest_rows, most_rows
        Between which its height follows the rows.
    """

    def __init__(
        self,
        name: str,
        model: QAbstractItemModel,
        *,
        fewest_rows: int = 2,
        most_rows: int = 8,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._fewest, self._most = fewest_rows, most_rows
        self._needed: list[int] = []
        self._space = 0
        self._dispensable: tuple[int, ...] = ()
        self._without: tuple[int, ...] = ()
        self._is_fitting = False
        # Widths that somebody has drawn with the mouse stay.
        self._is_by_hand = False
        self.setAccessibleName(name)
        self.setModel(model)
        self.setAlternatingRowColors(False)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setHorizontalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setEditTriggers(
            QAbstractItemView.EditTrigger.DoubleClicked
            | QAbstractItemView.EditTrigger.EditKeyPressed
            | QAbstractItemView.EditTrigger.AnyKeyPressed
        )
        self.verticalHeader().hide()
        self.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        row = QFontMetrics(self.font()).height() + _ROOM_IN_ROW
        self.verticalHeader().setMinimumSectionSize(row)
        self.verticalHeader().setDefaultSectionSize(row)
        header = self.horizontalHeader()
        header.setHighlightSections(False)
        header.setMinimumSectionSize(24)
        header.setStretchLastSection(False)
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.sectionResized.connect(self._on_section_resized)
        for signal in (model.rowsInserted, model.rowsRemoved, model.modelReset):
            signal.connect(self._on_rows)
        self._fit_rows()

    def on_key(self, key: QKeySequence | QKeySequence.StandardKey | Qt.Key, button: QAbstractButton) -> None:
        """Let a key press a button while the table has the keyboard, and no cell of it is being edited."""
        shortcut = QShortcut(QKeySequence(key), self)
        shortcut.setContext(Qt.ShortcutContext.WidgetShortcut)
        shortcut.activated.connect(button.click)

    def fit_columns(self, samples: tuple[str, ...], *, dispensable: tuple[int, ...] = ()) -> None:
        """Make each column as wide as its heading and a sample, so that widths never ask 20,000 rows.

        In a narrow table columns sit closer; those that are `dispensable` go where even that is too wide.
        """
        self.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        metrics = QFontMetrics(self.font())
        head = QFontMetrics(self.horizontalHeader().font())
        self._needed = []
        for column, sample in enumerate(samples):
            heading = str(self.model().headerData(column, Qt.Orientation.Horizontal) or "")
            # Headings are bold by style sheet, which the metrics do not know.
            width = max(metrics.horizontalAdvance(sample), round(1.15 * head.horizontalAdvance(heading)))
            self._needed.append(width + _CLOSEST)
        self._space = 2 * metrics.averageCharWidth() + 4 - _CLOSEST
        self._dispensable = dispensable
        self._is_by_hand = False
        self._fit_width()

    def hide_columns(self, columns: tuple[int, ...]) -> None:
        """Hide columns that have nothing to show."""
        if columns != self._without:
            self._without = columns
            self._fit_width()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Let columns sit closer in a narrow table."""
        super().resizeEvent(event)
        if not self._is_by_hand:
            self._fit_width()

    def _fit_width(self) -> None:
        room = self.viewport().width()
        columns = [column for column in range(len(self._needed)) if column not in self._without]
        needed = sum(self._needed[column] for column in columns)
        gone = self._dispensable if needed > room else ()
        shown = [column for column in columns if column not in gone]
        left = room - sum(self._needed[column] for column in shown)
        space = min(max(left // max(len(shown), 1), 0), self._space)
        self._is_fitting = True
        for column in range(len(self._needed)):
            self.setColumnHidden(column, column not in shown)
            if column in shown:
                self.setColumnWidth(column, self._needed[column] + space)
        self._is_fitting = False

    def _on_section_resized(self) -> None:
        self._is_by_hand = self._is_by_hand or not self._is_fitting

    def sizeHint(self) -> QSize:
        """Be as high as the rows."""
        return QSize(200, self._height(self.model().rowCount()))

    def minimumSizeHint(self) -> QSize:
        """Never be higher than the panel needs."""
        return QSize(80, self._height(self._fewest))

    def _height(self, rows: int) -> int:
        shown = max(self._fewest, min(rows, self._most))
        bar = self.horizontalScrollBar().sizeHint().height()
        header = self.horizontalHeader().sizeHint().height()
        return header + shown * self.verticalHeader().defaultSectionSize() + bar + 2 * self.frameWidth()

    def _on_rows(self) -> None:
        self._fit_rows()

    def _fit_rows(self) -> None:
        self.setFixedHeight(self._height(self.model().rowCount()))
        self.updateGeometry()

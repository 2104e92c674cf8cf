"""How a table of numbers is read: separator, decimal sign, unit and columns."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QComboBox, QFormLayout, QLabel, QSizePolicy, QWidget

if TYPE_CHECKING:
    from bobdesk.files.importers.csv_points import CsvChoice
    from bobdesk.files.importers.preview import Preview

_NONE = -1
_NARROWEST = 9


class TableChoices(QWidget):
    """Shows how a table was read, and takes what the user knows better.

    Signals
    -------
    changed
        The user has chosen something: read the file anew.
    """

    changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.separator = self._box(
            self.tr("Separator"),
            self.tr("What stands between two columns"),
            (
                (self.tr("comma"), ","),
                (self.tr("semicolon"), ";"),
                (self.tr("tab"), "\t"),
                (self.tr("bar"), "|"),
                (self.tr("space"), " "),
            ),
        )
        self.decimal = self._box(
            self.tr("Decimal sign"),
            self.tr("What stands before the decimals"),
            ((self.tr("dot, 1.5"), "."), (self.tr("comma, 1,5"), ",")),
        )
        self.unit = self._box(
            self.tr("Unit"),
            self.tr("Unit of the coordinates in the file"),
            (
                (self.tr("metres"), "metres"),
                (self.tr("millimetres"), "millimetres"),
                (self.tr("feet"), "feet"),
                (self.tr("US survey feet"), "US survey feet"),
                (self.tr("degrees of longitude and latitude"), "degrees"),
            ),
        )
        self.x_column = self._box(self.tr("Column x"), self.tr("Which column is x, easting or longitude"), ())
        self.y_column = self._box(self.tr("Column y"), self.tr("Which column is y, northing or latitude"), ())
        self.z_column = self._box(self.tr("Column z"), self.tr("Which column is the elevation, if any"), ())
        self._form = QFormLayout(self)
        self._form.setContentsMargins(0, 0, 0, 0)
        self._form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        for box in (self.separator, self.decimal, self.unit, self.x_column, self.y_column, self.z_column):
            self._form.addRow(QLabel(box.accessibleName()), box)
        self.separator.activated.connect(self._on_dialect)
        self.decimal.activated.connect(self._on_dialect)
        for box in (self.unit, self.x_column, self.y_column, self.z_column):
            box.activated.connect(self.changed)
        self._dialect_said = False
        self._columns: tuple[str, ...] = ()

    def show_preview(self, found: Preview) -> None:
        """Show how a table was read."""
        names = ("comma", "semicolon", "tab", "bar", "space")
        self._choose(self.separator, (",", ";", "\t", "|", " ")[names.index(found.separator or "comma")])
        self._choose(self.decimal, found.decimal or ".")
        # one column may be chosen while the other still is not
        half = tuple(_data(box) for box in (self.x_column, self.y_column, self.z_column))
        x, y, z = found.chosen or (half if found.columns == self._columns else (_NONE, _NONE, None))
        self._columns = found.columns
        self._fill(self.x_column, x, self.tr("choose…"))
        self._fill(self.y_column, y, self.tr("choose…"))
        self._fill(self.z_column, _NONE if z is None else z, self.tr("none"))

    def choice(self) -> CsvChoice:
        """Return what the user says of the table."""
        from bobdesk.files.importers.csv_points import CsvChoice
        from bobdesk.files.importers.dialect import Dialect

        dialect = Dialect(self.separator.currentData(), self.decimal.currentData()) if self._dialect_said else None
        x, y, z = (_data(box) for box in (self.x_column, self.y_column, self.z_column))
        columns = None if x == _NONE or y == _NONE else (x, y, None if z == _NONE else z)
        return CsvChoice(dialect, columns, self.unit.currentData())

    def title_of(self, column: int) -> str:
        """Return what a column is read as: "x", "y", "z" or ""."""
        for box, name in ((self.x_column, "x"), (self.y_column, "y"), (self.z_column, "z")):
            if _data(box) == column:
                return name
        return ""

    def _on_dialect(self) -> None:
        self._dialect_said = True
        # Other columns come of it: they are found by their names again.
        for box in (self.x_column, self.y_column, self.z_column):
            with QSignalBlocker(box):
                box.clear()
        self.changed.emit()

    def _fill(self, box: QComboBox, column: int, none: str) -> None:
        with QSignalBlocker(box):
            box.clear()
            box.addItem(none, _NONE)
            for index, title in enumerate(self._columns):
                shown = title if title and not title.isdigit() else self.tr("column {number}").format(number=index + 1)
                box.addItem(shown, index)
            box.setCurrentIndex(max(0, box.findData(column)))

    def _choose(self, box: QComboBox, value: Any) -> None:
        with QSignalBlocker(box):
            box.setCurrentIndex(max(0, box.findData(value)))

    def _box(self, name: str, tip: str, choices: tuple[tuple[str, Any], ...]) -> QComboBox:
        box = QComboBox()
        box.setAccessibleName(name)
        box.setToolTip(tip)
        box.setMinimumContentsLength(_NARROWEST)
        box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        box.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        for text, value in choices:
            box.addItem(text, value)
        return box


def _data(box: QComboBox) -> int:
    value = box.currentData()
    return value if isinstance(value, int) else _NONE

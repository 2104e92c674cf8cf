"""Tables of distances: those that the scale is fitted to, and those that only check it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from PySide6.QtCore import Qt

from bobdesk.errors import InputError
from bobdesk.plan.control_points import KnownDistance
from bobdesk.project.project import Project
from bobdesk.ui.panels.worst_item import WorstItem
from bobdesk.ui.widgets.columns_model import Column, ColumnsModel
from bobdesk.ui.widgets.notice_box import NoticeBox
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.table import Table
from bobdesk.ui.widgets.typed_number import number_to_edit, typed_number

_PARTS_ENDS = "/"


@dataclass(frozen=True)
class DistanceKind:
    """What differs between the two tables.

    Attributes
    ----------
    heading, empty, add_tip
        Texts.
    items
        The distances of a project.
    change, remove
        The edits of the distance at an index.
    change_label, remove_label
        For Undo.
    can_be_off
        Whether they have a check box.
    tool, icon
        The plan view's tool that adds one.
    """

    heading: str
    empty: str
    add_tip: str
    items: Callable[[Project], tuple[KnownDistance, ...]]
    change: Callable[[Project, int, KnownDistance], Project]
    remove: Callable[[Project, int], Project]
    change_label: str
    remove_label: str
    can_be_off: bool
    tool: str
    icon: str


class DistancesPart(Part):
    """A row for each distance."""

    def __init__(self, panel: Panel, kind: DistanceKind) -> None:
        super().__init__(panel)
        self._worst: WorstItem | None = None
        self.name_it(kind.heading)
        self._kind = kind
        self._metres_per_pixel: float | None = None
        self.model = ColumnsModel(
            self._columns(),
            lambda: len(self._items),
            panel.refuse,
            stands_out=self._why_it_stands_out,
            is_faint=lambda row: not self._items[row].used,
            parent=self,
        )
        self.table = Table(kind.heading, self.model, fewest_rows=1, most_rows=5, parent=self)
        self.table.setSelectionMode(Table.SelectionMode.SingleSelection)
        self.column.addWidget(self.table)
        self.hint = panel.add_label(kind.empty, "muted", self.column)
        flow = panel.add_buttons(self.column)
        self.add_button = panel.button(flow, self.tr("Add distance"), kind.add_tip, kind.icon)
        self.add_button.clicked.connect(lambda: panel.tool_wanted.emit(kind.tool))
        self.show_button = panel.button(flow, self.tr("Show"), self.tr("Show the selected distance in the plan"), "eye")
        self.show_button.clicked.connect(self._show_selected)
        self.remove_button = panel.button(
            flow, self.tr("Remove"), self.tr("Take the selected distance away (Del)"), "delete"
        )
        self.remove_button.clicked.connect(self._remove_selected)
        self.table.on_key(Qt.Key.Key_Delete, self.remove_button)
        self.worst_box = NoticeBox(self)
        self.column.addWidget(self.worst_box)
        self.table.selectionModel().selectionChanged.connect(self._on_selected)
        self.model.modelReset.connect(self._on_selected)
        self.desk.quantities.changed.connect(self.model.refresh_headings)

    @property
    def _items(self) -> tuple[KnownDistance, ...]:
        return self._kind.items(self.desk.session.project)

    @property
    def selected_row(self) -> int | None:
        """The selected row, if any."""
        rows = self.table.selectionModel().selectedRows()
        return rows[0].row() if rows else None

    def refresh(self, project: Project, metres_per_pixel: float | None, worst: WorstItem | None = None) -> None:
        """Show the distances of a project.

        Parameters
        ----------
        metres_per_pixel
            Of the scale in force, None while there is none.
        worst
            What spoils the fit, if these distances take part in it.
        """
        self._worst = worst if worst is not None and worst.kind == "distance" else None
        self._metres_per_pixel = metres_per_pixel
        self.model.refresh()
        some = bool(self._kind.items(project))
        self.table.setVisible(some)
        self.hint.setVisible(not some)
        self.show_button.setVisible(some)
        self.remove_button.setVisible(some)
        self._say_worst()
        self._on_selected()

    def _columns(self) -> tuple[Column, ...]:
        unit = self.desk.quantities

        def end(heading: str, tip: str, field: str) -> Column:
            def text(row: int) -> str:
                x, y = getattr(self._items[row], field)
                return f"{unit.number(x, 1)} {_PARTS_ENDS} {unit.number(y, 1)}"

            def edit_text(row: int) -> str:
                x, y = getattr(self._items[row], field)
                return f"{number_to_edit(x)} {_PARTS_ENDS} {number_to_edit(y)}"

            def change(row: int, typed: str) -> bool:
                return self._change(row, **{field: _typed_place(typed)})

            return Column(lambda: heading, tip, text, edit_text, change)

        columns = (
            Column(
                lambda: self.tr("From – to"),
                self.tr("Name of the distance"),
                lambda row: self._items[row].name or str(row + 1),
                lambda row: self._items[row].name,
                lambda row, text: self._change(row, name=text.strip()),
                is_number=False,
            ),
            Column(
                lambda: self.tr("Plan {unit}").format(unit=unit.length_unit),
                self.tr("What the plan gives in the scale in force"),
                lambda row: unit.length(self._plan_m(row), 2, unit=False),
            ),
            Column(
                lambda: self.tr("Known {unit}").format(unit=unit.length_unit),
                self.tr("Known distance, measured horizontally"),
                lambda row: unit.length(self._items[row].length_m, 2, unit=False),
                lambda row: number_to_edit(self._items[row].length_m * unit.length_factor),
                lambda row, text: self._change(row, length_m=typed_number(text) / unit.length_factor),
            ),
            Column(
                lambda: self.tr("Difference"),
                self.tr("Plan minus known"),
                self._difference,
                marks=True,
            ),
            end(self.tr("From px"), self.tr("Where it begins in the picture: x / y, pixels"), "start_px"),
            end(self.tr("To px"), self.tr("Where it ends in the picture: x / y, pixels"), "end_px"),
        )
        if not self._kind.can_be_off:
            return columns
        used = Column(
            lambda: "",
            self.tr("Whether the scale is fitted to the distance"),
            lambda _row: "",
            is_checked=lambda row: self._items[row].used,
            check=lambda row, used: self._change(row, used=used),
            is_number=False,
        )
        return (used, *columns)

    def _plan_m(self, row: int) -> float | None:
        return None if self._metres_per_pixel is None else self._items[row].length_px * self._metres_per_pixel

    def _difference(self, row: int) -> str:
        plan = self._plan_m(row)
        return self.desk.quantities.length(None if plan is None else plan - self._items[row].length_m, 2, unit=False)

    def _change(self, row: int, **values: Any) -> bool:
        known = replace(self._items[row], **values)
        return self.desk.session.apply(self._kind.change_label, lambda before: self._kind.change(before, row, known))

    def _on_selected(self) -> None:
        chosen = self.selected_row is not None
        self.show_button.setEnabled(chosen)
        self.remove_button.setEnabled(chosen)

    def _why_it_stands_out(self, row: int) -> str:
        if self._worst is None or self._worst.row != row:
            return ""
        return self.tr("This distance disagrees with the rest.")

    def _say_worst(self) -> None:
        worst = self._worst
        if worst is None:
            self.worst_box.say("")
            return
        length = self.desk.quantities.length
        text = self.tr("Distance {name} disagrees with the rest. Without it the RMS falls from {now} to {then}.")
        row = worst.row
        self.worst_box.say(
            text.format(
                name=self._items[row].name or row + 1,
                now=length(worst.rms_m, 2),
                then=length(worst.rms_without_m, 2),
            ),
            (
                (self.tr("Switch it off"), lambda: self._change(row, used=False)),
                (self.tr("Show it"), lambda: self._show(row)),
            ),
        )

    def _remove_selected(self) -> None:
        row = self.selected_row
        if row is not None:
            self.desk.session.apply(self._kind.remove_label, lambda before: self._kind.remove(before, row))

    def _show_selected(self) -> None:
        if self.selected_row is not None:
            self._show(self.selected_row)

    def _show(self, row: int) -> None:
        if row < len(self._items):
            known = self._items[row]
            middle = [(a + b) / 2 for a, b in zip(known.start_px, known.end_px, strict=True)]
            self.panel.place_wanted.emit(middle[0], middle[1])


def _typed_place(text: str) -> tuple[float, float]:
    parts = text.replace(";", _PARTS_ENDS).split(_PARTS_ENDS)
    if len(parts) != 2:
        raise InputError("a place in the picture is two numbers, x / y")
    return typed_number(parts[0]), typed_number(parts[1])

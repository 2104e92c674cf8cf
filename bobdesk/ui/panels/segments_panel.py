"""Step 4: how segments are found, what can be done to them, and all of them in a table."""

from __future__ import annotations

from typing import Protocol

from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QPushButton, QWidget

from bobdesk.sentences import as_sentence
from bobdesk.ui.actions.segment_actions import OF_SEGMENTS
from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.segments.automatic_part import AutomaticPart
from bobdesk.ui.segments.design_part import DesignPart
from bobdesk.ui.segments.operations import operations
from bobdesk.ui.segments.rules_part import RulesPart
from bobdesk.ui.segments.segments_table import SegmentsTable
from bobdesk.ui.widgets.panel import Panel

TABLE_ACTIONS = ("split_segment", "merge_segments", "flip_kind", "lock_segment", "delete_boundary", "number_curves")
AUTOMATIC_ACTIONS = ("detect_again", "automatic_segments")
FILE_ACTIONS = ("open_segments", "save_segments", "compare_with_design")


class ActionsByName(Protocol):
    """Hands out actions."""

    def __getitem__(self, name: str, /) -> QAction:
        """Return an action."""


class SegmentsPanel(Panel):
    """The panel of the segments.

    Parameters
    ----------
    actions
        QActions by name: those of `bobdesk.ui.actions.segment_actions`.
    """

    def __init__(self, desk: Desk, actions: ActionsByName, parent: QWidget | None = None) -> None:
        super().__init__(desk, parent)
        self.name_it(self.tr("Segments"))
        self._now = alignment_now(desk)
        self._operations = operations(desk)
        self._actions = actions
        self.problem = self.add_label("", "error")
        self.automatic = AutomaticPart(self)
        self._add_row(AUTOMATIC_ACTIONS)
        self._at = self.add_label("", "heading")
        self._add_row(TABLE_ACTIONS)
        self.table = SegmentsTable(desk, self)
        for name in OF_SEGMENTS:
            self.table.addAction(actions[name])
        self.column.addWidget(self.table)
        self._add_row(FILE_ACTIONS)
        self.design = DesignPart(self)
        self.rules = RulesPart(self)
        self.column.addStretch(1)
        self._now.changed.connect(self.refresh)
        desk.selection.station_changed.connect(self._show_place)
        desk.selection.segments_changed.connect(self._show_place)
        desk.selection.boundary_changed.connect(self._show_place)
        desk.quantities.changed.connect(self._show_place)
        self.refresh()

    def refresh(self) -> None:
        """Say how many segments there are, and how many were corrected."""
        segments = self._now.segments
        self.problem.setVisible(self._now.problem is not None)
        problem = as_sentence(self._now.problem)
        self.problem.setText(problem)
        if not segments:
            self.say("" if problem else self.tr("Segments are found as soon as there is a line."))
        else:
            by_hand = sum(segment.by_hand for segment in segments)
            locked = sum(segment.locked for segment in segments)
            parts = [self._counts()]
            if by_hand:
                parts.append(self.tr("{count} made by hand").format(count=by_hand))
            if locked:
                parts.append(self.tr("{count} locked").format(count=locked))
            if not by_hand and not locked:
                parts.append(self.tr("found automatically"))
            self.say(" · ".join(parts))
        self._show_place()

    def _counts(self) -> str:
        segments = self._now.segments
        curves = sum(segment.kind == "curve" for segment in segments)
        if len(segments) == 1:
            return self.tr("1 segment, a curve") if curves else self.tr("1 segment, a straight")
        if curves == 0:
            text = self.tr("{count} segments, none of them a curve")
        elif curves == 1:
            text = self.tr("{count} segments, 1 of them a curve")
        elif curves == len(segments):
            text = self.tr("{count} segments, all of them curves")
        else:
            text = self.tr("{count} segments, {curves} of them curves")
        return text.format(count=len(segments), curves=curves)

    def _show_place(self) -> None:
        station, chosen = self.desk.selection.station, self._operations.chosen()
        boundary, selected = self.desk.selection.boundary, self.desk.selection.segments
        if boundary is not None and len(selected) != 1 and boundary < len(self._now.segments) - 1:
            text = self.tr("Boundary at {station}, between segments {before} and {behind}").format(
                station=self.desk.quantities.length(self._now.segments[boundary].end),
                before=boundary + 1,
                behind=boundary + 2,
            )
        elif len(selected) > 1:
            text = self.tr("{count} segments selected").format(count=len(selected))
        elif station is None:
            text = self.tr("Nothing selected")
        elif chosen:
            text = self.tr("At {station}, segment {number}").format(
                station=self.desk.quantities.length(station), number=chosen[0] + 1
            )
        else:
            text = self.tr("At {station}").format(station=self.desk.quantities.length(station))
        self._at.setText(text)

    def _add_row(self, names: tuple[str, ...]) -> None:
        flow = self.add_buttons()
        for name in names:
            action = self._actions[name]
            key = action.shortcut().toString(QKeySequence.SequenceFormat.NativeText)
            text = action.text().replace("&", "").removesuffix("…")
            button = self.button(flow, f"{text}  {key}" if key else text, action.toolTip())
            self._follow(button, action)

    def _follow(self, button: QPushButton, action: QAction) -> None:
        button.clicked.connect(action.trigger)
        button.setIcon(action.icon())
        button.setEnabled(action.isEnabled())

        def changed() -> None:
            button.setEnabled(action.isEnabled())
            button.setIcon(action.icon())

        action.changed.connect(changed)

"""The tools of the plan view."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QObject

from bobdesk.ui.actions.action import Action, MenuName
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.view import PlanView


class ToolActions(QObject):
    """One row a tool; the one in hand is checked."""

    def __init__(self, desk: Desk, view: PlanView, parent: QObject) -> None:
        super().__init__(parent)
        self._desk = desk
        self._view = view

    def table(self) -> tuple[Action, ...]:
        """Return the rows."""
        return (
            self._row("select", self.tr("&Select"), "S", "select", self.tr("Select, move and insert vertices"), "Edit"),
            self._row(
                "draw", self.tr("&Draw by clicks"), "A", "draw", self.tr("Draw the line click by click, or continue it")
            ),
            self._row(
                "live_wire",
                self.tr("&Follow the line (live-wire)"),
                "T",
                "live-wire",
                self.tr("Follow the drawn line from click to click; a preview shows what the next click takes"),
            ),
            self._row(
                "auto_trace",
                self.tr("&Trace automatically"),
                "Shift+T",
                "auto-trace",
                self.tr("Click start and finish: the line between them is traced"),
            ),
            self._row(
                "two_edges",
                self.tr("Trace two &edges"),
                "E",
                "two-edges",
                self.tr("Trace both edges of the track one after the other; the line goes in the middle"),
            ),
            self._row(
                "set_start",
                self.tr("Set s&tart"),
                "G",
                "start-flag",
                self.tr("Put the start flag on the line"),
                "Track",
            ),
            self._row(
                "set_finish",
                self.tr("Set f&inish"),
                "Shift+G",
                "finish-flag",
                self.tr("Put the finish flag on the line"),
                "Track",
            ),
            self._row(
                "cut",
                self.tr("&Cut the final climb"),
                "Shift+X",
                "cut",
                self.tr("Cut the line where it climbs for good, so that it ends at its lowest point"),
                "Track",
            ),
            self._row(
                "calibrate",
                self.tr("Add control &points"),
                "K",
                "calibrate",
                self.tr("Click a place whose position is known, or drag a control point"),
            ),
            self._row(
                "known_distance",
                self.tr("Give a &known distance"),
                "Shift+K",
                "distance",
                self.tr("Click both ends of a distance that is known, and type its length"),
            ),
            self._row(
                "measure",
                self.tr("&Measure"),
                "M",
                "measure",
                self.tr("Measure distances and angles in the plan"),
                "View",
            ),
            self._row(
                "boundaries",
                self.tr("Correct &boundaries"),
                "B",
                "segments",
                self.tr("Select segments and drag their boundaries along the line"),
                "Segments",
            ),
        )

    def _row(self, name: str, text: str, key: str, icon: str, tip: str, menu: MenuName = "Plan") -> Action:
        return Action(
            f"tool_{name}",
            text,
            lambda _checked: self._view.set_tool(name),
            (key,),
            icon,
            tip,
            menu,
            "tools",
            "canvas",
            enabled=self._has_plan if name in _WITH_LINE_OR_PICTURE else self._has_picture,
            checked=partial(self._is_in_hand, name),
            context=name in _IN_CONTEXT,
            tool_bar=True,
        )

    def _is_in_hand(self, name: str) -> bool:
        return self._view.tool_name == name

    def _has_picture(self) -> bool:
        project = self._desk.session.project
        return project.picture is not None and project.source is None

    def _has_plan(self) -> bool:
        project = self._desk.session.project
        return project.picture is not None or project.source is not None or project.trace is not None


_WITH_LINE_OR_PICTURE = ("select", "measure", "set_start", "set_finish", "cut", "boundaries")
_IN_CONTEXT = ("select", "draw", "live_wire", "auto_trace", "set_start", "set_finish", "measure", "calibrate")

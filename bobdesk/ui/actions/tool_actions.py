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
        tr = self.tr
        return (
            self._row("select", tr("&Select"), "S", "select", tr("Select, move and insert vertices"), "Edit"),
            self._row("draw", tr("&Draw by clicks"), "A", "draw", tr("Draw the line click by click, or continue it")),
            self._row(
                "live_wire",
                tr("&Follow the line (live-wire)"),
                "T",
                "live-wire",
                tr("Follow the drawn line from click to click; a preview shows what the next click takes"),
            ),
            self._row(
                "auto_trace",
                tr("&Trace automatically"),
                "Shift+T",
                "auto-trace",
                tr("Click start and finish: the line between them is traced"),
            ),
            self._row(
                "two_edges",
                tr("Trace two &edges"),
                "E",
                "two-edges",
                tr("Trace both edges of the track one after the other; the line goes in the middle"),
            ),
            self._row("set_start", tr("Set s&tart"), "G", "start-flag", tr("Put the start flag on the line"), "Track"),
            self._row(
                "set_finish",
                tr("Set f&inish"),
                "Shift+G",
                "finish-flag",
                tr("Put the finish flag on the line"),
                "Track",
            ),
            self._row(
                "cut",
                tr("&Cut the final climb"),
                "Shift+X",
                "cut",
                tr("Cut the line where it climbs for good, so that it ends at its lowest point"),
                "Track",
            ),
            self._row(
                "calibrate",
                tr("Add control &points"),
                "K",
                "calibrate",
                tr("Click a place whose position is known, or drag a control point"),
            ),
            self._row(
                "known_distance",
                tr("Give a &known distance"),
                "Shift+K",
                "distance",
                tr("Click both ends of a distance that is known, and type its length"),
            ),
            self._row(
                "measure", tr("&Measure"), "M", "measure", tr("Measure distances and angles in the plan"), "View"
            ),
            self._row(
                "boundaries",
                tr("Correct &boundaries"),
                "B",
                "segments",
                tr("Select segments and drag their boundaries along the line"),
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

"""The panel of each step, made when it is first shown."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QApplication, QStackedWidget, QWidget

from bobdesk.project.steps import StepName
from bobdesk.ui.actions.segment_actions import OF_SEGMENTS
from bobdesk.ui.desk import Desk
from bobdesk.ui.panels.centreline_panel import CentrelinePanel
from bobdesk.ui.panels.plan_panel import PlanPanel
from bobdesk.ui.panels.scale_panel import ScalePanel
from bobdesk.ui.panels.segments_panel import ActionsByName, SegmentsPanel
from bobdesk.ui.plan_view.view import PlanView
from bobdesk.ui.plans import Plans

if TYPE_CHECKING:
    from bobdesk.ui.strips.strip_stack import StripStack

# What the panels ask for, and the tool that does it.
_TOOLS = {"flags": "set_start", "auto trace": "auto_trace", "live wire": "live_wire", "two edges": "two_edges"}


class WindowPanels:
    """A stack of panels, and the wires between them and the plan view."""

    def __init__(
        self, desk: Desk, view: PlanView, plans: Plans, actions: Callable[[], ActionsByName], window: QWidget
    ) -> None:
        self._desk = desk
        self._actions = actions
        self._view = view
        self._plans = plans
        self.stack = QStackedWidget(window)
        self.stack.setObjectName("panels")
        self.stack.setMinimumWidth(300)
        self._shown: dict[StepName, QWidget] = {}
        self._strips: StripStack | None = None
        self._makers: dict[StepName, Callable[[], QWidget]] = {
            "Plan": self._plan,
            "Scale": self._scale,
            "Centreline": self._centreline,
            "Segments": self._segments,
            "Solve": self._solve,
            "Export": self._export,
        }

    def focus(self) -> QWidget | None:
        """Return the control that the keyboard is in, if that is one of a panel."""
        found = QApplication.focusWidget()
        return found if found is not None and self.stack.isAncestorOf(found) else None

    def show_step(self, step: StepName) -> bool:
        """Show the panel of a step, and on the plan what it is about; return whether it is another panel than before.

        What is typed and not taken yet goes to the panel that it was typed into.
        """
        before, typed_into = self.stack.currentWidget(), self.focus()
        if step in self._makers and self._shown.get(step) is not before and typed_into is not None:
            typed_into.clearFocus()
        self._view.show_step(step)
        if self._strips is not None:
            self._strips.let_go()
        if step not in self._makers:
            return False
        if step not in self._shown:
            panel = self._makers[step]()
            self._shown[step] = panel
            self.stack.addWidget(panel)
        self.stack.setCurrentWidget(self._shown[step])
        return self.stack.currentWidget() is not before

    def take_focus(self, step: StepName) -> None:
        """Give the keyboard to what a step is mostly entered for."""
        panel = self._shown.get(step)
        take = getattr(panel, "take_focus", None)
        if take is not None:
            take()

    def strips(self) -> QWidget:
        """Return the strips by station; the plots' library is loaded with them, not before."""
        from bobdesk.ui.solve.open_strips import OpenStrips
        from bobdesk.ui.solve.result_strips import ResultStrips
        from bobdesk.ui.strips.strip_stack import StripStack

        made = self._strips = StripStack(self._desk, self.stack)
        made.set_segment_actions([self._actions()[name] for name in OF_SEGMENTS])
        ResultStrips(self._desk, made)
        OpenStrips(self._desk, made)
        return made

    def _take_tool(self, name: str) -> None:
        """Take the tool that a panel asks for, and give the plan the keyboard."""
        self._view.set_tool(_TOOLS.get(name, name))
        self._view.setFocus()

    def _plan(self) -> QWidget:
        panel = PlanPanel(self._desk, self.stack)
        panel.picture_wanted.connect(self._plans.new_from_picture)
        panel.coordinates_wanted.connect(self._plans.new_from_coordinates)
        panel.comparison_wanted.connect(self._plans.compare_with_file)
        return panel

    def _scale(self) -> QWidget:
        panel = ScalePanel(self._desk, self.stack)
        panel.place_wanted.connect(self._view.show_place)
        panel.tool_wanted.connect(self._take_tool)
        return panel

    def _centreline(self) -> QWidget:
        panel = CentrelinePanel(self._desk, self.stack)
        panel.place_wanted.connect(self._view.show_place)
        panel.vertices_wanted.connect(self._view.fit_selection)
        panel.tool_wanted.connect(self._take_tool)
        return panel

    def _segments(self) -> QWidget:
        return SegmentsPanel(self._desk, self._actions(), self.stack)

    def _solve(self) -> QWidget:
        from bobdesk.ui.panels.solve_panel import SolvePanel

        return SolvePanel(self._desk, self.stack)

    def _export(self) -> QWidget:
        from bobdesk.ui.panels.export_panel import ExportPanel

        return ExportPanel(self._desk, self.stack)

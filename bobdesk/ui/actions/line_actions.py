"""What is done to the digitised line as a whole, and to its selected vertices."""

from __future__ import annotations

from PySide6.QtCore import QObject

from bobdesk.project.project import Project
from bobdesk.ui.actions.action import Action
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.near import nearest_on_line
from bobdesk.ui.plan_view.tools.auto_trace import AutoTraceTool
from bobdesk.ui.plan_view.view import PlanView


class LineActions(QObject):
    """Vertices by key, and the line's direction and ends."""

    def __init__(self, desk: Desk, view: PlanView, parent: QObject) -> None:
        super().__init__(parent)
        self._desk = desk
        self._view = view
        auto_trace = view.tool("auto_trace")
        assert isinstance(auto_trace, AutoTraceTool)
        self._auto_trace = auto_trace

    def table(self) -> tuple[Action, ...]:
        """Return the rows."""
        return (*self._of_vertices(), *self._of_the_line())

    def _of_vertices(self) -> tuple[Action, ...]:
        return (
            Action(
                "insert_vertex",
                self.tr("&Insert vertex"),
                self.insert_vertex,
                ("I",),
                "insert",
                self.tr("Put a vertex on the line at the cursor, or behind the selected one"),
                "Edit",
                "vertices",
                "canvas",
                enabled=self._has_trace,
                context=True,
            ),
            Action(
                "delete_selected",
                self.tr("&Delete vertices"),
                self.delete_selected,
                ("Del",),
                "delete",
                self.tr("Take the selected vertices, or the selected control point, away"),
                "Edit",
                "vertices",
                "canvas",
                enabled=self._has_selection,
                context=True,
            ),
            Action(
                "select_all_vertices",
                self.tr("Select &all vertices"),
                self.select_all,
                ("Ctrl+A",),
                "",
                self.tr("Select every vertex of the line"),
                "Edit",
                "vertices",
                "canvas",
                enabled=self._has_trace,
            ),
        )

    def _of_the_line(self) -> tuple[Action, ...]:
        return (
            Action(
                "reverse_line",
                self.tr("&Reverse the line"),
                self.reverse,
                ("V",),
                "reverse",
                self.tr("Let the line run the other way: start and finish change places"),
                "Track",
                "line",
                "canvas",
                enabled=self._has_line,
                context=True,
            ),
            Action(
                "whole_line",
                self.tr("Start and finish at the &ends"),
                self.use_whole_line,
                (),
                "reset",
                self.tr("Put both flags back to the ends of the line"),
                "Track",
                "line",
                enabled=self._has_flags,
            ),
            Action(
                "keep_final_climb",
                self.tr("&Keep the final climb"),
                self.keep_final_climb,
                (),
                "",
                self.tr("Take the cut of the final climb back"),
                "Track",
                "line",
                enabled=lambda: self._desk.session.project.extent.cut_off is not None,
            ),
            Action(
                "next_doubt",
                self.tr("&Next doubtful place"),
                self._view.show_next_doubt,
                ("N",),
                "next",
                self.tr("Show the next stretch of the trace that may be wrong"),
                "Track",
                "line",
                "canvas",
                enabled=self._has_doubts,
                context=True,
            ),
            Action(
                "look_for_loops",
                self.tr("Look for l&oops"),
                self._auto_trace.look_for_loops,
                (),
                "loop",
                self.tr("Trace the same clicks once more, going straight on where the line crosses itself"),
                "Track",
                "line",
                enabled=lambda: self._auto_trace.can_look_for_loops,
            ),
            Action(
                "delete_line",
                self.tr("Delete the whole &line"),
                self.delete_line,
                (),
                "",
                self.tr("Take the digitised line away; Undo brings it back"),
                "Track",
                "delete",
                enabled=self._has_trace,
            ),
        )

    def insert_vertex(self) -> None:
        """Insert at the cursor if it is near the line, else in the middle of the edge behind the selected vertex."""
        from bobdesk.project import edits

        trace = self._desk.session.project.trace
        if trace is None:
            return
        pointer, chosen = self._view.pointer, self._desk.selection.vertices
        after, place = -1, (0.0, 0.0)
        if pointer is not None:
            near = nearest_on_line(trace.points, pointer.plan)
            if near.away <= 2 * pointer.reach:
                after, place = near.edge, near.place
        if after < 0 and chosen:
            after = min(chosen[-1], len(trace.points) - 2)
            middle = 0.5 * (trace.points[after] + trace.points[after + 1])
            place = (float(middle[0]), float(middle[1]))
        if after < 0:
            self._desk.notices.refuse(self.tr("Put the cursor on the line, or select a vertex, to insert one"))
        elif self._desk.session.apply(
            self.tr("Insert vertex"), lambda before: edits.insert_vertex(before, after, place[0], place[1])
        ):
            self._desk.selection.vertices = (after + 1,)

    def delete_selected(self) -> None:
        """Take the tool's own selection away, or else the selected vertices."""
        from bobdesk.project import edits

        if self._view.tool_in_hand().delete():
            return
        chosen = self._desk.selection.vertices
        if chosen:
            label = self.tr("Delete vertex") if len(chosen) == 1 else self.tr("Delete vertices")
            if self._desk.session.apply(label, lambda before: edits.delete_vertices(before, chosen)):
                self._desk.selection.vertices = ()

    def select_all(self) -> None:
        """Select every vertex."""
        trace = self._desk.session.project.trace
        if trace is not None:
            self._desk.selection.vertices = range(len(trace.points))

    def reverse(self) -> None:
        """Let the line run the other way."""
        from bobdesk.project import edits

        if self._desk.session.apply(self.tr("Reverse line"), edits.reverse_line):
            self._desk.selection.vertices = ()

    def use_whole_line(self) -> None:
        """Put start and finish to the ends."""
        from bobdesk.project import edits

        def whole(project: Project) -> Project:
            return edits.set_start(edits.set_finish(project, None), 0.0)

        self._desk.session.apply(self.tr("Start and finish at the ends"), whole)

    def keep_final_climb(self) -> None:
        """Take the cut back."""
        from bobdesk.project import edits

        self._desk.session.apply(self.tr("Keep the final climb"), edits.keep_final_climb)

    def delete_line(self) -> None:
        """Take the line away."""
        from bobdesk.project import edits

        self._desk.session.apply(self.tr("Delete line"), edits.delete_line)

    def _has_trace(self) -> bool:
        project = self._desk.session.project
        return project.trace is not None and project.source is None

    def _has_line(self) -> bool:
        project = self._desk.session.project
        return project.trace is not None or project.source is not None

    def _has_selection(self) -> bool:
        chosen = self._desk.selection
        boundary = chosen.boundary is not None and self._view.tool_name == "boundaries"
        return bool(chosen.vertices) or chosen.control_point is not None or boundary

    def _has_flags(self) -> bool:
        extent = self._desk.session.project.extent
        return extent.start > 0 or extent.finish is not None

    def _has_doubts(self) -> bool:
        trace = self._desk.session.project.trace
        return self._has_trace() and trace is not None and len(trace.suspect) > 0

"""How the digitised line came about, what is doubtful in it, and the tools to make or mend it."""

from __future__ import annotations

import re
from functools import partial

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.plan.traced_line import Trace
from bobdesk.project import derive, edits
from bobdesk.project.project import Project
from bobdesk.ui.widgets.notice_box import NoticeBox
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part

# The tracer's sentences name a place as "412,1033".
_PLACE = re.compile(r"(?<![\d.])(-?\d+),(-?\d+)(?!\d)")
_NEAR_PX = 25.0
_MOST_WARNINGS = 6


class LineOriginPart(Part):
    """Rows of properties, a box for each warning, and buttons."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Digitised line"))
        facts = panel.add_facts(self.column)
        self.how = facts.add(self.tr("Made by"))
        self.vertices = facts.add(self.tr("Vertices"))
        self.line_width = facts.add(self.tr("Width of the drawn line"))
        self.doubts = facts.add(self.tr("Doubtful places"))
        self._facts = facts
        self.warnings = tuple(NoticeBox(self) for _ in range(_MOST_WARNINGS))
        for box in self.warnings:
            self.column.addWidget(box)
        self._next_doubt = 0
        flow = panel.add_buttons(self.column)
        self.tool_buttons = tuple(
            panel.button(flow, text, tip, icon)
            for text, tip, icon in (
                (self.tr("Trace"), self.tr("Click start and finish; the line between is found"), "auto-trace"),
                (self.tr("Live-wire"), self.tr("Follow the drawn line from click to click"), "live-wire"),
                (self.tr("Draw"), self.tr("Click every vertex"), "draw"),
                (self.tr("Two edges"), self.tr("Trace both edges; the line in the middle is taken"), "two-edges"),
            )
        )
        tools = ("auto trace", "live wire", "draw", "two edges")
        for button, tool in zip(self.tool_buttons, tools, strict=True):
            button.clicked.connect(partial(self._want_tool, tool))
        self.select_button = panel.button(
            flow, self.tr("Edit vertices"), self.tr("Drag, insert and delete vertices in the plan"), "select"
        )
        self.select_button.clicked.connect(partial(self._want_tool, "select"))
        self.reverse_button = panel.button(
            flow, self.tr("Reverse"), self.tr("Let the line run the other way"), "reverse"
        )
        self.reverse_button.clicked.connect(self._reverse)
        self.doubt_button = panel.button(
            flow, self.tr("Next doubtful place"), self.tr("Show the next place where the line may be wrong"), "warning"
        )
        self.doubt_button.clicked.connect(self._show_next_doubt)

    def refresh(self, project: Project) -> None:
        """Show the line of a project."""
        trace, source = project.trace, project.source
        has_picture = project.picture is not None and source is None
        for button in self.tool_buttons:
            button.setVisible(has_picture)
        self.select_button.setVisible(has_picture and trace is not None)
        self.reverse_button.setVisible(derive.digitised_length(project) is not None)
        shown = None if source is not None else trace
        number = self.desk.quantities.number
        has_line = source is not None or trace is not None
        self._facts.show_row(self.how, has_line)
        self._facts.show_row(self.vertices, has_line)
        self._facts.show_row(self.line_width, shown is not None and shown.line_width_px > 0)
        doubts = 0 if shown is None else len(shown.suspect)
        self._facts.show_row(self.doubts, doubts > 0)
        self.doubt_button.setVisible(doubts > 0)
        self.doubts.setText(number(doubts, 0))
        if source is not None:
            self.how.setText(self.tr("coordinates from {name}").format(name=source.name))
            self.vertices.setText(number(len(source.polyline.vertices), 0))
        elif trace is not None:
            self.how.setText(self._how(trace))
            self.vertices.setText(number(len(trace.points), 0))
            self.line_width.setText(self.tr("{width} px").format(width=number(trace.line_width_px, 1)))
        self._say_warnings(shown)

    def _how(self, trace: Trace) -> str:
        if trace.line_width_px == 0:
            return self.tr("clicks")
        if trace.kind == "double":
            return self.tr("tracing the middle of two edges")
        if trace.kind == "dashed":
            return self.tr("tracing a dashed line")
        return self.tr("tracing a single line")

    def _say_warnings(self, trace: Trace | None) -> None:
        sentences = [] if trace is None else [(text, _place(text)) for text in trace.warnings]
        # A place that was mended is suspect no longer, and its sentence no longer true.
        kept = [(text, at) for text, at in sentences if trace is None or at is None or _is_suspect(trace, at)]
        for index, box in enumerate(self.warnings):
            if index >= len(kept):
                box.say("")
                continue
            text, place = kept[index]
            if place is None:
                box.say(text)
            else:
                box.say(text, ((self.tr("Show it"), partial(self.panel.place_wanted.emit, *place)),))

    def _want_tool(self, name: str) -> None:
        self.panel.tool_wanted.emit(name)

    def _reverse(self) -> None:
        self.desk.selection.vertices = ()
        self.desk.session.apply(self.tr("Reverse line"), edits.reverse_line)

    def _show_next_doubt(self) -> None:
        trace = self.desk.session.project.trace
        if trace is None or len(trace.suspect) == 0:
            return
        first, last = trace.suspect[self._next_doubt % len(trace.suspect)].tolist()
        self._next_doubt += 1
        self.desk.selection.vertices = range(first, last + 1)
        x, y = trace.points[(first + last) // 2].tolist()
        self.panel.place_wanted.emit(x, y)


def _place(sentence: str) -> tuple[float, float] | None:
    found = _PLACE.search(sentence)
    return None if found is None else (float(found[1]), float(found[2]))


def _is_suspect(trace: Trace, place: tuple[float, float]) -> bool:
    if len(trace.suspect) == 0:
        return False
    points = np.concatenate([_of(trace.points, first, last) for first, last in trace.suspect.tolist()])
    return bool((np.hypot(*(points - place).T) < _NEAR_PX + 2 * trace.line_width_px).any())


def _of(points: FloatArray, first: int, last: int) -> FloatArray:
    return points[first : last + 1]

"""All tools of one view, and which one is in hand."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QGraphicsView

from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.tools.auto_trace import AutoTraceTool
from bobdesk.ui.plan_view.tools.boundaries import BoundariesTool
from bobdesk.ui.plan_view.tools.calibrate import CalibrateTool
from bobdesk.ui.plan_view.tools.draw import DrawTool
from bobdesk.ui.plan_view.tools.flags import FlagTool
from bobdesk.ui.plan_view.tools.known_distance import KnownDistanceTool
from bobdesk.ui.plan_view.tools.live_wire import LiveWireTool
from bobdesk.ui.plan_view.tools.measure import MeasureTool
from bobdesk.ui.plan_view.tools.select import SelectTool
from bobdesk.ui.plan_view.tools.tool import Tool
from bobdesk.ui.plan_view.tools.two_edges import TwoEdgesTool


class ToolBox(QObject):
    """The tools by name.

    Signals
    -------
    changed
        Another tool is in hand: its name.
    said
        What the tool in hand does.
    """

    changed = Signal(str)
    said = Signal(str)
    repaint = Signal()

    def __init__(self, desk: Desk, view: QGraphicsView) -> None:
        super().__init__(view)
        made: tuple[Tool, ...] = (
            SelectTool(desk, self),
            DrawTool(desk, self),
            LiveWireTool(desk, self),
            AutoTraceTool(desk, self),
            TwoEdgesTool(desk, self),
            FlagTool("set_start", desk, self),
            FlagTool("set_finish", desk, self),
            FlagTool("cut", desk, self),
            CalibrateTool(desk, self),
            KnownDistanceTool(desk, self),
            MeasureTool(desk, self),
            BoundariesTool(desk, self),
        )
        self._tools = {tool.name: tool for tool in made}
        self._current: Tool = made[0]
        self.at_rest = made[0].name
        for tool in made:
            tool.host = view.viewport()
            tool.repaint.connect(self.repaint)
            tool.said.connect(self._on_said)
            tool.done.connect(self._on_done)
        self._desk = desk
        desk.session.document_changed.connect(self._on_document)
        self._current.start()

    @property
    def current(self) -> Tool:
        """The tool in hand."""
        return self._current

    @property
    def names(self) -> tuple[str, ...]:
        """Of all tools."""
        return tuple(self._tools)

    def __getitem__(self, name: str) -> Tool:
        """Return a tool by its name."""
        return self._tools[name]

    def take(self, name: str) -> None:
        """Put down the tool in hand and take another one."""
        taken = self._tools[name]
        if taken is self._current:
            return
        self._current.stop()
        self._current = taken
        taken.sentence = ""
        taken.start()
        self.changed.emit(name)
        self.repaint.emit()

    def refresh(self) -> None:
        """Let the tool in hand look at a changed document."""
        self._current.refresh()

    def _on_said(self, sentence: str) -> None:
        if self.sender() is self._current:
            self.said.emit(sentence)

    def _on_done(self) -> None:
        if self.sender() is self._current:
            self.take(self.at_rest)

    def _on_document(self) -> None:
        for tool in self._tools.values():
            tool.reset()
        self.take("select")
        self.repaint.emit()

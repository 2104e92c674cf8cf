"""Draw the line by clicks."""

from __future__ import annotations

from bobdesk.ui.plan_view.tools.line_tool import LineTool


class DrawTool(LineTool):
    """Every click is a vertex."""

    name = "draw"

    def _say(self) -> None:
        project = self.desk.session.project
        if self._rests:
            self.say(self.tr("Click to go on, Enter to end the line, Esc once more to put the pen down."))
        elif self.line.is_empty and project.trace is not None:
            self.say(self.tr("Click an end of the line to continue it, or elsewhere to draw another one."))
        elif self.line.is_empty:
            self.say(self.tr("Click along the line, from start to finish."))
        else:
            self.say(self.tr("Click the next point; Enter or double-click ends, Backspace takes the last one back."))

"""What several journeys begin with, by mouse and keys."""

from __future__ import annotations

from tests.journeys.real_window import RealWindow

# A cell of a table is being typed into.
EDITING = "window.focusWidget().parentWidget().objectName() == 'qt_scrollarea_viewport'"


def scale_by_two_points(program: RealWindow, points) -> None:
    """Place two control points and type their coordinates; each has px, py, x_m, y_m."""
    program.key("k")
    for point in points:
        program.click_plan(point["px"], point["py"])
        program.until("widget('plan_popup').isVisible()")
        program.type(f"{point['x_m']:.2f}")
        program.key("Tab")
        program.type(f"{point['y_m']:.2f}")
        program.key("Return")
    program.until("len(project.control_points) == 2")


def trace_by_two_clicks(program: RealWindow, start, end) -> None:
    """Trace the line between two pixels."""
    program.key("ctrl+3", "shift+t")
    program.click_plan(*start)
    program.click_plan(*end)
    program.until("project.trace is not None")

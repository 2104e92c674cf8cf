"""The whole table of actions, and the menus made from it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtGui import QKeySequence

from bobdesk.ui.actions.action import MenuName
from bobdesk.ui.actions.action_set import ActionSet
from bobdesk.ui.actions.edit_actions import EditActions
from bobdesk.ui.actions.file_actions import FileActions
from bobdesk.ui.actions.guide_actions import GuideActions
from bobdesk.ui.actions.help_actions import HelpActions
from bobdesk.ui.actions.line_actions import LineActions
from bobdesk.ui.actions.scale_actions import ScaleActions
from bobdesk.ui.actions.segment_actions import SegmentActions
from bobdesk.ui.actions.solve_actions import SolveActions
from bobdesk.ui.actions.study_actions import StudyActions
from bobdesk.ui.actions.tool_actions import ToolActions
from bobdesk.ui.actions.view_actions import ViewActions
from bobdesk.ui.actions.window_actions import WindowActions
from bobdesk.ui.typing_undo import TypingUndo
from bobdesk.ui.updates.updates import updates_of

if TYPE_CHECKING:
    from bobdesk.ui.main_window import MainWindow


def make_actions(window: MainWindow) -> ActionSet:
    """Return the actions of a window, and fill its menu bar with them."""
    desk, view = window.desk, window.view

    def undo_keys() -> tuple[list[QKeySequence], list[QKeySequence]]:
        return made["undo"].shortcuts(), made["redo"].shortcuts()

    table = (
        *FileActions(desk.session, window.documents, window.plans, window.close, window).table(),
        *EditActions(
            desk.session,
            window.plans,
            TypingUndo(window, undo_keys, lambda: made["export"].shortcuts()),
            view.take_back,
            lambda: view.tool_name not in ("select", "boundaries"),
            window,
        ).table(),
        *LineActions(desk, view, window).table(),
        *ViewActions(desk, view, window).table(),
        *ToolActions(desk, view, window).table(),
        *ScaleActions(desk, window).table(),
        *SegmentActions(desk, window).table(),
        *SolveActions(desk, window, window.views, window).table(),
        *StudyActions(desk, window.beside, window).table(),
        *WindowActions(window, window).table(),
        *GuideActions(window.guide, window.plans, window).table(),
        *HelpActions(lambda: window.actions_by_name, desk.settings, window, updates_of(desk)).table(),
    )
    made = ActionSet(table, desk.settings, window, view)
    titles: tuple[tuple[MenuName, str], ...] = (
        ("File", window.tr("&File")),
        ("Edit", window.tr("&Edit")),
        ("View", window.tr("&View")),
        ("Plan", window.tr("&Plan")),
        ("Track", window.tr("&Track")),
        ("Segments", window.tr("Se&gments")),
        ("Solve", window.tr("&Solve")),
        ("Window", window.tr("&Window")),
        ("Help", window.tr("&Help")),
    )
    for name, title in titles:
        made.add_menu(window.menuBar(), name, title)
    window.start.page.practice_wanted.connect(made["practice_picture"].trigger)
    view.context_menu_maker = lambda: made.context_menu(view)
    return made

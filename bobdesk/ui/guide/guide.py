"""Opens the guide where it is wanted; its window and pages are made when it is wanted for the first time."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QApplication

from bobdesk.project.steps import StepName
from bobdesk.ui.notices import Notices
from bobdesk.ui.resources import resource
from bobdesk.ui.settings import Settings

if TYPE_CHECKING:
    from bobdesk.ui.actions.action_set import ActionSet
    from bobdesk.ui.guide.guide_window import GuideWindow


class Guide(QObject):
    """The user's guide of a window.

    Parameters
    ----------
    actions
        Returns the window's actions, for the page of keys.
    step
        Returns the step that is shown, None on the start page.
    """

    def __init__(
        self,
        actions: Callable[[], ActionSet],
        step: Callable[[], StepName | None],
        settings: Settings,
        notices: Notices,
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._actions, self._step = actions, step
        self._settings, self._notices = settings, notices
        self._window: GuideWindow | None = None

    @property
    def window(self) -> GuideWindow | None:
        """The window, once it was opened."""
        return self._window

    def open_here(self) -> None:
        """Open the page that explains what has the keyboard, or else the step that is shown."""
        from bobdesk.ui.guide.context import place_in_guide

        self.open(place_in_guide(QApplication.focusWidget() or QApplication.activeWindow(), self._step()))

    def open(self, place: str) -> None:
        """Open a page, or a heading in one: "solve.md#known-elevations"."""
        if self._window is None or not self._window.isVisible():
            # Made anew, for its page of keys shows those in force.
            self.close()
            self._window = self._made()
        window = self._window
        if window is None:
            self._notices.error(self.tr("The guide is missing from this installation of BobDesk; install it again."))
            return
        window.go_to(place)
        window.setWindowState(window.windowState() & ~Qt.WindowState.WindowMinimized)
        window.show()
        window.raise_()
        window.activateWindow()
        window.browser.setFocus()

    def close(self) -> None:
        """Close the window with the program's."""
        if self._window is not None:
            self._window.close()
            self._window.deleteLater()
            self._window = None

    def _made(self) -> GuideWindow | None:
        from bobdesk.ui.guide.guide_window import GuideWindow
        from bobdesk.ui.guide.keys_page import keys_tables
        from bobdesk.ui.guide.pages import read_pages

        folder = resource("guide")
        try:
            pages = read_pages(folder, {"keys": lambda: keys_tables(self._actions())})
        except OSError:
            pages = ()
        return GuideWindow(pages, folder, self._settings) if pages else None

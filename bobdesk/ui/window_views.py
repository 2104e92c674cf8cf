"""What fills the middle of the window: start page, plan, or the result in space."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QStackedWidget, QWidget

from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.view import PlanView


class WindowViews(QStackedWidget):
    """One of them is seen; the view in space is made when it is first wanted.

    Signals
    -------
    changed
        Another one is seen.
    """

    changed = Signal()

    def __init__(self, desk: Desk, start_page: QWidget, plan: PlanView, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._start_page = start_page
        self._plan = plan
        self._space: QWidget | None = None
        self.addWidget(start_page)
        self.addWidget(plan)
        self.currentChanged.connect(lambda _index: self.changed.emit())

    @property
    def shows_document(self) -> bool:
        """Whether anything but the start page is seen."""
        return self.currentWidget() is not self._start_page

    @property
    def is_in_space(self) -> bool:
        """Whether the view in space is seen."""
        return self._space is not None and self.currentWidget() is self._space

    def take_focus(self) -> None:
        """Give the keyboard to what is seen."""
        shown = self.currentWidget()
        if shown is not None:
            shown.setFocus(Qt.FocusReason.OtherFocusReason)

    def show_document(self, is_open: bool) -> None:
        """Show the plan of a document, or the start page."""
        self.setCurrentWidget(self._plan if is_open else self._start_page)

    def show_in_space(self, on: bool) -> None:
        """Show the result in space, or the plan."""
        if not self.shows_document:
            return
        if on and self._space is None:
            from bobdesk.ui.view3d.space_view import SpaceView

            self._space = SpaceView(self._desk, self)
            self.addWidget(self._space)
        shown: QWidget = self._space if on and self._space is not None else self._plan
        self.setCurrentWidget(shown)
        shown.setFocus()

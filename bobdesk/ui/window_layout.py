"""Docks and bars of the window: where they are at first, remembered, and put back."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QByteArray, QSize, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QDockWidget, QSizePolicy, QToolBar, QToolButton

from bobdesk.project.steps import StepName
from bobdesk.ui.settings import Settings
from bobdesk.ui.window_parts import Part

if TYPE_CHECKING:
    from bobdesk.ui.main_window import MainWindow

# Another number after docks or bars were added or taken away: what was remembered of the old ones is dropped.
_STATE = 2
_FIRST_SIZE = QSize(1440, 900)
_PANEL_WIDTH = 430
_LONGEST_LABEL = 34
_STRIPS_HEIGHT = 330
_STEPS_BY_STATION: tuple[StepName, ...] = ("Segments", "Solve", "Export")


class WindowLayout:
    """The steps at the top, the tools at the left, the panel at the right."""

    def __init__(self, window: MainWindow, settings: Settings) -> None:
        self._window = window
        self._settings = settings
        self._top = QToolBar(window.tr("Steps"), window)
        self._top.setObjectName("steps_tool_bar")
        self._top.setMovable(False)
        self._top.toggleViewAction().setEnabled(False)
        self._top.addWidget(window.steps_bar)
        window.steps_bar.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        window.addToolBar(Qt.ToolBarArea.TopToolBarArea, self._top)
        self._undo = [self._undo_button(name) for name in ("undo", "redo")]
        self._tools = QToolBar(window.tr("Tools"), window)
        self._tools.setObjectName("tools_tool_bar")
        self._tools.setIconSize(QSize(24, 24))
        window.addToolBar(Qt.ToolBarArea.LeftToolBarArea, self._tools)
        for row in window.actions_by_name.table:
            if row.tool_bar:
                self._tools.addAction(window.actions_by_name[row.name])
                # A tool bar's buttons take no keyboard of their own accord.
                button = self._tools.widgetForAction(window.actions_by_name[row.name])
                button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.panel_dock = QDockWidget(window.tr("Panel of the step"), window)
        self.panel_dock.setObjectName("panel_dock")
        self.panel_dock.setWidget(window.panels.stack)
        window.addDockWidget(Qt.DockWidgetArea.RightDockWidgetArea, self.panel_dock)
        self.strips_dock = QDockWidget(window.tr("Strips by station"), window)
        self.strips_dock.setObjectName("strips_dock")
        window.addDockWidget(Qt.DockWidgetArea.BottomDockWidgetArea, self.strips_dock)
        window.setCorner(Qt.Corner.BottomRightCorner, Qt.DockWidgetArea.RightDockWidgetArea)
        self._strips_wanted = True
        self.strips_dock.toggleViewAction().triggered.connect(self._on_strips_toggled)
        self._at_first: QByteArray | None = None
        window.resize(self._first_size())
        window.resizeDocks([self.panel_dock], [_PANEL_WIDTH], Qt.Orientation.Horizontal)
        window.actions_by_name.menu_of("Window").addSeparator()
        for toggle in (
            self.panel_dock.toggleViewAction(),
            self.strips_dock.toggleViewAction(),
            self._tools.toggleViewAction(),
        ):
            window.actions_by_name.menu_of("Window").addAction(toggle)

    def restore(self) -> None:
        """Bring back what was remembered."""
        self._at_first = self._window.saveState(_STATE)
        geometry, state = self._settings.bytes_of("geometry"), self._settings.bytes_of("state")
        if not geometry.isEmpty():
            self._window.restoreGeometry(geometry)
        if not state.isEmpty():
            self._window.restoreState(state, _STATE)
        self.show_document(self._window.has_document())

    def remember(self) -> None:
        """Remember size, place, docks and bars."""
        self._settings.set_bytes("geometry", self._window.saveGeometry())
        if self._window.has_document():
            self._settings.set_bytes("state", self._window.saveState(_STATE))

    def reset(self) -> None:
        """Put everything back where it was at first."""
        self._window.setWindowState(Qt.WindowState.WindowNoState)
        self._window.resize(self._first_size())
        if self._at_first is not None:
            self._window.restoreState(self._at_first, _STATE)
        self._window.resizeDocks([self.panel_dock], [_PANEL_WIDTH], Qt.Orientation.Horizontal)

    def show_document(self, is_open: bool) -> None:
        """Show docks and bars with a document, and none of them on the start page."""
        self._top.setVisible(is_open)
        self._tools.setVisible(is_open)
        self.panel_dock.setVisible(is_open)
        if not is_open:
            self.strips_dock.hide()

    def show_strips(self, step: StepName) -> None:
        """Show the strips with the steps that work by station, unless the user has put them away."""
        wanted = step in _STEPS_BY_STATION and self._strips_wanted
        if wanted and self.strips_dock.widget() is None:
            self.strips_dock.setWidget(self._window.panels.strips())
        if wanted != self.strips_dock.isVisible():
            self.strips_dock.setVisible(wanted)
            if wanted:
                self._window.resizeDocks([self.strips_dock], [_STRIPS_HEIGHT], Qt.Orientation.Vertical)

    def _on_strips_toggled(self, shown: bool) -> None:
        self._strips_wanted = shown
        if shown and self.strips_dock.widget() is None:
            self.strips_dock.setWidget(self._window.panels.strips())

    def name_undo(self, undo: str | None, redo: str | None) -> None:
        """Write on actions and buttons what would be taken back or done again."""
        for name, label, text in (
            ("undo", undo, self._window.tr("&Undo {step}") if undo else self._window.tr("&Undo")),
            ("redo", redo, self._window.tr("&Redo {step}") if redo else self._window.tr("&Redo")),
        ):
            words = text.format(step=_in_sentence(label or ""))
            self._window.actions_by_name[name].setText(words)
            self._window.actions_by_name[name].setIconText(_short(words.replace("&", "")))

    def parts(self) -> list[Part]:
        """Return the parts of the window with a document, in the order in which one key leads to them."""
        window, middle, strips = self._window, self._window.views.currentWidget(), self.strips_dock.widget()
        return [
            (window.notice_bar,),
            (window.steps_bar,),
            (self._tools,),
            () if middle is None else (middle,),
            () if strips is None else (strips,),
            (window.panels.stack,),
        ]

    def _undo_button(self, name: str) -> QToolButton:
        button = QToolButton(self._window)
        button.setDefaultAction(self._window.actions_by_name[name])
        button.setAutoRaise(True)
        self._window.steps_bar.add_at_right(button, words=name == "undo")
        return button

    def _first_size(self) -> QSize:
        screen = QGuiApplication.primaryScreen()
        return _FIRST_SIZE if screen is None else _FIRST_SIZE.boundedTo(screen.availableSize())


def _in_sentence(label: str) -> str:
    """Return a step's label as it stands within a sentence: "Move vertex" as "move vertex", "DXF" as it is."""
    return label[:1].lower() + label[1:] if label[1:2].islower() else label


def _short(text: str) -> str:
    return text if len(text) <= _LONGEST_LABEL else text[: _LONGEST_LABEL - 1].rstrip() + "…"

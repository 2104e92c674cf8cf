"""The window: puts the parts beside each other and connects them. What a part does stands in its own file."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from PySide6.QtCore import QEvent, Qt, QTimer
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import QMainWindow, QVBoxLayout, QWidget

from bobdesk.project.project import Project
from bobdesk.project.steps import StepName
from bobdesk.ui.desk import Desk
from bobdesk.ui.documents import Documents
from bobdesk.ui.guide.guide import Guide
from bobdesk.ui.notice_bar import NoticeBar
from bobdesk.ui.notices import Notices
from bobdesk.ui.plan_picture import PlanPicture
from bobdesk.ui.plan_view.view import PlanView
from bobdesk.ui.plans import Looked, Plans, local_paths
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.questions import Questions
from bobdesk.ui.runner import Runner
from bobdesk.ui.selection import Selection
from bobdesk.ui.session import Session
from bobdesk.ui.settings import Settings
from bobdesk.ui.solving import solving_of
from bobdesk.ui.start import Start
from bobdesk.ui.status_bar import StatusBar
from bobdesk.ui.steps_bar import StepsBar
from bobdesk.ui.studies.beside_windows import BesideWindows
from bobdesk.ui.warm_up import warm_up_plots, warm_up_steps
from bobdesk.ui.window_actions import make_actions
from bobdesk.ui.window_layout import WindowLayout
from bobdesk.ui.window_panels import WindowPanels
from bobdesk.ui.window_parts import go_to_part
from bobdesk.ui.window_views import WindowViews


class MainWindow(QMainWindow):
    """One document, its plan and its panels.

    Parameters
    ----------
    settings
        What the program remembers.
    data_folder
        Where recovery copies and locks lie.
    """

    def __init__(self, settings: Settings, data_folder: Path) -> None:
        super().__init__()
        self.setObjectName("main_window")
        self.setAcceptDrops(True)
        session, runner = Session(self), Runner(self)
        self.desk = Desk(
            session=session,
            selection=Selection(self),
            picture=PlanPicture(session, runner, self),
            runner=runner,
            notices=Notices(self),
            settings=settings,
            quantities=Quantities(settings, self),
        )
        self.beside = BesideWindows(self.desk, data_folder, self)
        self._may_close = False
        self._forget_copy = True
        self.questions = Questions(settings, self)
        self.documents = Documents(self.desk, self.questions, data_folder, self)
        self.plans = Plans(self.desk, self.documents, self.questions, self._look_at_coordinates, self)
        self.view = PlanView(self.desk, self)
        self.steps_bar = StepsBar(self.desk, self)
        self.status = StatusBar(self.desk, self)
        self.start = Start(self.desk, self.documents, self.plans, self)
        self.panels = WindowPanels(self.desk, self.view, self.plans, lambda: self.actions_by_name, self)
        self.views = WindowViews(self.desk, self.start.page, self.view, self)
        self.guide = Guide(lambda: self.actions_by_name, self._step_in_sight, settings, self.desk.notices, self)
        self.start.page.guide_wanted.connect(self.guide.open)
        self._put_together()
        self.actions_by_name = make_actions(self)
        self.layout_of_window = WindowLayout(self, settings)
        self._connect()
        self._show_document()
        self.layout_of_window.restore()

    def go_to(self, step: StepName) -> None:
        """Show a step's panel; the keyboard leaves the panel before, and no field takes it unasked."""
        was_in_panel = self.panels.focus() is not None
        if self.panels.show_step(step) and was_in_panel:
            self.views.take_focus()
        self.steps_bar.show_step(step)
        self.layout_of_window.panel_dock.setWindowTitle(self.steps_bar.title_of(step))
        self.layout_of_window.panel_dock.show()
        self.layout_of_window.show_strips(step)

    def open_file(self, path: Path) -> None:
        """Open a file of any kind that BobDesk knows."""
        self.plans.open_any(path)

    def leave(self) -> None:
        """End at once; the recovery copy stays, and the next start offers it."""
        self.documents.keeper.keep_now()
        self._may_close, self._forget_copy = True, False
        self.close()

    def warm_up(self) -> None:
        """Load what the first trace needs, while the user looks at the window."""
        self.desk.runner.start(self.tr("Getting ready"), warm_up_steps, done=lambda _: warm_up_plots())

    def toggle_full_screen(self, on: bool) -> None:
        """Fill the screen, or not."""
        self.setWindowState(
            self.windowState() | Qt.WindowState.WindowFullScreen
            if on
            else self.windowState() & ~Qt.WindowState.WindowFullScreen
        )

    def is_full_screen(self) -> bool:
        """Whether the window fills the screen."""
        return self.isFullScreen()

    def has_document(self) -> bool:
        """Whether there is a document."""
        return self.desk.session.is_open

    def export(self) -> None:
        """Show the export panel, so that Enter saves."""
        self.go_to("Export")
        self.panels.take_focus("Export")

    def reset_layout(self) -> None:
        """Put docks and bars back where they are at first."""
        self.layout_of_window.reset()
        self._show_document()

    def next_part(self, by: int = 1) -> None:
        """Move the keyboard to the next part of the window, or with -1 to the one before."""
        start = [(self.notice_bar,), *self.start.page.parts()]
        go_to_part(self.layout_of_window.parts() if self.views.shows_document else start, by)

    def closeEvent(self, event: QCloseEvent) -> None:
        """Ask about changes that are not saved; the window closes when that is settled."""
        if not self._may_close:
            self.documents.guard(self._settle)
        if not self._may_close:
            event.ignore()
            return
        self.guide.close()
        self.beside.close()
        self.layout_of_window.remember()
        self.desk.runner.close()
        self.documents.close(forget_copy=self._forget_copy)
        event.accept()

    def changeEvent(self, event: QEvent) -> None:
        """Draw the icons in the colours of another theme."""
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "actions_by_name"):
            self.actions_by_name.refresh_icons()
        super().changeEvent(event)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Take files and pictures."""
        if local_paths(event.mimeData()) or event.mimeData().hasImage():
            event.setDropAction(Qt.DropAction.CopyAction)
            event.accept()

    def dropEvent(self, event: QDropEvent) -> None:
        """Open what was dropped."""
        # A file that is moved would be deleted by the program it comes from.
        event.setDropAction(Qt.DropAction.CopyAction)
        event.accept()
        paths = local_paths(event.mimeData())
        if len(paths) > 1:
            self.desk.notices.note(self.tr("One file at a time: only the first one is opened."))
        if paths:
            # Questions come after the drop, or the program that the file comes from would wait for the answers.
            QTimer.singleShot(0, self, partial(self.open_file, paths[0]))
        else:
            self.plans.paste(event.mimeData())

    def _look_at_coordinates(self, path: Path, as_actual: bool) -> Looked | None:
        from bobdesk.ui.dialogs.import_coordinates import look_at_coordinates

        return look_at_coordinates(self.desk, path, as_actual=as_actual, parent=self)

    def _step_in_sight(self) -> StepName | None:
        return self.steps_bar.shown if self.desk.session.is_open else None

    def _settle(self) -> None:
        self._may_close = True
        if not self.isHidden():
            self.close()

    def _put_together(self) -> None:
        centre = QWidget(self)
        column = QVBoxLayout(centre)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        self.notice_bar = NoticeBar(self.desk.notices, centre)
        column.addWidget(self.notice_bar)
        column.addWidget(self.views, 1)
        self.setCentralWidget(centre)
        self.setStatusBar(self.status)

    def _connect(self) -> None:
        session = self.desk.session
        session.changed.connect(self._on_changed)
        session.document_changed.connect(self._on_document)
        session.state_changed.connect(self._on_state)
        session.refused.connect(lambda sentence: self.desk.notices.refuse(sentence, weight="error"))
        self.steps_bar.chosen.connect(self.go_to)
        # The guide's key acts in the other windows, too.
        self.beside.made.connect(lambda made: made.addAction(self.actions_by_name["guide"]))
        self.view.pointer_moved.connect(self.status.show_place)
        self.view.said.connect(self.status.say)
        self.desk.selection.vertices_changed.connect(self.actions_by_name.refresh)
        self.desk.picture.changed.connect(self.actions_by_name.refresh)
        self.view.tool_changed.connect(self.actions_by_name.refresh)
        self.views.changed.connect(self.actions_by_name.refresh)
        solving_of(self.desk).changed.connect(self.actions_by_name.refresh)

    def _on_changed(self, _before: Project, _after: Project) -> None:
        self._on_state()

    def _on_document(self) -> None:
        self.notice_bar.leave_document()
        self.desk.selection.clear()
        self._show_document()

    def _on_state(self) -> None:
        session = self.desk.session
        if self.views.shows_document != session.is_open:
            self._show_document()
        self.setWindowModified(session.is_open and not session.is_saved)
        self.setWindowTitle(f"{self.documents.title}[*]" if session.is_open else "BobDesk")
        self.layout_of_window.name_undo(session.undo_label, session.redo_label)
        self.actions_by_name.refresh()

    def _show_document(self) -> None:
        is_open = self.desk.session.is_open
        self.views.show_document(is_open)
        self.layout_of_window.show_document(is_open)
        if is_open:
            project = self.desk.session.project
            self.go_to("Segments" if project.source is not None else "Plan")
        else:
            self.start.refresh()
        self.actions_by_name.refresh()

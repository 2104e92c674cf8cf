"""A window beside the main one, with a job that it begins, shows and ends."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QCloseEvent, QGuiApplication, QHideEvent, QKeyEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from bobdesk.ui.desk import Desk
from bobdesk.ui.notice_bar import NoticeBar
from bobdesk.ui.notices import Notices
from bobdesk.ui.questions import Questions
from bobdesk.ui.runner import Job
from bobdesk.ui.studies.job_bar import JobBar

_MARGIN = 14


class BesideWindow(QWidget):
    """A window of its own, which may lie before the main one or behind it.

    It stays when it is closed, so that it comes back with all that it shows; tells its own notices.

    A subclass puts its parts into `column` between the notices and the job's bar.

    Parameters
    ----------
    name
        Under which its place is remembered.
    """

    def __init__(self, name: str, title: str, size: QSize, desk: Desk) -> None:
        super().__init__()
        self.setObjectName(name)
        self.setAttribute(Qt.WidgetAttribute.WA_QuitOnClose, False)
        self.setWindowTitle(title)
        self.setAccessibleName(title)
        notices = Notices(self)
        self.desk = replace(desk, notices=notices)
        self.questions = Questions(desk.settings, self)
        self.job: Job | None = None
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.setSpacing(0)
        outer.addWidget(NoticeBar(notices, self))
        self.column = QVBoxLayout()
        self.column.setContentsMargins(_MARGIN, _MARGIN, _MARGIN, _MARGIN)
        self.column.setSpacing(10)
        outer.addLayout(self.column, 1)
        self.bar = JobBar(self)
        self.bar.stop_button.clicked.connect(self.stop)
        screen = QGuiApplication.primaryScreen()
        self.resize(size if screen is None else size.boundedTo(screen.availableSize()))
        remembered = desk.settings.bytes_of(f"{name}_geometry")
        if not remembered.isEmpty():
            self.restoreGeometry(remembered)

    @property
    def is_running(self) -> bool:
        """Whether the job works or rests."""
        return self.job is not None

    def open(self) -> None:
        """Show the window, in front of others."""
        self.setWindowState(self.windowState() & ~Qt.WindowState.WindowMinimized)
        self.show()
        self.raise_()
        self.activateWindow()

    def stop(self) -> None:
        """End the job; what it has finished stays."""
        if self.job is not None:
            self.job.stop()

    def leave(self) -> None:
        """End the job and the window without a question: the main window closes."""
        if self.job is not None:
            self.job.stop()
            self.job = None
        self.close()
        self.deleteLater()

    def question_before_stopping(self) -> tuple[str, str]:
        """Return what is asked before the window is closed on its job, and what becomes of it."""
        raise NotImplementedError

    def closeEvent(self, event: QCloseEvent) -> None:
        """Ask before the window is closed on its job."""
        if self.job is not None and not self.questions.stop_work(*self.question_before_stopping()):
            event.ignore()
            return
        self.stop()
        event.accept()

    def hideEvent(self, event: QHideEvent) -> None:
        """Remember the place, whoever hides the window."""
        self.desk.settings.set_bytes(f"{self.objectName()}_geometry", self.saveGeometry())
        super().hideEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Close with Esc."""
        if event.key() == Qt.Key.Key_Escape:
            self.close()
        else:
            super().keyPressEvent(event)

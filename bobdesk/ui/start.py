"""The start page at work: what it lists, and what its buttons do."""

from __future__ import annotations

from collections.abc import Generator
from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from bobdesk.files.project_file import load_project
from bobdesk.files.recovery_store import Recoverable
from bobdesk.progress import Progress
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.documents import Documents
from bobdesk.ui.plans import Plans
from bobdesk.ui.recent_entries import RecentEntry, recent_entry_steps
from bobdesk.ui.resources import resource
from bobdesk.ui.runner import Job
from bobdesk.ui.start_page import StartPage


class Start(QObject):
    """Connects the start page with the document."""

    def __init__(self, desk: Desk, documents: Documents, plans: Plans, window: QWidget) -> None:
        super().__init__(window)
        self._desk = desk
        self._documents = documents
        self._job: Job | None = None
        self.page = StartPage(desk.settings, window)
        self.page.picture_wanted.connect(plans.new_from_picture)
        self.page.coordinates_wanted.connect(plans.new_from_coordinates)
        self.page.sample_wanted.connect(self.open_sample)
        self.page.project_wanted.connect(documents.open_project)
        self.page.recover_wanted.connect(self._recover)
        self.page.discard_wanted.connect(self._discard)
        self.page.forget_wanted.connect(self._forget)

    def refresh(self) -> None:
        """List recent projects and what can be recovered anew."""
        self.page.show_recoverable(self._documents.keeper.recoverable())
        if self._job is not None:
            self._job.stop()
        recent = self._desk.settings.recent

        def done(entries: tuple[RecentEntry, ...]) -> None:
            self._job = None
            self.page.show_recent(entries)

        self._job = self._desk.runner.start(
            self.tr("Looking at recent projects"), lambda: recent_entry_steps(recent), done=done
        )

    def open_sample(self, name: str) -> None:
        """Open a finished sample as a project that was never saved."""
        path = resource("samples", name, f"{name}.bobdesk")

        def job() -> Generator[Progress, None, Project]:
            yield Progress(0.0, "Reading the sample")
            return load_project(path)

        self._documents.replace(self.tr("Opening the sample"), job, self._documents.begin)

    def _recover(self, item: Recoverable) -> None:
        self._documents.recover(item)

    def _discard(self, item: Recoverable) -> None:
        self._documents.discard(item)
        self.refresh()

    def _forget(self, path: Path) -> None:
        self._desk.settings.forget_recent(path)
        self.refresh()

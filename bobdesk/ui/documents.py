"""Opening and saving: what happens to the document as a whole. Nothing here can lose work unasked."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from bobdesk.files.project_file import is_project, load_project, save_project
from bobdesk.files.recovery_store import Recoverable, recover
from bobdesk.progress import Progress
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.keeper import Keeper
from bobdesk.ui.notices import Remedy
from bobdesk.ui.questions import PROJECT_SUFFIX, Questions

Then = Callable[[], None]
_Stamp = tuple[int, int]
_EMPTY = Project()


@dataclass(frozen=True, eq=False)
class _NextSave:
    """A save that was asked for while another one was under way."""

    document: object
    path: Path
    then: Then | None


class Documents(QObject):
    """The document's way from and to the disk.

    Signals
    -------
    save_ended
        Whether the save that was asked for has worked.
    """

    save_ended = Signal(bool)

    def __init__(self, desk: Desk, questions: Questions, data_folder: Path, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._questions = questions
        self._stamp: _Stamp | None = None
        self._is_saving = False
        self._next_save: _NextSave | None = None
        self.keeper = Keeper(desk, data_folder, self.save, self)

    @property
    def title(self) -> str:
        """What the document is called."""
        session = self._desk.session
        return session.path.stem if session.path is not None else session.project.name or self.tr("Untitled")

    def new(self) -> None:
        """Close the document and show the start page."""
        self.guard(self._close)

    def guard(self, then: Then) -> None:
        """Do `then` once nothing is lost by it: changes are saved, or the user does not want them."""
        if self._desk.session.is_saved:
            then()
            return
        answer = self._questions.save_changes(self.title)
        if answer == "discard":
            then()
        elif answer == "save":
            self.save(then)

    def replace(
        self, title: str, job: Callable[[], Generator[Progress, None, Project]], done: Callable[[Project], None]
    ) -> None:
        """Run a job whose project takes the place of this one; edits that are made meanwhile are asked about again."""
        session = self._desk.session

        def begin() -> None:
            agreed = session.project

            def place(project: Project) -> None:
                if session.project is agreed:
                    done(project)
                else:
                    self.guard(lambda: done(project))

            self._run(title, job, place)

        self.guard(begin)

    def open(self) -> None:
        """Ask for a project and open it."""
        path = self._questions.file_to_open("projects", self.tr("Open project"), self._questions.project_filter())
        if path is not None:
            self.open_project(path)

    def open_project(self, path: Path) -> None:
        """Open a project in the place of this one; this one stays until that is whole."""
        self.guard(lambda: self._load(path))

    def recover(self, item: Recoverable) -> None:
        """Open what an earlier window left behind; it counts as not saved."""

        def job() -> Generator[Progress, None, Project]:
            yield Progress(0.0, "Reading the recovery copy")
            return recover(item)

        def done(project: Project) -> None:
            path = item.path if item.path is not None and self.keeper.take(item.path) else None
            self._stamp = None if path is None else _stamp_of(path)
            self._desk.session.open(project, path, recovered=True)
            # The old copy is the only one until the new one is on the disk.
            if self.keeper.keep_now():
                self.keeper.forget(item)
            self._desk.notices.note(self.tr("The project was recovered; save it to keep it."))

        self.replace(self.tr("Recovering {name}").format(name=item.name or self.tr("the project")), job, done)

    def discard(self, item: Recoverable) -> None:
        """Delete what an earlier window left behind."""
        self.keeper.forget(item)

    def save(self, then: Then | None = None) -> None:
        """Save the document to its file, or ask for one."""
        path = self._desk.session.path
        if path is None:
            self.save_as(then)
        elif self._stamp is not None and _stamp_of(path) not in (self._stamp, None) and not self._is_saving:
            answer = self._questions.changed_on_disk(path.name)
            if answer == "overwrite":
                self._write(path, then)
            elif answer == "save as":
                self.save_as(then)
        else:
            self._write(path, then)

    def save_as(self, then: Then | None = None) -> None:
        """Ask for a file and save the document to it."""
        path = self._questions.file_to_save(
            "projects",
            self.tr("Save project"),
            self.title + PROJECT_SUFFIX,
            self._questions.project_filter(),
            PROJECT_SUFFIX,
        )
        if path is None:
            return
        if not is_project(path):
            path = path.with_name(path.name + PROJECT_SUFFIX)
            # The file dialog has asked about the name without the suffix.
            if path.exists() and not self._questions.overwrite(path.name):
                return
        if path != self._desk.session.path and not self.keeper.take(path):
            if self._desk.session.path is not None:
                self.keeper.take(self._desk.session.path)
            self._desk.notices.error(
                self.tr("{name} is open in another window of BobDesk; choose another name.").format(name=path.name)
            )
            return
        self._write(path, then)

    def begin(self, project: Project = _EMPTY) -> None:
        """Have a document without a file."""
        self.keeper.let_go()
        self._stamp = None
        self._desk.session.open(project, None)

    def close(self, *, forget_copy: bool) -> None:
        """End with the window."""
        self.keeper.close(forget_copy=forget_copy)

    def _close(self) -> None:
        self.keeper.let_go()
        self._stamp = None
        self._desk.session.close()

    def _load(self, path: Path) -> None:
        session = self._desk.session
        if session.path is not None and path.absolute() == session.path.absolute() and session.is_saved:
            self.keeper.let_go()
        if not self.keeper.take(path):
            if self._questions.open_elsewhere(path.name):
                self._read(path, as_copy=True)
            elif session.path is not None:
                self.keeper.take(session.path)
            return
        self._read(path, as_copy=False)

    def _read(self, path: Path, *, as_copy: bool) -> None:
        def job() -> Generator[Progress, None, Project]:
            yield Progress(0.0, "Reading the project")
            return load_project(path)

        agreed = self._desk.session.project

        def done(project: Project) -> None:
            if self._desk.session.project is not agreed:
                # Somebody went on working while the file was read: that is asked about, too.
                self._own_lock_again()
                self.open_project(path)
                return
            self._stamp = None if as_copy else _stamp_of(path)
            self._desk.session.open(project, None if as_copy else path.absolute(), recovered=as_copy)
            self._desk.settings.remember_recent(path)

        def failed(sentence: str) -> None:
            self._own_lock_again()
            self._desk.notices.error(sentence)

        self._run(self.tr("Opening {name}").format(name=path.name), job, done, failed, self._own_lock_again)

    def _own_lock_again(self) -> None:
        self.keeper.let_go()
        if self._desk.session.path is not None:
            self.keeper.take(self._desk.session.path)

    def _write(self, path: Path, then: Then | None) -> None:
        session = self._desk.session
        document, project = session.document, session.project
        if self._is_saving:
            self._next_save = _NextSave(document, path, then)
            return
        self._is_saving = True
        written: list[_Stamp | None] = []

        def job() -> Generator[Progress, None, None]:
            yield Progress(0.0, "Writing the project")
            save_project(project, path)
            written.append(_stamp_of(path))

        def done(_: object = None) -> None:
            self._is_saving = False
            self._desk.settings.remember_recent(path)
            # Another document may have been opened meanwhile: its file is another one.
            if session.document is document:
                self._stamp = written[0]
                session.saved(project, path.absolute())
            self.save_ended.emit(True)
            if self._save_next() or then is None:
                return
            if session.document is document and not session.is_saved:
                self._write(path, then)
            else:
                then()

        def failed(sentence: str) -> None:
            self._is_saving = False
            self._desk.notices.error(
                self.tr("The project is not saved: {reason}").format(reason=sentence),
                *(self._ways_to_save() if session.document is document else ()),
            )
            self.save_ended.emit(False)
            if self._next_save is not None and self._next_save.path == path:
                self._next_save = None
            self._save_next()

        def stopped() -> None:
            if written:
                done()
            else:
                failed(self.tr("saving was stopped"))

        self._run(self.tr("Saving {name}").format(name=path.name), job, done, failed, stopped)

    def _save_next(self) -> bool:
        """Do the save that had to wait, unless its document was left meanwhile; return whether there is one."""
        waiting, self._next_save = self._next_save, None
        if waiting is None or waiting.document is not self._desk.session.document:
            return False
        self._write(waiting.path, waiting.then)
        return True

    def _ways_to_save(self) -> tuple[Remedy, ...]:
        return (Remedy(self.tr("Save under another name…"), self.save_as), Remedy(self.tr("Try again"), self.save))

    def _run(
        self,
        title: str,
        job: Callable[[], Generator[Progress, None, object]],
        done: Callable[..., None],
        failed: Callable[[str], None] | None = None,
        stopped: Then | None = None,
    ) -> None:
        self._desk.runner.start(title, job, done=done, failed=failed or self._desk.notices.error, stopped=stopped)


def _stamp_of(path: Path) -> _Stamp | None:
    try:
        about = path.stat()
    except OSError:
        return None
    return about.st_mtime_ns, about.st_size

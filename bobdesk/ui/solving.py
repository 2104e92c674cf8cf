"""Runs of the document's solver: one at a time in the background, others waiting, the result one undoable edit."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Generator
from typing import TYPE_CHECKING

from PySide6.QtCore import QCoreApplication, QEvent, QObject, Signal

from bobdesk.project.layout import Layout
from bobdesk.project.project import Project
from bobdesk.project.record import IterateRecord
from bobdesk.project.runs import Run, RunInputs
from bobdesk.ui.desk import Desk
from bobdesk.ui.runner import Job

if TYPE_CHECKING:
    from bobdesk.alignment.centreline import Centreline
    from bobdesk.solve.iterates import Iterate
    from bobdesk.track.centreline3d import Centreline3D

# A yield for every iterate would cost the solver a third of its time.
_YIELD_EVERY_S = 0.003
_TELL_EVERY_S = 0.1
# Of its time the solver loses at most this share to pictures.
_SHOWING_SHARE = 0.02
# The solver waits for a picture no longer than this.
_PATIENCE_S = 0.1
# Of how many finished runs every iterate's figures are held: a long run has 13 MB of them.
_MOST_RECORDS = 3


class _Control:
    """What window and solver's thread tell each other; every attribute is written whole."""

    def __init__(self, project: Project, name: str) -> None:
        self.project = project
        self.name = name
        self.record = IterateRecord(project.targets.length)
        self.enough = threading.Event()
        self.single = threading.Event()
        # Closed while the window draws: two threads that fight for the interpreter are slower than one after the other.
        self.gate = threading.Event()
        self.gate.set()
        self._rested = 0.0
        self.pause: Callable[[], object] = self.enough.is_set
        self.rest: Callable[[], bool] = self.enough.is_set
        self.line: Centreline | None = None
        self.inputs: RunInputs | None = None

    def asked(self) -> bool:
        """Rest between two evaluations while the run rests or the window draws; return whether to end."""
        began = time.perf_counter()
        if not self.gate.is_set():
            self.gate.wait(_PATIENCE_S)
        end = self.rest() or self.enough.is_set()
        self._rested += time.perf_counter() - began
        return end

    def clock(self) -> float:
        """Return seconds that stand still while the run rests between two evaluations."""
        return time.perf_counter() - self._rested


def _pulled(control: _Control) -> Generator[int, None, Run]:
    """Solve, and yield the number of iterates every few milliseconds; after each one in single steps."""
    from bobdesk.files.solvers import watched_methods
    from bobdesk.project import derive
    from bobdesk.project.new_run import new_run

    project = control.project
    control.inputs = derive.run_inputs(project).needed()
    control.line = derive.centreline(project).needed()
    job = new_run(
        project,
        name=control.name,
        clock=control.clock,
        record=control.record,
        enough=control.enough.is_set,
        asked=control.asked,
        methods=watched_methods(),
    )
    due = 0.0
    try:
        while True:
            try:
                next(job)
            except StopIteration as end:
                return end.value  # type: ignore[no-any-return]
            if not control.gate.is_set():
                control.gate.wait(_PATIENCE_S)
            if control.single.is_set():
                control.single.clear()
                control.pause()
                due = 0.0
            if time.perf_counter() >= due:
                yield control.record.count
                due = time.perf_counter() + _YIELD_EVERY_S
    finally:
        job.close()


class Solving(QObject):
    """The run that works, those that wait, and all figures of those that have finished in this session.

    Signals
    -------
    changed
        A run began, rests, goes on or has ended, or another one waits.
    advanced
        There are new iterates; at most ten times a second.
    kept
        A finished `Run` is in the project now.
    """

    changed = Signal()
    advanced = Signal()
    kept = Signal(object)

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._job: Job | None = None
        self._control: _Control | None = None
        self._waiting: deque[_Control] = deque()
        self._records: deque[tuple[Layout, IterateRecord]] = deque(maxlen=_MOST_RECORDS)
        self._told = 0.0
        self._wait = _TELL_EVERY_S
        self._rate_from = (0.0, 0)
        self._rate = 0.0
        desk.session.document_changed.connect(self.drop_all)

    @property
    def is_running(self) -> bool:
        """Whether a run works or rests."""
        return self._job is not None

    @property
    def is_paused(self) -> bool:
        """Whether the run rests between two iterates."""
        return self._job is not None and self._job.is_paused

    @property
    def waiting(self) -> int:
        """How many runs wait for this one to end."""
        return len(self._waiting)

    @property
    def name(self) -> str:
        """Of the run that works, "" if none does."""
        return "" if self._control is None else self._control.name

    @property
    def record(self) -> IterateRecord | None:
        """What the run that works has left behind so far."""
        return None if self._control is None else self._control.record

    @property
    def inputs(self) -> RunInputs | None:
        """What the run that works was given, None until that is worked out."""
        return None if self._control is None else self._control.inputs

    @property
    def rate(self) -> float:
        """Iterations a second, lately."""
        return self._rate

    def run(self) -> None:
        """Solve the project as it is now; while another run works, this one waits for it."""
        control = self._prepared()
        if self._job is None:
            self._begin(control)
            return
        self._waiting.append(control)
        self._desk.notices.note(
            self.tr("{name} waits until {other} has ended.").format(name=control.name, other=self.name)
        )
        self.changed.emit()

    def pause(self) -> None:
        """Rest after this iterate."""
        if self._job is not None:
            self._job.pause()
            self.changed.emit()

    def resume(self) -> None:
        """Go on."""
        if self._job is not None:
            self._job.resume()
            self._rate_from = (time.perf_counter(), 0 if self.record is None else self.record.count)
            self.changed.emit()

    def step(self) -> None:
        """Do one iteration and rest; begin a run if none works."""
        if self._job is None:
            control = self._prepared()
            control.single.set()
            self._begin(control)
        elif self._control is not None:
            self._control.single.set()
            self._job.resume()

    def stop(self) -> None:
        """End the run that works with its best iterate."""
        if self._job is not None and self._control is not None:
            self._control.enough.set()
            self._job.resume()

    def drop_waiting(self) -> None:
        """Let none of the waiting runs begin."""
        self._waiting.clear()
        self.changed.emit()

    def drop_all(self) -> None:
        """End all runs and keep none of them: they belong to another document."""
        self._waiting.clear()
        self._records.clear()
        self._control = None
        if self._job is not None:
            self._job.stop()

    def record_of(self, run: Run) -> IterateRecord | None:
        """Return the figures of every iterate of one of the last runs; others have 2,000 of them at most."""
        return next((record for layout, record in self._records if layout is run.layout), None)

    def newest_line(self) -> Centreline3D | None:
        """Return the 3D line of the newest iterate of the run that works."""
        control = self._control
        if control is None or control.line is None or control.inputs is None or control.record.newest is None:
            return None
        return line_of(control.line, control.inputs, control.record.newest)

    def _prepared(self) -> _Control:
        project = self._desk.session.project
        names = {run.name for run in project.runs} | {waiting.name for waiting in self._waiting} | {self.name}
        number = len(project.runs) + 1
        while (name := self.tr("Run {number}").format(number=number)) in names:
            number += 1
        return _Control(project, name)

    def _begin(self, control: _Control) -> None:
        self._control = control
        self._told, self._rate, self._rate_from = 0.0, 0.0, (time.perf_counter(), 0)
        self._wait = _TELL_EVERY_S
        job = self._desk.runner.start(
            self.tr("Solving {name}").format(name=control.name),
            lambda: _pulled(control),
            done=self._on_done,
            failed=self._desk.notices.error,
            progressed=self._on_progress,
        )
        control.pause, control.rest = job.pause, job.rest
        job.when_user_stops = self.stop
        self._job = job
        job.ended.connect(self._on_ended)
        self.changed.emit()

    def _on_progress(self, count: int) -> None:
        now = time.perf_counter()
        if now - self._told < self._wait and not self.is_paused:
            return
        self._told = now
        since, before = self._rate_from
        if now > since:
            self._rate = (count - before) / (now - since)
        self._rate_from = (now, count)
        control = self._control
        if control is not None:
            control.gate.clear()
        self.advanced.emit()
        if self.is_paused:
            self.changed.emit()
        # What listeners have asked to be laid out and painted is done now, while the solver waits for it.
        for kind in (QEvent.Type.LayoutRequest, QEvent.Type.UpdateRequest):
            QCoreApplication.sendPostedEvents(None, kind.value)
        self._wait = max(_TELL_EVERY_S, (time.perf_counter() - now) / _SHOWING_SHARE)
        if control is not None:
            control.gate.set()

    def _on_done(self, run: Run) -> None:
        from bobdesk.project import edits

        control = self._control
        if control is None:
            return
        self._records.append((run.layout, control.record))
        self.advanced.emit()
        label = self.tr("Solve, {name}").format(name=run.name)
        if self._desk.session.apply(label, lambda project: edits.keep_run(project, run)):
            self.kept.emit(run)

    def _on_ended(self) -> None:
        self._job, self._control = None, None
        if self._waiting:
            self._begin(self._waiting.popleft())
        else:
            self.changed.emit()


def line_of(line: Centreline, inputs: RunInputs, iterate: Iterate) -> Centreline3D:
    """Return the 3D line of an iterate.

    Raises
    ------
    InputError
        If its method keeps no lines of its iterates.
    """
    from bobdesk.project.new_run import solution_at
    from bobdesk.track.centreline3d import make_centreline3d

    return make_centreline3d(line, inputs.segments, solution_at(inputs, iterate))


def solving_of(desk: Desk) -> Solving:
    """Return the one `Solving` that all parts of a window share."""
    found = desk.session.findChild(Solving, "solving")
    if found is not None:
        return found
    made = Solving(desk, desk.session)
    made.setObjectName("solving")
    return made

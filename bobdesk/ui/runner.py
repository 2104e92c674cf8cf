"""Long jobs: generators pulled on threads, so that the window stays free; the window looks in on them.

No signal crosses a thread: a worker leaves what it has in its job, and a timer of the window's thread
fetches it from there.
"""

from __future__ import annotations

import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Generator
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal

from bobdesk.errors import InputError, TargetError

MakeJob = Callable[[], Generator[Any, None, Any]]
_LOOK_EVERY_MS = 15
# Each look takes the interpreter from the workers: long jobs are looked at less often.
_LOOK_AT_LONG_EVERY_MS = 40
_LONG_S = 0.5
# The longest that a busy worker keeps the interpreter from the window; at Python's 5 ms a picture that is drawn in
# 300 calls of Qt, each of which lets go of the interpreter and wants it back, takes a second.
_HAND_OVER_AFTER_S = 0.0002
_MOST_STEPS_WAITING = 20_000
# What a closing window waits for a job to come to its next step.
_PATIENCE_S = 3.0


class Job(QObject):
    """A generator that is pulled on a thread of its own.

    Signals
    -------
    progressed
        The newest thing that the generator has yielded (a `Progress` for most jobs), at most 60 times a second.
    finished
        The generator's result.
    failed
        A sentence for the user.
    stopped
        The job was stopped before its end, by the user or by a fault, which is raised after that.
    ended
        After any of the three.
    """

    progressed = Signal(object)
    finished = Signal(object)
    failed = Signal(str)
    stopped = Signal()
    ended = Signal()

    def __init__(self, title: str, make: MakeJob, parent: QObject) -> None:
        super().__init__(parent)
        self.title = title
        self.began = time.monotonic()
        self.latest: Any = None
        # What the user's Stop does, for jobs that keep what they have reached; others are just stopped.
        self.when_user_stops: Callable[[], object] = self.stop
        self._make = make
        self._steps: deque[Any] = deque(maxlen=_MOST_STEPS_WAITING)
        self._stop = threading.Event()
        self._may_go_on = threading.Event()
        self._may_go_on.set()
        self._outcome: tuple[str, Any] | None = None
        self._told = False
        self._thread = threading.Thread(target=self._run, name=f"job: {title}", daemon=True)

    @property
    def is_running(self) -> bool:
        """Whether the end has not been told yet."""
        return not self._told

    @property
    def is_paused(self) -> bool:
        """Whether the job rests between two steps."""
        return not self._may_go_on.is_set()

    def stop(self) -> None:
        """Have the job end at its next step; `stopped` follows."""
        self._stop.set()
        self._may_go_on.set()

    def pause(self) -> None:
        """Rest at the next step."""
        self._may_go_on.clear()

    def resume(self) -> None:
        """Go on after a rest."""
        self._may_go_on.set()

    def rest(self) -> bool:
        """Wait, on any thread of the job, while it is paused; return whether it has been stopped."""
        self._may_go_on.wait()
        return self._stop.is_set()

    def drained(self) -> list[Any]:
        """Return, and forget, what was yielded since the last time, for those who want every step."""
        steps = []
        while self._steps:
            steps.append(self._steps.popleft())
        return steps

    def begin(self) -> None:
        """Start the thread."""
        self._thread.start()

    def look(self) -> None:
        """Tell of what has happened since the last look; called by the runner on the window's thread."""
        latest, self.latest = self.latest, None
        outcome = self._outcome
        if latest is not None and outcome is None and not self._stop.is_set():
            self.progressed.emit(latest)
        if outcome is None or self._told:
            return
        self._told = True
        self._thread.join()
        kind, value = outcome
        if self._stop.is_set() and kind != "crashed":
            self.stopped.emit()
        elif kind == "finished":
            self.finished.emit(value)
        elif kind == "failed":
            self.failed.emit(value)
        if kind == "crashed":
            self.stopped.emit()
        self.ended.emit()
        if kind == "crashed":
            raise value

    def wait(self, timeout: float) -> bool:
        """Wait for the thread; return whether it has ended."""
        self._thread.join(timeout)
        return not self._thread.is_alive()

    def _run(self) -> None:
        try:
            self._outcome = ("finished", self._pulled())
        except (InputError, TargetError) as error:
            self._outcome = ("failed", str(error))
        except MemoryError:
            self._outcome = ("failed", "There is not enough memory for this.")
        except Exception as error:  # noqa: BLE001 - a fault in a job is told by the window, which keeps the work
            self._outcome = ("crashed", error)

    def _pulled(self) -> Any:
        job = self._make()
        try:
            while not self._stop.is_set():
                try:
                    step = next(job)
                except StopIteration as end:
                    return end.value
                self._steps.append(step)
                self.latest = step
                self._may_go_on.wait()
        finally:
            job.close()
        return None


class Runner(QObject):
    """All jobs of one window."""

    jobs_changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._jobs: list[Job] = []
        self._timer = QTimer(self)
        self._timer.setInterval(_LOOK_EVERY_MS)
        self._timer.timeout.connect(self._look)
        sys.setswitchinterval(_HAND_OVER_AFTER_S)

    @property
    def jobs(self) -> tuple[Job, ...]:
        """The jobs that have not ended, oldest first."""
        return tuple(self._jobs)

    def start(
        self,
        title: str,
        make: MakeJob,
        *,
        done: Callable[[Any], None] | None = None,
        failed: Callable[[str], None] | None = None,
        stopped: Callable[[], None] | None = None,
        progressed: Callable[[Any], None] | None = None,
    ) -> Job:
        """Start a job and return it; the callables are called on the window's thread.

        Parameters
        ----------
        title
            What is being done, for the user: "Tracing the line".
        make
            Called on the job's thread; returns the generator that is pulled.
        """
        job = Job(title, make, self)
        for signal, call in (
            (job.finished, done),
            (job.failed, failed),
            (job.stopped, stopped),
            (job.progressed, progressed),
        ):
            if call is not None:
                signal.connect(call)
        self._jobs.append(job)
        job.begin()
        self._timer.start(_LOOK_EVERY_MS)
        self.jobs_changed.emit()
        return job

    def stop_all(self) -> None:
        """Stop every job; their `stopped` follows."""
        for job in self._jobs:
            job.stop()

    def close(self) -> None:
        """Stop every job and wait for the threads; nothing more is told."""
        self._timer.stop()
        self.stop_all()
        until = time.monotonic() + _PATIENCE_S
        for job in self._jobs:
            job.wait(max(0.0, until - time.monotonic()))
        self._jobs.clear()

    def _look(self) -> None:
        # What is told may ask the user, and a timer does not fire within its own call: other jobs must go on meanwhile.
        now = time.monotonic()
        are_long = all(now - job.began > _LONG_S for job in self._jobs)
        self._timer.start(_LOOK_AT_LONG_EVERY_MS if are_long else _LOOK_EVERY_MS)
        for job in tuple(self._jobs):
            if not job.is_running:
                continue  # its end is just being told, further down the stack
            try:
                job.look()
            finally:
                if not job.is_running and job in self._jobs:
                    self._jobs.remove(job)
                    job.deleteLater()
                    self.jobs_changed.emit()
                if not self._jobs:
                    self._timer.stop()

"""The newest of many questions answered in the background: older ones are dropped, never queued."""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import Any

from PySide6.QtCore import QObject, Signal

from bobdesk.progress import Progress
from bobdesk.ui.runner import Job, Runner


class Newest(QObject):
    """Runs one function at a time on a thread; of the questions that come meanwhile only the last is kept.

    Parameters
    ----------
    title
        What is being worked out, for the user.

    Signals
    -------
    answered
        What the function of the newest question returned.
    failed
        The sentence with which it refused.
    """

    answered = Signal(object)
    failed = Signal(str)

    def __init__(self, runner: Runner, title: str, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._runner = runner
        self._title = title
        self._job: Job | None = None
        self._next: Callable[[], Any] | None = None
        self._is_dropped = False

    @property
    def is_busy(self) -> bool:
        """Whether an answer is still to come."""
        return self._job is not None

    def ask(self, function: Callable[[], Any]) -> None:
        """Have `function` called on a thread; it must touch nothing of the window.

        Where it returns a generator, that is pulled to its end, and another question stops it between two steps.
        """
        self._next, self._is_dropped = function, False
        if self._job is None:
            self._begin()
        else:
            self._job.stop()

    def drop(self) -> None:
        """Want no answer any more."""
        self._next, self._is_dropped = None, True
        if self._job is not None:
            self._job.stop()

    def _begin(self) -> None:
        function, self._next = self._next, None
        if function is None:
            return
        title = self._title

        def steps() -> Generator[Progress, None, Any]:
            yield Progress(0.0, title)
            answer = function()
            if isinstance(answer, Generator):
                answer = yield from answer
            return answer

        job = self._runner.start(title, steps, done=self._on_done, failed=self._on_failed, stopped=self._on_stopped)
        self._job = job
        job.ended.connect(self._on_ended)

    def _on_done(self, answer: object) -> None:
        # A question that came in the same moment makes this answer old.
        if self._next is None:
            self.answered.emit(answer)

    def _on_failed(self, sentence: str) -> None:
        if self._next is None:
            self.failed.emit(sentence)

    def _on_stopped(self) -> None:
        # By the user: nothing else would ever be told.
        if self._next is None and not self._is_dropped:
            self.failed.emit(self.tr("Stopped; the next change begins it again"))

    def _on_ended(self) -> None:
        self._job = None
        self._begin()

"""What showing a run costs the solver, and how late the window is meanwhile.

The window works and sleeps by turns within one run, so that both rates are those of the same machine at the same time.
Time in which the solver could have worked, but other programs had the processor, is left out where the system tells it
(Linux).
"""

from __future__ import annotations

import statistics
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from PySide6.QtCore import QEventLoop, QTimer
from PySide6.QtWidgets import QApplication

from bobdesk.progress import finish
from bobdesk.project import edits
from bobdesk.solve.settings import SolverSettings
from bobdesk.ui.main_window import MainWindow
from bobdesk.ui.settings import Settings
from bobdesk.ui.solving import solving_of
from bobdesk.ui.theme import apply_theme
from bobdesk.ui.warm_up import warm_up_steps
from tests.project.made_projects import ready_project

_EVERY_MS = 20
_TURN_S = 0.4
_ENOUGH = 170_000
_SOLVER = "job: Solving"


class _Run:
    """One run in the window, with the rates of its turns and the lateness of the window's events."""

    def __init__(self, window: MainWindow, qapp: QApplication) -> None:
        self._qapp = qapp
        self._solving = solving_of(window.desk)
        self._runner = window.desk.runner
        self.shown: list[float] = []
        self.unseen: list[float] = []
        self.late: list[float] = []
        self.frames = 0
        self.late_alone: list[float] = []
        self._due = 0.0
        self._queued = 0.0
        self._solving.advanced.connect(self._on_advanced)

    def _on_advanced(self) -> None:
        self.frames += 1

    def work(self, seconds: float) -> None:
        """Begin, take turns, and end."""
        self._quiet()
        timer = QTimer()
        timer.setInterval(_EVERY_MS)
        timer.timeout.connect(self._tick)
        began = time.perf_counter()
        timer.start()
        self._due = time.perf_counter() + _EVERY_MS / 1000
        self._solving.run()
        # The beginning counts as shown work: buttons change, and the first pictures are drawn.
        self._show(_TURN_S)
        # It ends by itself after 200,000 iterations.
        while time.perf_counter() - began < seconds and self._solving.record.count < _ENOUGH:
            self.unseen.append(self._rate(time.sleep))
            self._due = time.perf_counter() + _EVERY_MS / 1000
            self.shown.append(self._rate(self._show))
        timer.stop()
        self._solving.drop_all()
        self._quiet()

    def _quiet(self) -> None:
        end = time.perf_counter() + 0.5
        while time.perf_counter() < end or self._runner.jobs:
            self._qapp.processEvents()
            time.sleep(0.002)

    def _tick(self) -> None:
        now, queued = time.perf_counter(), _queued("MainThread")
        late = max(0.0, now - self._due)
        self.late.append(1000 * late)
        self.late_alone.append(1000 * max(0.0, late - (queued - self._queued)))
        self._due, self._queued = now + _EVERY_MS / 1000, queued

    def _show(self, seconds: float) -> None:
        loop = QEventLoop()
        QTimer.singleShot(round(1000 * seconds), loop.quit)
        loop.exec()

    def _rate(self, turn: Callable[[float], object]) -> float:
        began, queued, before = time.perf_counter(), _queued(_SOLVER), self._solving.record.count
        turn(_TURN_S)
        seconds = time.perf_counter() - began - (_queued(_SOLVER) - queued)
        return (self._solving.record.count - before) / seconds


def _queued(name: str) -> float:
    """Return the seconds that a thread has waited for a processor so far."""
    for thread in threading.enumerate():
        if thread.name.startswith(name):
            found = Path(f"/proc/self/task/{thread.native_id}/schedstat")
            return int(found.read_text().split()[1]) / 1e9 if found.exists() else 0.0
    return 0.0


def main(rounds=5, seconds=7.0):
    """Print a table."""
    qapp = QApplication.instance() or QApplication([])
    apply_theme(qapp, "light")
    finish(warm_up_steps())
    project = edits.set_solver(
        edits.set_spacing(ready_project(), 10.0), SolverSettings(method="published", rate=1e-10, threshold=1e-300)
    )
    with tempfile.TemporaryDirectory() as folder:
        window = MainWindow(Settings(Path(folder) / "settings.ini"), Path(folder))
        window.resize(1440, 900)
        window.show()
        window.desk.session.open(project, None)
        window.go_to("Solve")
        run = _Run(window, qapp)
        for _ in range(rounds):
            run.work(seconds)
        window._may_close = True
        window.close()
    costs = [100 * (1 - shown / unseen) for shown, unseen in zip(run.shown, run.unseen, strict=True)]
    low, middle, high = statistics.quantiles(costs, n=4)
    unseen, shown = sum(run.unseen) / len(run.unseen), sum(run.shown) / len(run.shown)
    print(f"iterations a second, unseen {unseen:,.0f}, shown {shown:,.0f}: {100 * (1 - shown / unseen):.1f} % fewer")
    print(f"turn by turn, {len(costs)} pairs: {middle:.1f} % fewer (quartiles {low:.1f} and {high:.1f})")
    for what, late in (("", run.late), (", without waiting for a processor", run.late_alone)):
        half, most = np.percentile(late, [50, 99])
        print(f"lateness of {len(late)} events{what}: p50 {half:.1f} ms, p99 {most:.1f} ms, largest {max(late):.1f} ms")
    print(f"{run.frames} pictures shown")


if __name__ == "__main__":
    sys.exit(main())

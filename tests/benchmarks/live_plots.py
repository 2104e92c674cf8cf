"""What showing a run costs the solver, and how late the window is meanwhile.

The window sleeps, shows, and shows while its lateness is taken, by turns within one run, so that both rates are those
of the same machine at the same time. Time in which the solver could have worked, but other programs had the processor,
is left out where the system tells it (Linux).
"""

from __future__ import annotations

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
from bobdesk.ui.warm_up import warm_up_plots, warm_up_steps
from tests.project.made_projects import ready_project

_EVERY_MS = 20
_TURN_S = 0.4
_ENOUGH = 160_000
_SOLVER = "job: Solving"


class _Run:
    """One run in the window, with the rates of its turns and the lateness of the window's events."""

    def __init__(self, window: MainWindow, qapp: QApplication) -> None:
        self._qapp = qapp
        self._solving = solving_of(window.desk)
        self._runner = window.desk.runner
        self.shown: list[tuple[float, float, float]] = []
        self.unseen: list[tuple[float, float, float]] = []
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
        began = time.perf_counter()
        timer = self._ticking()
        self._solving.run()
        # The beginning is late, too: buttons change, and the first pictures are drawn.
        self._show(_TURN_S)
        timer.stop()
        # It ends by itself after 200,000 iterations.
        while time.perf_counter() - began < seconds and self._solving.record.count < _ENOUGH:
            asleep = time.perf_counter()
            self.unseen.append(self._turn(time.sleep))
            # What the window has slept is no time since its last picture.
            self._solving._told += time.perf_counter() - asleep
            # To look at the clock is work, too: rates and lateness have turns of their own.
            self.shown.append(self._turn(self._show))
            timer = self._ticking()
            self._show(_TURN_S)
            timer.stop()
        self._solving.drop_all()
        self._quiet()

    def _quiet(self) -> None:
        end = time.perf_counter() + 0.5
        while time.perf_counter() < end or self._runner.jobs:
            self._qapp.processEvents()
            time.sleep(0.002)

    def _ticking(self) -> QTimer:
        timer = QTimer()
        timer.setInterval(_EVERY_MS)
        timer.timeout.connect(self._tick)
        timer.start()
        self._due, self._queued = time.perf_counter() + _EVERY_MS / 1000, _spent("MainThread")[1]
        return timer

    def _tick(self) -> None:
        now, queued = time.perf_counter(), _spent("MainThread")[1]
        late = max(0.0, now - self._due)
        self.late.append(1000 * late)
        self.late_alone.append(1000 * max(0.0, late - (queued - self._queued)))
        self._due, self._queued = now + _EVERY_MS / 1000, queued

    def _show(self, seconds: float) -> None:
        loop = QEventLoop()
        QTimer.singleShot(round(1000 * seconds), loop.quit)
        loop.exec()

    def _turn(self, turn: Callable[[float], object]) -> tuple[float, float, float]:
        """Return iterations, seconds without those in which others had the processor, and seconds of work of a turn."""
        began, before, (worked, queued) = time.perf_counter(), self._solving.record.count, _spent(_SOLVER)
        turn(_TURN_S)
        seconds = time.perf_counter() - began
        then_worked, then_queued = _spent(_SOLVER)
        return self._solving.record.count - before, seconds - (then_queued - queued), then_worked - worked


def _spent(name: str) -> tuple[float, float]:
    """Return the seconds that a thread has worked, and waited for a processor, so far; 0 where that is not told."""
    for thread in threading.enumerate():
        if thread.name.startswith(name):
            found = Path(f"/proc/self/task/{thread.native_id}/schedstat")
            if found.exists():
                worked, queued = found.read_text().split()[:2]
                return int(worked) / 1e9, int(queued) / 1e9
    return 0.0, 0.0


def main(rounds=5, seconds=10.0):
    """Print a table."""
    qapp = QApplication.instance() or QApplication([])
    apply_theme(qapp, "light")
    finish(warm_up_steps())
    warm_up_plots()
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
    unseen, shown = np.array(run.unseen), np.array(run.shown)
    rates = [turns[:, 0] / turns[:, 1] for turns in (unseen, shown)]
    low, middle, high = np.percentile(100 * (1 - rates[1] / rates[0]), [25, 50, 75])
    (all_unseen, free_unseen, _), (all_shown, free_shown, worked) = unseen.sum(axis=0), shown.sum(axis=0)
    slow, fast = all_shown / free_shown, all_unseen / free_unseen
    print(f"iterations a second, unseen {fast:,.0f}, shown {slow:,.0f}: {100 * (1 - slow / fast):.1f} % fewer")
    print(f"turn by turn, {len(shown)} pairs: {middle:.1f} % fewer (quartiles {low:.1f} and {high:.1f})")
    print(f"of its time the solver waits {100 * (1 - worked / free_shown):.1f} % for the window that shows it")
    for what, late in (("", run.late), (", without waiting for a processor", run.late_alone)):
        half, most = np.percentile(late, [50, 99])
        print(f"lateness of {len(late)} events{what}: p50 {half:.1f} ms, p99 {most:.1f} ms, largest {max(late):.1f} ms")
    print(f"{run.frames} pictures shown")


if __name__ == "__main__":
    sys.exit(main())

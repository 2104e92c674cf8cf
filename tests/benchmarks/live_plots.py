"""What showing a run costs the solver, and how late the window is meanwhile."""

from __future__ import annotations

import statistics
import tempfile
import threading
import time
from pathlib import Path

import numpy as np
from PySide6.QtCore import QEventLoop, QTimer
from PySide6.QtWidgets import QApplication

from bobdesk.progress import finish
from bobdesk.project import edits
from bobdesk.solve.settings import SolverSettings
from bobdesk.ui.main_window import MainWindow
from bobdesk.ui.settings import Settings
from bobdesk.ui.solving import _Control, _pulled, solving_of
from bobdesk.ui.theme import apply_theme
from bobdesk.ui.warm_up import warm_up_steps
from tests.project.made_projects import ready_project

_EVERY_MS = 20


def unseen_rate(project, seconds):
    """Iterations a second of a thread that nobody looks at."""
    control = _Control(project, "unseen")
    job = _pulled(control)
    until = [0.0]

    def pull():
        next(job)
        until[0] = time.perf_counter() + seconds
        while time.perf_counter() < until[0]:
            next(job)

    thread = threading.Thread(target=pull)
    began = time.perf_counter()
    thread.start()
    thread.join()
    count = control.record.count
    elapsed = time.perf_counter() - began
    job.close()
    return count / elapsed


def seen_rate(window, qapp, project, seconds):
    """Iterations a second in the window, and how late its events are, ms."""
    window.desk.session.open(project, None)
    window.go_to("Solve")
    solving = solving_of(window.desk)
    end = time.perf_counter() + 1.5
    while time.perf_counter() < end:
        qapp.processEvents()
        time.sleep(0.002)
    late = []
    due = [time.perf_counter()]

    def tick():
        now = time.perf_counter()
        late.append(1000 * max(0.0, now - due[0] - _EVERY_MS / 1000))
        due[0] = now

    timer = QTimer()
    timer.setInterval(_EVERY_MS)
    timer.timeout.connect(tick)
    solving.run()
    began = time.perf_counter()
    timer.start()
    due[0] = time.perf_counter()
    loop = QEventLoop()
    QTimer.singleShot(round(1000 * seconds), loop.quit)
    loop.exec()
    timer.stop()
    count, elapsed = solving.record.count, time.perf_counter() - began
    solving.drop_all()
    while solving.is_running:
        qapp.processEvents()
        time.sleep(0.002)
    return count / elapsed, late


def main(rounds=4, seconds=4.0):
    """Print a table."""
    qapp = QApplication.instance() or QApplication([])
    apply_theme(qapp, "light")
    finish(warm_up_steps())
    project = edits.set_solver(
        edits.set_spacing(ready_project(), 10.0), SolverSettings(method="published", rate=1e-13, threshold=1e-300)
    )
    with tempfile.TemporaryDirectory() as folder:
        window = MainWindow(Settings(Path(folder) / "settings.ini"), Path(folder))
        window.resize(1440, 900)
        window.show()
        unseen, seen, late = [], [], []
        for _ in range(rounds):
            unseen.append(unseen_rate(project, seconds))
            rate, delays = seen_rate(window, qapp, project, seconds)
            seen.append(rate)
            late += delays
        window._may_close = True
        window.close()
    a, b = statistics.median(unseen), statistics.median(seen)
    print(f"iterations a second, unseen {a:,.0f}, shown {b:,.0f}: {100 * (1 - b / a):.1f} % fewer")
    print(f"lateness of the window: p50 {np.percentile(late, 50):.1f} ms, p99 {np.percentile(late, 99):.1f} ms")


if __name__ == "__main__":
    main()

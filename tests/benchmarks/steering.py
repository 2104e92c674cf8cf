"""How long a run of each method goes on after Pause and after Stop."""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QApplication

from bobdesk.files.project_file import load_project
from bobdesk.progress import finish
from bobdesk.project import derive, edits
from bobdesk.solve.run import METHODS
from bobdesk.solve.settings import SolverSettings
from bobdesk.ui.desk import Desk
from bobdesk.ui.notices import Notices
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.runner import Runner
from bobdesk.ui.selection import Selection
from bobdesk.ui.session import Session
from bobdesk.ui.settings import Settings
from bobdesk.ui.solving import Solving
from bobdesk.ui.warm_up import warm_up_plots, warm_up_steps

LONG_LINE = Path(__file__).parent.parent.parent / "resources" / "samples" / "sa_calobra" / "sa_calobra.bobdesk"
_TIMES = 5


class _Watch:
    """Notes when the solver last asked, or handed over an iterate."""

    def __init__(self, solving: Solving) -> None:
        self._control = solving._control
        self.last = time.perf_counter()
        rest, append = self._control.rest, self._control.record.append

        def resting() -> bool:
            self.last = time.perf_counter()
            return rest()

        def appending(iterate: object) -> None:
            self.last = time.perf_counter()
            append(iterate)

        self._control.rest, self._control.record.append = resting, appending


def main() -> None:
    """Print a table."""
    qapp = QApplication.instance() or QApplication([])
    owner = QObject()
    folder = tempfile.TemporaryDirectory()
    settings = Settings(Path(folder.name) / "settings.ini", owner)
    runner = Runner(owner)
    desk = Desk(Session(owner), Selection(owner), None, runner, Notices(owner), settings, Quantities(settings, owner))
    desk.session.open(load_project(LONG_LINE), None)
    # The window has worked these out before one presses F5.
    finish(warm_up_steps())
    warm_up_plots()
    derive.run_inputs(desk.session.project).needed()
    solving = Solving(desk, owner)

    def work(seconds: float) -> None:
        end = time.perf_counter() + seconds
        while time.perf_counter() < end:
            qapp.processEvents()
            time.sleep(0.001)

    print(f"{'method':13s} {'goes on after Pause, ms':>25s} {'ended after Stop, ms':>25s}")
    for method in METHODS:
        chosen = SolverSettings(method=method.key, rate=1e-10, threshold=1e-300)
        desk.session.apply("Method", lambda project, chosen=chosen: edits.set_solver(project, chosen))
        pauses, stops = [], []
        for number in range(_TIMES):
            solving.run()
            watch = _Watch(solving)
            work(0.1 + 0.037 * number)
            if not solving.is_running:
                continue  # the recommended method needs less time than that
            began = time.perf_counter()
            solving.pause()
            work(0.5)
            pauses.append(1000 * max(0.0, watch.last - began))
            solving.resume()
            work(0.05)
            began = time.perf_counter()
            solving.stop()
            while solving.is_running:
                work(0.001)
            stops.append(1000 * (time.perf_counter() - began))
        said = [", ".join(f"{value:.0f}" for value in values) or "over before" for values in (pauses, stops)]
        print(f"{method.key:13s} {said[0]:>25s} {said[1]:>25s}")
    runner.close()
    folder.cleanup()


if __name__ == "__main__":
    main()

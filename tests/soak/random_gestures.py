"""Random actions in a whole window for a while: no exception, and memory that stays where it is.

usage: python -m tests.soak.random_gestures [--seconds 600] [--seed 1]
"""

from __future__ import annotations

import argparse
import gc
import random
import resource
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog

from bobdesk.project import edits
from bobdesk.solve.settings import SolverSettings
from bobdesk.solve.targets import KnownElevation
from bobdesk.ui.main_window import MainWindow
from bobdesk.ui.plots.convergence import ConvergencePlot
from bobdesk.ui.settings import Settings
from bobdesk.ui.solving import solving_of
from bobdesk.ui.theme import apply_theme

SAMPLES = Path(__file__).parent.parent.parent / "resources" / "samples"
FILES = (SAMPLES / "made_double" / "made_double.bobdesk", SAMPLES / "mugello" / "mugello.bobdesk")
# They open dialogs of the system, or end the window.
LEFT_OUT = {
    "new", "new_from_picture", "open", "save", "save_as", "import_coordinates", "compare_with_file", "close", "quit",
    "paste", "palette", "shortcuts", "preferences", "about", "full_screen", "load-points", "save-points",
}  # fmt: skip
_MOST_RUNS = 12
_GROWTH = 1.10


class Gestures:
    """Does one random thing after the other."""

    def __init__(self, window: MainWindow, chance: random.Random) -> None:
        self._window = window
        self._chance = chance
        self._kinds: tuple[Callable[[], None], ...] = (
            self._trigger, self._trigger, self._target, self._go, self._undo, self._key, self._known, self._space,
            self._run, self._steer, self._scrub, self._method,
        )  # fmt: skip

    def one(self) -> str:
        """Do one, and return its name."""
        kind = self._chance.choice(self._kinds)
        kind()
        while len(self._window.desk.session.project.runs) > _MOST_RUNS:
            self._window.desk.session.apply("Delete run", lambda project: edits.remove_run(project, 0))
        return kind.__name__

    def _trigger(self) -> None:
        names = [row.name for row in self._window.actions_by_name.table if row.name not in LEFT_OUT]
        names = [name for name in names if not self._window.actions_by_name[name].text().endswith("…")]
        action = self._window.actions_by_name[self._chance.choice(names)]
        if action.isEnabled():
            action.trigger()

    def _target(self) -> None:
        session = self._window.desk.session
        drop = self._chance.uniform(20, 150)
        session.apply("Drop", lambda project: edits.set_drop(project, drop), key="drop")

    def _known(self) -> None:
        known = KnownElevation(self._chance.uniform(10, 600), self._chance.uniform(5, 30), self._chance.choice((0, 2)))
        self._window.desk.session.apply("Known", lambda project: edits.set_known_elevations(project, (known,)))

    def _go(self) -> None:
        steps = ("Plan", "Scale", "Centreline", "Segments", "Solve", "Export")
        self._window.go_to(self._chance.choice(steps))

    def _undo(self) -> None:
        for _ in range(self._chance.randrange(1, 4)):
            self._window.desk.session.undo() if self._chance.random() < 0.6 else self._window.desk.session.redo()

    def _key(self) -> None:
        keys = (Qt.Key.Key_Escape, Qt.Key.Key_Plus, Qt.Key.Key_Minus, Qt.Key.Key_Right, Qt.Key.Key_Down, Qt.Key.Key_F)
        QTest.keyClick(self._window.view, self._chance.choice(keys))

    def _space(self) -> None:
        self._window.views.show_in_space(self._chance.random() < 0.5)

    def _run(self) -> None:
        solving = solving_of(self._window.desk)
        solving.run() if solving.waiting < 2 else solving.stop()

    def _steer(self) -> None:
        solving = solving_of(self._window.desk)
        self._chance.choice((solving.pause, solving.resume, solving.step, solving.stop, solving.drop_waiting))()

    def _scrub(self) -> None:
        for plot in self._window.findChildren(ConvergencePlot):
            plot.chosen.emit(self._chance.randrange(0, 300))

    def _method(self) -> None:
        methods = ("pgd", "pgd", "published", "slsqp", "lbfgsb", "trustconstr", "de")
        # The published method in tiny steps takes until it is stopped.
        rate = self._chance.choice((None, 1e-12))
        settings = SolverSettings(method=self._chance.choice(methods), rate=rate, threshold=1e-9)
        self._window.desk.session.apply("Method", lambda project: edits.set_solver(project, settings))


def resident() -> float:
    """Return the memory of this process, MB."""
    try:
        pages = int(Path("/proc/self/statm").read_text().split()[1])
    except OSError:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return pages * resource.getpagesize() / 1e6


def _refuse() -> None:
    asking = QApplication.activeModalWidget()
    if isinstance(asking, QDialog):
        asking.reject()


def main(arguments: list[str]) -> int:
    """Return 0 if nothing went wrong."""
    parser = argparse.ArgumentParser(description="Random actions in a whole window.")
    parser.add_argument("--seconds", type=float, default=600.0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args(arguments)
    faults: list[str] = []
    sys.excepthook = lambda kind, error, _trace: faults.append(f"{kind.__name__}: {error}")
    application = QApplication.instance() or QApplication([])
    apply_theme(application, "light")  # type: ignore[arg-type]
    chance = random.Random(options.seed)
    count, early, memory = 0, 0.0, 0.0
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        window = MainWindow(Settings(Path(folder) / "settings.ini"), Path(folder))
        window.resize(1200, 800)
        window.show()
        window.open_file(FILES[0])
        QTest.qWait(1500)
        gestures = Gestures(window, chance)
        # Whatever asks something while nobody is there gets no for an answer.
        refusal = QTimer()
        refusal.timeout.connect(_refuse)
        refusal.start(200)
        done = ""
        while time.monotonic() - began < options.seconds and not faults:
            done = gestures.one()
            QTest.qWait(20)
            count += 1
            if count % 100 == 0:
                gc.collect()
                memory = resident()
                # The first third fills caches and the history of undo.
                if time.monotonic() - began < options.seconds / 3:
                    early = max(early, memory)
        refusal.stop()
        window._may_close = True
        window.close()
        QTest.qWait(200)
    print(f"{count} gestures, seed {options.seed}, memory {early:.0f} MB after a third, {memory:.0f} MB at the end")
    if faults:
        print(f"fault after {done}: {faults[0]}")
        return 1
    return 0 if not early or memory <= _GROWTH * early else 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

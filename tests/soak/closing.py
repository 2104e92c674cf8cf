"""The real program is closed in the middle of a run, again and again: each must end with 0 and without a word.

usage: python -m tests.soak.closing [--times 50]
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent.parent
METHODS = ("published", "pgd", "de", "slsqp", "trustconstr", "lbfgsb")
WAYS = ("close", "quit", "rest and close", "queue and close", "stop and close", "leave the event loop")
_PATIENCE_S = 60.0
_MOST_DELAY_MS = 350
# What a screen without a window manager says of windows in general.
_HARMLESS = "This plugin does not support"


def close_once(number: int, folder: Path) -> str:
    """Start the program, close it in the middle of a run, and return what was wrong about it, "" for nothing."""
    home = folder / f"home{number}"
    home.mkdir()
    folders = {name: str(home) for name in ("HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME", "APPDATA")}
    try:
        ended = subprocess.run(
            [sys.executable, "-m", "tests.soak.closing", "--one", str(number), "--folder", str(home)],
            cwd=ROOT,
            env={**os.environ, **folders, "PYTHONFAULTHANDLER": "1", "OPENBLAS_NUM_THREADS": "1"},
            capture_output=True,
            text=True,
            timeout=_PATIENCE_S,
        )
    except subprocess.TimeoutExpired:
        return f"{described(number)}: still there after {_PATIENCE_S:.0f} s"
    said = [line for line in (ended.stdout + ended.stderr).splitlines() if line and not line.startswith(_HARMLESS)]
    if said[-1:] != ["closed in the middle of a run"]:
        said.append("it was not closed in the middle of a run")
    elif len(said) == 1 and ended.returncode == 0:
        return ""
    return f"{described(number)}: status {ended.returncode}, {' / '.join(said[-8:])}"


def described(number: int) -> str:
    """Return what the program does the n-th time."""
    return f"{number}: {METHODS[number % len(METHODS)]}, {WAYS[number // 2 % len(WAYS)]}"


def _one(number: int, folder: Path) -> int:
    from PySide6.QtCore import QCoreApplication, QTimer

    from bobdesk.files.project_file import save_project
    from bobdesk.project import edits
    from bobdesk.solve.settings import SolverSettings
    from bobdesk.ui import application
    from bobdesk.ui.solving import solving_of
    from tests.project.made_projects import coordinates_project

    settings = SolverSettings(method=METHODS[number % len(METHODS)], rate=1e-10, threshold=1e-300)
    project = edits.set_drop(edits.set_length(coordinates_project(), 2000.0), 150.0)
    project = edits.set_solver(project, settings)
    path = folder / "track.bobdesk"
    save_project(project, path)
    delay = number * 97 % _MOST_DELAY_MS

    class Closing(application.MainWindow):
        def __init__(self, *args: Any) -> None:
            super().__init__(*args)
            self._solving = solving_of(self.desk)
            self._look = QTimer(self)
            self._look.timeout.connect(self._begin)
            self._look.start(20)

        def _begin(self) -> None:
            if not self.desk.session.is_open:
                return
            self._look.stop()
            self.go_to("Solve")
            self._solving.run()
            QTimer.singleShot(delay, self, self._leave)

        def _leave(self) -> None:
            # Faults are told here, and not by a dialog that nobody sees.
            sys.excepthook = sys.__excepthook__
            if not self._solving.is_running:
                self._solving.run()
            way = WAYS[number // 2 % len(WAYS)]
            if way == "rest and close":
                self._solving.pause()
            elif way == "queue and close":
                self._solving.run()
            elif way == "stop and close":
                self._solving.stop()
            print("closed in the middle of a run" if self._solving.is_running else "no run to close in", flush=True)
            # Results that came before are not saved, and nobody is there to be asked.
            self._may_close = True
            if way == "quit":
                self.actions_by_name["quit"].trigger()
            elif way == "leave the event loop":
                QCoreApplication.quit()
            else:
                self.close()

    application.MainWindow = Closing  # type: ignore[misc]
    return application.start(path)


def main(arguments: list[str]) -> int:
    """Return 0 if the program ended cleanly each time."""
    parser = argparse.ArgumentParser(description="Close the program in the middle of a run.")
    parser.add_argument("--times", type=int, default=50)
    parser.add_argument("--one", type=int)
    parser.add_argument("--folder", type=Path)
    options = parser.parse_args(arguments)
    if options.one is not None:
        return _one(options.one, options.folder)
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        for number in range(options.times):
            found = close_once(number, Path(folder))
            if found:
                wrong.append(found)
                print(found, flush=True)
    print(f"closed in the middle of a run {options.times} times, {options.times - len(wrong)} of them cleanly")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

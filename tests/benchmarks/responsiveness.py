"""How late a 5 ms timer of the window fires while long work runs beside it, ms.

Run as ``python -m tests.benchmarks.responsiveness``. Work runs on threads of the same interpreter: a step that keeps
the interpreter to itself holds the window up. "idle" is what the machine itself adds.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Generator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from tests.benchmarks.measure import Row, apart, print_table

if TYPE_CHECKING:
    from bobdesk.plan.image import Pixels
    from bobdesk.project.project import Project

SAMPLES = Path(__file__).parent.parent.parent / "resources" / "samples"
_EVERY_MS = 5
_IDLE_S = 2.0
_LARGE = (8_400, 12_000)
Job = Callable[[], Generator[Any, None, Any]]


def lateness(work: str) -> Row:
    """Return how late the timer was while `work`, one of WORKS, ran; call in a fresh process."""
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    from PySide6.QtCore import Qt, QTimer
    from PySide6.QtWidgets import QApplication

    application = QApplication.instance() or QApplication([])
    from bobdesk.ui.runner import Runner
    from bobdesk.ui.warm_up import warm_up_steps

    if work != "getting ready":
        for _ in warm_up_steps():
            pass
    job = WORKS[work]()
    late: list[float] = []
    last = [0.0]

    def tick() -> None:
        now = time.perf_counter()
        late.append(max(0.0, 1e3 * (now - last[0]) - _EVERY_MS))
        last[0] = now

    timer, runner = QTimer(), Runner()
    timer.setTimerType(Qt.TimerType.PreciseTimer)
    timer.timeout.connect(tick)
    began = last[0] = time.perf_counter()
    timer.start(_EVERY_MS)
    runner.start(work, job, failed=print)
    while runner.jobs:
        application.processEvents()
        time.sleep(0.0005)
    seconds = time.perf_counter() - began
    timer.stop()
    runner.close()
    return {
        "work": work,
        "s": seconds,
        "median ms": float(np.median(late)),
        "p99 ms": float(np.percentile(late, 99)),
        "worst ms": float(np.max(late)),
    }


def _idle() -> Job:
    def steps() -> Generator[None, None, None]:
        until = time.perf_counter() + _IDLE_S
        while time.perf_counter() < until:
            time.sleep(0.05)
            yield

    return steps


def _getting_ready() -> Job:
    from bobdesk.ui.warm_up import warm_up_steps

    return warm_up_steps


def _tracing() -> Job:
    from bobdesk.files.pictures import read_picture
    from bobdesk.plan.trace import trace_line

    sample = SAMPLES / "made_thin"
    pixels = read_picture(sample / "plan.jpg").pixels
    ends = _ends(sample)
    return lambda: trace_line(pixels, ends)


def _tracing_large() -> Job:
    """The sample's plan, drawn on a sheet of 12000 × 8400 pixels."""
    from PIL import Image

    from bobdesk.files.pictures import read_picture
    from bobdesk.plan.trace import trace_line

    sample = SAMPLES / "made_thin"
    plan = Image.fromarray(np.asarray(read_picture(sample / "plan.jpg").pixels))
    scale = _LARGE[0] / plan.height
    drawn = np.asarray(plan.convert("RGB").resize((round(plan.width * scale), _LARGE[0]), Image.Resampling.BICUBIC))
    sheet: Pixels = np.full((*_LARGE, 3), 255, np.uint8)
    sheet[:, : drawn.shape[1]] = drawn
    ends = _ends(sample) * scale
    return lambda: trace_line(sheet, ends)


def _copies() -> Job:
    from bobdesk.plan.image import PlanImage
    from bobdesk.ui.plan_picture import with_levels_steps
    from tests.benchmarks.canvas import made_pixels

    image = PlanImage(made_pixels("colour"), None, 1, "PNG", (), None)
    return lambda: with_levels_steps(image)


def _reading() -> Job:
    import io

    from PIL import Image

    from bobdesk.project.project import Picture
    from bobdesk.ui.plan_picture import decoded_picture_steps
    from tests.benchmarks.canvas import made_pixels

    file = io.BytesIO()
    Image.fromarray(made_pixels("colour")).save(file, "JPEG", quality=80)
    picture = Picture(file.getvalue(), "large.jpg")
    return lambda: decoded_picture_steps(picture)


def _steps() -> Job:
    from bobdesk.ui.steps_bar import _look_steps

    project = _project()
    return lambda: _look_steps(project)


def _saving() -> Job:
    import tempfile

    from bobdesk.files.project_file import save_project

    project = _project()

    def steps() -> Generator[None, None, None]:
        yield
        with tempfile.TemporaryDirectory() as folder:
            save_project(project, Path(folder) / "saved.bobdesk")

    return steps


def _project() -> Project:
    from bobdesk.files.project_file import load_project

    return load_project(SAMPLES / "sa_calobra" / "sa_calobra.bobdesk")


def _ends(sample: Path) -> np.ndarray:
    truth = np.genfromtxt(sample / "truth.csv", delimiter=",", names=True)
    return np.array([[truth["px"][end], truth["py"][end]] for end in (0, -1)])


WORKS: dict[str, Callable[[], Job]] = {
    "idle": _idle,
    "getting ready": _getting_ready,
    "tracing": _tracing,
    "tracing 12000 × 8400": _tracing_large,
    "reading 12000 × 8400": _reading,
    "copies for the screen": _copies,
    "looking at the steps": _steps,
    "saving": _saving,
}


def rows() -> list[Row]:
    """One row for each of WORKS, each in a process of its own."""
    return [apart(lateness, work) for work in WORKS]


if __name__ == "__main__":
    print_table("Lateness of a 5 ms timer of the window while work runs, ms", rows())

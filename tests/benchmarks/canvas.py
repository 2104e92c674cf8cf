"""Milliseconds of processor a frame while a 12000 × 8400 picture with a trace is zoomed, panned and edited.

Run as ``python -m tests.benchmarks.canvas``. Painted by Qt's raster engine without a screen, 1600 × 1000.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from tests.benchmarks.measure import Row, apart, print_table

if TYPE_CHECKING:
    from bobdesk.ui.plan_view.view import PlanView

WIDTH, HEIGHT = 12_000, 8_400
KINDS = (("1 bit", 2_000), ("grey", 2_000), ("colour", 0), ("colour", 2_000), ("colour", 20_000))
_FRAMES = 60


def made_pixels(kind: str) -> np.ndarray:
    """Return noisy paper with a grid, (h, w), (h, w) bool or (h, w, 3)."""
    noise = np.random.default_rng(0).integers(200, 255, (HEIGHT, WIDTH), dtype=np.uint8)
    noise[::100], noise[:, ::100] = 120, 120
    if kind == "1 bit":
        return noise > 210
    return noise if kind == "grey" else np.repeat(noise[:, :, None], 3, axis=2)


def frames(kind: str, vertices: int) -> Row:
    """Return the mean and the worst frame of each gesture; call in a fresh process."""
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    from PySide6.QtWidgets import QApplication

    application = QApplication.instance() or QApplication([])
    from bobdesk.plan.image import PlanImage
    from bobdesk.progress import finish
    from bobdesk.project import edits
    from bobdesk.project.project import Picture, Project
    from bobdesk.ui.desk import Desk
    from bobdesk.ui.notices import Notices
    from bobdesk.ui.plan_picture import PlanPicture, with_levels_steps
    from bobdesk.ui.plan_view.view import PlanView
    from bobdesk.ui.quantities import Quantities
    from bobdesk.ui.runner import Runner
    from bobdesk.ui.selection import Selection
    from bobdesk.ui.session import Session
    from bobdesk.ui.settings import Settings
    from bobdesk.ui.warm_up import warm_up_plots, warm_up_steps

    finish(warm_up_steps())
    warm_up_plots()
    with tempfile.TemporaryDirectory() as folder:
        session, runner, settings = Session(), Runner(), Settings(Path(folder) / "settings.ini")
        shown = PlanPicture(session, runner)
        desk = Desk(session, Selection(), shown, runner, Notices(), settings, Quantities(settings))
        view = PlanView(desk)
        view.resize(1600, 1000)
        view.show()
        picture = Picture(b"", "made.png", size_px=(WIDTH, HEIGHT))
        began = time.perf_counter()
        image = PlanImage(made_pixels(kind), None, 1, "PNG", (), None)
        drawn = time.perf_counter()
        shown.keep(picture, finish(with_levels_steps(image)))
        levels = time.perf_counter() - drawn
        session.open(Project(picture=picture), None)
        if vertices:
            angle = np.linspace(0, 12 * np.pi, vertices)
            radius = np.linspace(500, 4000, vertices)
            line = np.column_stack([6000 + 1.3 * radius * np.cos(angle), 4200 + radius * np.sin(angle)])
            session.apply("Draw", lambda before: edits.draw_line(before, line))
        row: Row = {"picture": kind, "vertices": vertices, "copies s": levels, "made s": drawn - began}
        gestures = {"zoom": _zoom, "pan": _pan, "drag": _drag}
        for name, gesture in gestures.items():
            if name == "drag" and not vertices:
                continue
            view.fit_all()
            for _ in range(3):
                application.processEvents()  # what came before the gesture is not one of its frames
            times = []
            for step in gesture(view):
                start = time.process_time()
                step()
                application.processEvents()
                times.append(1e3 * (time.process_time() - start))
            row[f"{name} ms"], row[f"{name} worst"] = float(np.mean(times)), float(np.max(times))
        view.close()
        runner.close()
    return row


def _zoom(view: PlanView) -> Iterator[Callable[[], None]]:
    """In to the picture's own pixels and beyond, and out again."""
    for index in range(_FRAMES):
        factor = 1.15 if index < _FRAMES // 2 else 1 / 1.15
        yield lambda factor=factor: view.zoom_by(factor)


def _pan(view: PlanView) -> Iterator[Callable[[], None]]:
    """Across the picture at half its size."""
    from PySide6.QtCore import QPointF

    view.zoom_by(0.5 / view.frame_now().scale)
    for index in range(_FRAMES):
        way = QPointF(-37 if index < _FRAMES // 2 else 37, -11)
        yield lambda way=way: view.navigation.pan(way)


def _drag(view: PlanView) -> Iterator[Callable[[], None]]:
    """One vertex, with the whole plan in view; the mouse moves a few pixels a frame."""
    from PySide6.QtCore import QEvent, QPointF, Qt
    from PySide6.QtGui import QMouseEvent
    from PySide6.QtWidgets import QApplication

    trace = view.desk.session.project.trace
    assert trace is not None
    x, y = trace.points[len(trace.points) // 3]
    start = view.frame_now().point((float(x), float(y)))
    port, left, none = view.viewport(), Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier

    def send(kind: QEvent.Type, at: QPointF) -> None:
        QApplication.sendEvent(port, QMouseEvent(kind, at, port.mapToGlobal(at), left, left, none))

    send(QEvent.Type.MouseButtonPress, start)
    for index in range(_FRAMES):
        at = start + QPointF(3 * index, 2 * index)
        yield lambda at=at: send(QEvent.Type.MouseMove, at)
    yield lambda: send(QEvent.Type.MouseButtonRelease, start + QPointF(3 * _FRAMES, 2 * _FRAMES))


def rows() -> list[Row]:
    """One row for each of KINDS, each in a process of its own."""
    return [apart(frames, *kind) for kind in KINDS]


if __name__ == "__main__":
    print_table("Frames of a 12000 × 8400 picture, ms of processor", rows())

"""Boundaries of a line with 100,000 stations and 300 segments, dragged while plan, strips and table follow."""

from __future__ import annotations

import dataclasses
import os
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from tests.alignment.made_lines import curve, drive
from tests.benchmarks.measure import Row, apart

if TYPE_CHECKING:
    from PySide6.QtWidgets import QApplication

_CURVES = 150
_SPACING = 0.1
_MOVES = 30
_PRESSES = 6


def rows() -> list[Row]:
    """Return a row for each part that follows the drag."""
    return [apart(_drag, shown) for shown in ("strips", "strips, plan and table")]


def _line() -> np.ndarray:
    rng = np.random.default_rng(1)
    pieces = [(40.0, 0.0, 0.0)]
    for number in range(_CURVES):
        length, radius = rng.uniform(25, 40), rng.uniform(18, 45)
        pieces += curve(length=length, radius=radius, ramp=6.0, left=number % 2 == 0)
        pieces.append((rng.uniform(20, 42), 0.0, 0.0))
    return drive(pieces, step=2.0)


def _frame(application: QApplication, act: Callable[[], object]) -> float:
    """Return the milliseconds of processor of doing something and of drawing what it changed."""
    start = time.process_time()
    act()
    application.processEvents()
    return 1000 * (time.process_time() - start)


def _drag(shown: str) -> Row:
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    from PySide6.QtCore import QObject
    from PySide6.QtWidgets import QApplication

    from bobdesk.alignment.segmentation import detect_segments
    from bobdesk.plan.polyline import Polyline
    from bobdesk.project import edits
    from bobdesk.project.project import Project, SourceLine
    from bobdesk.ui.desk import Desk
    from bobdesk.ui.notices import Notices
    from bobdesk.ui.plan_picture import PlanPicture
    from bobdesk.ui.plan_view.view import PlanView
    from bobdesk.ui.quantities import Quantities
    from bobdesk.ui.runner import Runner
    from bobdesk.ui.segments.alignment_now import alignment_now
    from bobdesk.ui.segments.segments_table import SegmentsTable
    from bobdesk.ui.selection import Selection
    from bobdesk.ui.session import Session
    from bobdesk.ui.settings import Settings
    from bobdesk.ui.strips.strip_stack import StripStack

    application = QApplication([])
    owner = QObject()
    session, runner = Session(owner), Runner(owner)
    settings = Settings(Path(tempfile.mkdtemp()) / "settings.ini", owner)
    desk = Desk(
        session=session,
        selection=Selection(owner),
        picture=PlanPicture(session, runner, owner),
        runner=runner,
        notices=Notices(owner),
        settings=settings,
        quantities=Quantities(settings, owner),
    )
    now, strips = alignment_now(desk), StripStack(desk)
    view, table = PlanView(desk), SegmentsTable(desk)
    for widget, size in ((strips, (940, 300)), (view, (940, 480)), (table, (430, 500))):
        widget.resize(*size)
        if widget is strips or shown != "strips":
            widget.show()
    line = SourceLine("made.csv", Polyline(_line()))
    session.open(edits.set_spacing(edits.open_coordinates(Project(), line), _SPACING), None)
    while runner.jobs:
        application.processEvents()
    view.show_step("Segments")
    view.fit_all()
    application.processEvents()
    assert now.value is not None
    boundary = len(now.segments) // 2
    end = now.segments[boundary].end
    presses, firsts, frames = [], [], []
    for press in range(_PRESSES):
        presses.append(_frame(application, lambda: strips.drag.hold(boundary)))
        for move in range(_MOVES):
            station = end + 0.5 + 0.3 * (move % 20)
            frame = _frame(application, partial(strips.drag.drag, station, snap=0.0))
            (frames if move else firsts).append(frame)
        strips.drag.cancel()
        # Elsewhere, so that the next press and the first frame after it find nothing drawn.
        desk.selection.segments = (press,)
        application.processEvents()
    start, wall = time.process_time(), time.perf_counter()
    detect_segments(now.value.line, dataclasses.replace(session.project.segmentation, threshold=0.0051))
    again, wall = time.process_time() - start, time.perf_counter() - wall
    row: Row = {
        "shown": shown,
        "stations": len(now.value.line.stations),
        "segments": len(now.segments),
        "median ms": round(float(np.median(frames)), 1),
        "95 % ms": round(float(np.percentile(frames, 95)), 1),
        "press ms": round(float(np.median(presses)), 1),
        "first ms": round(float(np.median(firsts)), 1),
        "first, worst": round(max(firsts), 1),
        "detect again, s of processor": round(again, 2),
        "and by the clock": round(wall, 2),
    }
    runner.close()
    return row

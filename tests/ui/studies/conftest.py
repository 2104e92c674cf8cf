"""A project that is quick to solve, and windows whose questions the test answers."""

from __future__ import annotations

import csv
import time
from collections.abc import Callable, Generator
from pathlib import Path
from threading import Event

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from bobdesk.files.study_journal import Row
from bobdesk.files.study_run import StudyProgress
from bobdesk.plan.polyline import Polyline
from bobdesk.progress import Progress
from bobdesk.project import edits
from bobdesk.project.project import Project, SourceLine
from bobdesk.ui.desk import Desk
from bobdesk.ui.studies import study_window
from bobdesk.ui.studies.study_job import StudyOrder, study_steps
from tests.alignment.made_lines import made_plan
from tests.ui.answers import Answers


@pytest.fixture
def plan() -> np.ndarray:
    """A made plan, some hundred metres long."""
    return made_plan(3, curves=4)


@pytest.fixture
def plan_file(plan: np.ndarray, tmp_path: Path) -> Path:
    """The same in a file."""
    path = tmp_path / "made.csv"
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("x_m", "y_m"))
        writer.writerows(plan.tolist())
    return path


@pytest.fixture
def opened(desk: Desk, plan: np.ndarray) -> Project:
    """A project with that plan and targets, opened."""
    length = float(np.hypot(*np.diff(plan, axis=0).T).sum())
    project = edits.open_coordinates(Project(name="made"), SourceLine("made.csv", Polyline(plan)))
    project = edits.set_length(project, round(1.0045 * length, 2))
    project = edits.set_drop(project, round(0.08 * length, 2))
    desk.session.open(project, None)
    return desk.session.project


@pytest.fixture
def answering(desk: Desk, window):
    """Return a function that has a window ask the test instead of the user."""

    def answer(beside) -> Answers:
        beside.questions = Answers(desk.settings, beside)
        return beside.questions

    return answer


@pytest.fixture
def until(qtbot: QtBot) -> Callable[[Callable[[], bool]], None]:
    """As everywhere, with the time that processes need to begin on a computer that has much to do."""
    return lambda true: qtbot.waitUntil(true, timeout=60_000)


@pytest.fixture
def held_at(monkeypatch: pytest.MonkeyPatch) -> Callable[[int], Event]:
    """Return a function that has studies wait at a number of rows until the event is set, however fast they are."""

    def hold(count: int) -> Event:
        going_on = Event()

        def held(order: StudyOrder) -> Generator[Progress, None, tuple[Row, ...]]:
            steps, seen = study_steps(order), 0
            while True:
                try:
                    step = next(steps)
                except StopIteration as end:
                    return end.value
                yield step
                seen += len(step.rows) if isinstance(step, StudyProgress) else 0
                while seen >= count and not going_on.is_set():
                    time.sleep(0.01)
                    yield Progress(0.5, "held")

        monkeypatch.setattr(study_window, "study_steps", held)
        return going_on

    return hold

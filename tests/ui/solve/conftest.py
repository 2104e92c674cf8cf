"""A document that can be solved, and what the window tells."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from bobdesk.project import edits
from bobdesk.project.project import Project
from bobdesk.solve.settings import SolverSettings
from bobdesk.ui.desk import Desk
from bobdesk.ui.panels.solve_panel import SolvePanel
from bobdesk.ui.solving import Solving, solving_of
from tests.project.made_projects import ready_project


@pytest.fixture
def told(desk: Desk) -> list[str]:
    """All sentences told so far."""
    sentences: list[str] = []
    desk.notices.told.connect(lambda notice: sentences.append(notice.sentence))
    desk.session.refused.connect(sentences.append)
    return sentences


@pytest.fixture
def opened(desk: Desk) -> Project:
    """A project with everything but a run, opened."""
    desk.session.open(ready_project(), None)
    return desk.session.project


@pytest.fixture
def endless(opened: Project, desk: Desk) -> Project:
    """The same, with a method that takes its time: as published, in tiny steps and to a tiny end."""
    slow = SolverSettings(method="published", rate=1e-12, threshold=1e-300)
    desk.session.apply("Slow", lambda project: edits.set_solver(project, slow))
    return desk.session.project


@pytest.fixture
def solving(desk: Desk) -> Solving:
    """The window's solver."""
    return solving_of(desk)


@pytest.fixture
def idle(desk: Desk, until: Callable[[Callable[[], bool]], None]) -> Callable[[], None]:
    """Return a function that waits for all background work."""
    return lambda: until(lambda: not desk.runner.jobs)


@pytest.fixture
def panel(desk: Desk, opened: Project, shown: Callable[..., SolvePanel], idle: Callable[[], None]) -> SolvePanel:
    """The panel of the step Solve with that project, shown."""
    made = shown(SolvePanel(desk), 430, 1200)
    idle()
    return made

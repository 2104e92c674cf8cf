"""A document with everything that the first three panels show, and what they say of what cannot be used."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from PySide6.QtCore import QLocale

from bobdesk.plan.control_points import ControlPoint, KnownDistance
from bobdesk.project import edits
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from tests.project.made_projects import ready_project


@pytest.fixture
def told(desk: Desk) -> list[str]:
    """All sentences told so far."""
    sentences: list[str] = []
    desk.notices.told.connect(lambda notice: sentences.append(notice.sentence))
    desk.session.refused.connect(sentences.append)
    return sentences


@pytest.fixture
def german(english: None) -> Iterator[None]:
    """Numbers as in Germany."""
    before = QLocale()
    QLocale.setDefault(QLocale(QLocale.Language.German, QLocale.Country.Germany))
    yield
    QLocale.setDefault(before)


@pytest.fixture
def project() -> Project:
    """A picture with four control points, one of them wrong, distances and a traced line."""
    project = ready_project()
    project = edits.set_control_points(
        project,
        (
            ControlPoint(126.4, 265.0, 0.0, 0.0, "1"),
            ControlPoint(932.1, 377.6, 173.2, -24.1, "2"),
            ControlPoint(847.0, 1624.2, 155.0, -292.3, "3"),
            ControlPoint(169.9, 1510.4, 9.1, -271.0, "4"),
        ),
    )
    # 400 px that agree with the points.
    return edits.change_known_distance(project, 0, KnownDistance((10.0, 20.0), (10.0, 420.0), 86.5, "bar"))


@pytest.fixture
def opened(desk: Desk, project: Project) -> Project:
    """The project, opened."""
    desk.session.open(project, None)
    return project


@pytest.fixture
def idle(desk: Desk, until: Callable[[Callable[[], bool]], None]) -> Callable[[], None]:
    """Return a function that waits for all background work."""
    return lambda: until(lambda: not desk.runner.jobs)

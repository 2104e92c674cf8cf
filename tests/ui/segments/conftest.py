"""A made track with straights and curves that are known, opened on a desk."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from bobdesk.plan.polyline import Polyline
from bobdesk.project import edits
from bobdesk.project.project import Project, SourceLine
from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.alignment_now import AlignmentNow, alignment_now
from tests.alignment.made_lines import made_plan


@pytest.fixture
def told(desk: Desk) -> list[str]:
    """All sentences told so far."""
    sentences: list[str] = []
    desk.notices.told.connect(lambda notice: sentences.append(notice.sentence))
    desk.session.refused.connect(sentences.append)
    return sentences


@pytest.fixture
def idle(desk: Desk, until: Callable[[Callable[[], bool]], None]) -> Callable[[], None]:
    """Return a function that waits for all background work."""
    return lambda: until(lambda: not desk.runner.jobs)


@pytest.fixture
def track() -> Project:
    """Eight curves between straights."""
    return edits.open_coordinates(Project(), SourceLine("made.csv", Polyline(made_plan(5))))


@pytest.fixture
def now(desk: Desk, track: Project, idle: Callable[[], None]) -> AlignmentNow:
    """The made track's segments, found."""
    desk.session.open(track, None)
    found = alignment_now(desk)
    idle()
    assert len(found.segments) == 17
    return found

"""A plan view with a picture, and a hand over it."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from bobdesk.progress import finish
from bobdesk.project.project import Picture, Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.notices import Notice
from bobdesk.ui.plan_picture import DecodedPicture, decoded_picture_steps
from bobdesk.ui.plan_view.view import PlanView
from tests.ui.plan_view.made_view import Hand, picture


@pytest.fixture(scope="session")
def decoded() -> tuple[Picture, DecodedPicture]:
    """The picture, read once for all tests."""
    one = picture()
    return one, finish(decoded_picture_steps(one))


@pytest.fixture
def view(shown: Callable[..., PlanView], desk: Desk, decoded: tuple[Picture, DecodedPicture]) -> Iterator[PlanView]:
    """A view of 800 by 800 that shows a drawn circle of 400 by 400 pixels."""
    made = shown(PlanView(desk), 800, 800)
    desk.picture.keep(*decoded)
    desk.session.open(Project(picture=decoded[0]), None)
    assert desk.picture.decoded is not None
    made.setFocus()
    yield made
    desk.runner.close()
    made.close()


@pytest.fixture
def hand(view: PlanView) -> Hand:
    """A hand over the view."""
    return Hand(view)


@pytest.fixture
def told(desk: Desk) -> list[Notice]:
    """The notices, as they come."""
    found: list[Notice] = []
    desk.notices.told.connect(found.append)
    return found

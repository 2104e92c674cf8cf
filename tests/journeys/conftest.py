"""A screen for all journeys of a run."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from tests.journeys.real_window import RealWindow, Screen, missing


@pytest.fixture(scope="session")
def screen() -> Iterator[Screen]:
    """A screen of its own with a window manager; without the programs for it a journey is skipped, and says why."""
    lacking = missing()
    if lacking:
        pytest.skip(f"no real window without {', '.join(lacking)}; make setup installs them where it may")
    made = Screen()
    yield made
    made.close()


@pytest.fixture
def opened(screen: Screen) -> Iterator[Callable[..., RealWindow]]:
    """Return what starts the program; what a failed journey leaves running is ended."""
    programs: list[RealWindow] = []

    def start(*arguments: object, **named: object) -> RealWindow:
        programs.append(RealWindow(screen, *arguments, **named))
        return programs[-1]

    yield start
    for program in programs:
        program.kill()

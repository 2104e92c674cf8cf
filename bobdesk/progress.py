"""A long job is a generator that reports how far it is; somebody else owns the loop."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import TypeVar

Step = TypeVar("Step")
Result = TypeVar("Result")


@dataclass(frozen=True)
class Progress:
    """How far a long job is: `fraction` from 0 to 1 and what it is `doing`, for a person."""

    fraction: float
    doing: str


def finish(job: Generator[Step, None, Result], report: Callable[[Step], None] | None = None) -> Result:
    """Pull `job` to its end and return its result; `report` is called with each thing it yields."""
    while True:
        try:
            step = next(job)
        except StopIteration as end:
            result: Result = end.value
            return result
        if report is not None:
            report(step)

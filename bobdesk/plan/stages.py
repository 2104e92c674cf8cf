"""Parts of a long job: inner generators yield fractions, the outer one says what they mean."""

from __future__ import annotations

from collections.abc import Generator
from typing import TypeVar

from bobdesk.progress import Progress

Value = TypeVar("Value")


def at_fraction(job: Generator[float, None, Value], fraction: float) -> Generator[float, None, Value]:
    """Run a short part of a job: wherever it pauses, the whole job stands at `fraction`."""
    while True:
        try:
            next(job)
        except StopIteration as end:
            value: Value = end.value
            return value
        yield fraction


def stage(
    job: Generator[float, None, Value], doing: str, *, start: float, end: float
) -> Generator[Progress, None, Value]:
    """Report a part of the work that runs from `start` to `end` of the whole."""
    while True:
        try:
            fraction = next(job)
        except StopIteration as finished:
            value: Value = finished.value
            return value
        yield Progress(start + (end - start) * fraction, doing)


def at_once(job: Generator[float, None, Value]) -> Value:
    """Run a job that is known to be short to its end."""
    while True:
        try:
            next(job)
        except StopIteration as end:
            value: Value = end.value
            return value

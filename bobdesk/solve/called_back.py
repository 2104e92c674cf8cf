"""Methods that call back with their iterates, as generators that yield these while the method works."""

from __future__ import annotations

import threading
from collections.abc import Callable, Generator
from queue import SimpleQueue
from typing import Any, Generic, TypeVar

IterateT = TypeVar("IterateT")
ResultT = TypeVar("ResultT")


class StoppedWithinError(Exception):
    """A method was stopped between two iterates."""


class Calls(Generic[IterateT]):
    """What a method that works calls: `give` with each iterate, `check` as often as it can.

    Parameters
    ----------
    asked
        Asked at each `check`, on the method's thread: whether to end. It may take its time: the method rests.
    """

    def __init__(self, asked: Callable[[], bool]) -> None:
        self._asked = asked
        self.out: SimpleQueue[tuple[str, Any]] = SimpleQueue()
        self._taken = threading.Semaphore(0)
        self._is_closed = False

    def give(self, iterate: IterateT) -> None:
        """Hand an iterate over, and rest until the next one is wanted."""
        self.out.put(("iterate", iterate))
        self._taken.acquire()
        self.check()

    def check(self) -> None:
        """Return if the method shall go on.

        Raises
        ------
        StoppedWithinError
            If it shall not.
        """
        if self._is_closed or self._asked():
            raise StoppedWithinError("stopped between two iterates")

    def go_on(self) -> None:
        """Let the method find its next iterate."""
        self._taken.release()

    def close(self) -> None:
        """Have the method end at its next call."""
        self._is_closed = True
        self._taken.release()


def called_back(
    work: Callable[[Calls[IterateT]], ResultT], asked: Callable[[], bool]
) -> Generator[IterateT, None, ResultT]:
    """Run a method that calls back on a thread of its own; yield its iterates and return its result.

    The thread rests while nobody wants the next iterate, and has ended when the generator has.

    Parameters
    ----------
    work
        The method; it calls `Calls.give` with each iterate, and `Calls.check` at least at each evaluation.
    asked
        See `Calls`.

    Raises
    ------
    StoppedWithinError
        If `asked` said so; other errors as `work` raises them.
    """
    calls: Calls[IterateT] = Calls(asked)

    def run() -> None:
        try:
            calls.out.put(("result", work(calls)))
        except BaseException as error:  # noqa: BLE001 - raised again where the generator is pulled
            calls.out.put(("error", error))

    thread = threading.Thread(target=run, name="a method at work", daemon=True)
    thread.start()
    try:
        while True:
            kind, value = calls.out.get()
            if kind == "error":
                raise value
            if kind == "result":
                return value  # type: ignore[no-any-return]
            yield value
            calls.go_on()
    finally:
        calls.close()
        thread.join()

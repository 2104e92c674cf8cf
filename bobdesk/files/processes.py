"""Work on several processes: items handed out as others come back, processes that never outlive who needs them."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Generator, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from itertools import islice
from multiprocessing.connection import Connection
from multiprocessing.connection import wait as wait_for
from typing import TypeVar

from bobdesk.errors import InputError

Item = TypeVar("Item")
Result = TypeVar("Result")
# More than a cluster has workers, and few enough to be looked through each time that one is done.
_USUALLY_AHEAD = 500
_LOOK_EVERY_S = 0.1
_MOST_ON_WINDOWS = 61  # it can wait for no more processes at once


def completed(
    function: Callable[[Item], Result],
    items: Mapping[int, Item],
    executor: Executor,
    *,
    ahead: int = _USUALLY_AHEAD,
) -> Generator[tuple[int, Future[Result]] | None, None, None]:
    """Have `function` called with each item by the executor; yields number and future as they are done.

    Yields None ten times a second while none is, so that whoever pulls can turn to other things. Between two pulls
    no more items are handed out than `ahead`. Closing the generator cancels those that have not begun.

    Raises
    ------
    InputError
        If the workers are lost.
    """
    waiting = iter(items.items())
    pending: dict[Future[Result], int] = {}
    try:
        while True:
            for number, item in islice(waiting, ahead - len(pending)):
                pending[executor.submit(function, item)] = number
            if not pending:
                return
            done, _ = wait(pending, timeout=_LOOK_EVERY_S, return_when=FIRST_COMPLETED)
            if not done:
                yield None
            for future in done:
                yield pending.pop(future), future
    except BrokenProcessPool as error:
        raise workers_lost() from error
    finally:
        for future in pending:
            future.cancel()


def workers_lost() -> InputError:
    """Return what is said when processes end that nobody has asked to."""
    return InputError("the workers ended without being asked to; is there enough memory?")


@contextmanager
def process_executor(workers: int) -> Iterator[Executor]:
    """Start so many processes, one thread each.

    Leaving in the usual way lets them end. Leaving in any other way, by an error or by being closed, ends them at once
    in the middle of what they do, and so does the end of this process, however it comes.
    """
    # The matrices are small: threads inside a process would only take each other's cores.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # A forked child would share threads' locks with the window.
    context = multiprocessing.get_context("spawn")
    heard, held = context.Pipe(duplex=False)
    if sys.platform == "win32":
        workers = min(workers, _MOST_ON_WINDOWS)
    executor = ProcessPoolExecutor(workers, mp_context=context, initializer=_end_with, initargs=(heard,))
    try:
        yield executor
    except BaseException:
        held.close()
        raise
    finally:
        executor.shutdown(wait=True, cancel_futures=True)
        held.close()
        heard.close()


def _end_with(heard: Connection) -> None:
    """Prepare a worker: it ends once nobody holds the other end of the pipe, or its parent has gone."""
    # Ctrl+C in a terminal reaches all of a command's processes; the first one sees to the others.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    ends: list[Connection | int] = [heard]
    if parent is not None:
        ends.append(parent.sentinel)

    def watch() -> None:
        wait_for(ends)
        os._exit(1)

    threading.Thread(target=watch, name="end with the parent", daemon=True).start()

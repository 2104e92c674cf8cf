"""Work on processes: handed out as it comes back, ended with whoever needs it."""

import os
import time
from concurrent.futures import ThreadPoolExecutor

import psutil
import pytest

from bobdesk.errors import InputError
from bobdesk.files.processes import completed, process_executor

_ENDED_WITHIN_S = 20


def sleep_and_tell(seconds: float) -> int:
    time.sleep(seconds)
    return os.getpid()


def end(_item: object) -> None:
    os._exit(3)


def children() -> set[int]:
    return {child.pid for child in psutil.Process().children(recursive=True) if "spawn_main" in str(child.cmdline())}


def test_every_item_comes_back_with_its_number():
    with process_executor(2) as executor:
        found = {done[0]: done[1].result() for done in completed(abs, {3: -3, 7: -7, 9: 0}, executor) if done}
    assert found == {3: 3, 7: 7, 9: 0}
    assert not children()


def test_no_more_is_handed_out_than_asked_for():
    handed = []
    with ThreadPoolExecutor(1) as executor:
        job = completed(handed.append, dict.fromkeys(range(10)), executor, ahead=2)
        next(job)
        assert len(handed) <= 3
        job.close()
    assert len(handed) <= 3


def test_while_nothing_is_done_the_caller_can_turn_to_other_things():
    with ThreadPoolExecutor(1) as executor:
        steps = list(completed(time.sleep, {0: 0.5}, executor))
    assert steps.count(None) >= 2
    assert steps[-1][0] == 0


def test_closed_in_the_middle_the_workers_end_at_once():
    def work():
        with process_executor(2) as executor:
            yield from completed(sleep_and_tell, {0: 0, 1: 3600, 2: 3600}, executor)

    job = work()
    while next(job) is None:
        pass
    assert children()
    began = time.monotonic()
    job.close()
    assert time.monotonic() - began < _ENDED_WITHIN_S
    assert not children()


def test_a_worker_that_is_lost_is_one_sentence():
    with process_executor(1) as executor:
        job = completed(end, dict.fromkeys(range(5)), executor, ahead=1)
        with pytest.raises(InputError, match="ended without being asked to"):
            list(job)
    assert not children()

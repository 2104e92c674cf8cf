import threading

import pytest

from bobdesk.progress import finish
from bobdesk.solve.called_back import StoppedWithinError, called_back


def never():
    return False


def test_iterates_come_while_the_method_works_and_its_result_at_the_end():
    given = []

    def work(calls):
        for number in range(5):
            given.append(number)
            calls.give(number)
        return "result"

    seen = []

    def look(number):
        seen.append(number)
        assert given == seen, "the method rests until the next iterate is wanted"

    assert finish(called_back(work, never), look) == "result"
    assert seen == [0, 1, 2, 3, 4]


def test_a_closed_generator_ends_the_method_and_its_thread():
    ended = threading.Event()

    def work(calls):
        try:
            while True:
                calls.give(1)
        finally:
            ended.set()

    job = called_back(work, never)
    next(job)
    job.close()
    assert ended.is_set()
    assert not [thread for thread in threading.enumerate() if thread.name == "a method at work"]


def test_what_is_asked_within_ends_the_method():
    checks = []

    def work(calls):
        while True:
            checks.append(1)
            calls.check()

    with pytest.raises(StoppedWithinError):
        finish(called_back(work, lambda: len(checks) >= 7))
    assert len(checks) == 7


def test_a_fault_of_the_method_is_raised_where_it_is_pulled():
    def work(calls):
        calls.give(1)
        raise ZeroDivisionError("within")

    job = called_back(work, never)
    assert next(job) == 1
    with pytest.raises(ZeroDivisionError, match="within"):
        next(job)

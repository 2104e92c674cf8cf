import threading
import time

import pytest
from PySide6.QtCore import QEventLoop, QTimer
from PySide6.QtTest import QTest

from bobdesk.errors import InputError
from bobdesk.progress import Progress
from bobdesk.ui.runner import Runner


@pytest.fixture
def runner(qapp):
    made = Runner()
    yield made
    made.close()


def counted(to, *, pause=0.0):
    for number in range(to):
        if pause:
            time.sleep(pause)
        yield Progress(number / to, "Counting")
    return to


def test_result_arrives_on_the_threads_own_window(runner, until):
    found, threads = [], []

    def done(value):
        found.append(value)
        threads.append(threading.current_thread())

    runner.start("Counting", lambda: counted(100), done=done)
    until(lambda: found == [100])
    assert threads == [threading.main_thread()]
    assert runner.jobs == ()


def test_generator_runs_on_another_thread(runner, until):
    threads, found = [], []

    def job():
        threads.append(threading.current_thread())
        yield Progress(0, "")
        return True

    runner.start("Looking", job, done=found.append)
    until(lambda: bool(found))
    assert threads[0] is not threading.main_thread()


def test_refusal_is_a_sentence(runner, until):
    said, ended = [], []

    def job():
        yield Progress(0, "")
        raise InputError("the picture is damaged")

    runner.start("Reading", job, failed=said.append).ended.connect(lambda: ended.append(True))
    until(lambda: said == ["the picture is damaged"])
    assert ended == [True]


def test_stop_comes_within_a_step_and_closes_the_generator(runner, until):
    closed, stopped, found = [], [], []

    def job():
        try:
            while True:
                time.sleep(0.002)
                yield Progress(0, "For ever")
        finally:
            closed.append(True)

    running = runner.start("For ever", job, done=found.append, stopped=lambda: stopped.append(True))
    until(lambda: running.latest is not None or running.drained() != [])
    running.stop()
    until(lambda: stopped == [True])
    assert closed == [True]
    assert found == []


def test_pause_rests_and_resume_goes_on(runner, until):
    found = []
    running = runner.start("Counting", lambda: counted(40, pause=0.005), done=found.append)
    until(lambda: len(running.drained()) > 0)
    running.pause()
    time.sleep(0.05)
    running.drained()
    time.sleep(0.05)
    assert running.drained() == []
    assert running.is_paused
    running.resume()
    until(lambda: found == [40])


def test_every_step_can_be_fetched(runner, until):
    found, steps = [], []
    running = runner.start("Counting", lambda: counted(500), done=found.append)
    running.ended.connect(lambda: steps.extend(running.drained()))
    until(lambda: found == [500])
    assert [round(500 * step.fraction) for step in steps] == list(range(500))


def test_fault_is_raised_on_the_windows_thread(runner, qtbot):
    def job():
        yield Progress(0, "")
        raise ZeroDivisionError("a fault")

    with qtbot.captureExceptions() as faults:
        runner.start("Dividing", job)
        qtbot.waitUntil(lambda: bool(faults), timeout=5000)
    assert faults[0][0] is ZeroDivisionError
    assert runner.jobs == ()


def test_close_ends_the_threads(qapp):
    runner = Runner()
    job = runner.start("Counting", lambda: counted(10_000, pause=0.001))
    runner.close()
    assert job.wait(0)
    assert runner.jobs == ()


def test_fault_ends_like_a_stop_so_that_who_waits_can_go_on(runner, qtbot):
    def job():
        yield Progress(0, "")
        raise ZeroDivisionError("a fault")

    stopped = []
    with qtbot.captureExceptions():
        runner.start("Dividing", job, stopped=lambda: stopped.append(True))
        qtbot.waitUntil(lambda: stopped == [True], timeout=5000)


def test_a_question_asked_at_a_job_s_end_does_not_hold_the_others_up(runner, until):
    found = []

    def ask(_result):
        loop = QEventLoop()
        runner.start("Second", lambda: counted(3), done=lambda result: (found.append(result), loop.quit()))
        QTimer.singleShot(5000, loop, loop.quit)
        loop.exec()
        QTest.qWait(60)  # a job that has ended is deleted, but not while its end is being told
        found.append("answered")

    runner.start("First", lambda: counted(1), done=ask)
    until(lambda: found == [3, "answered"])
    until(lambda: runner.jobs == ())

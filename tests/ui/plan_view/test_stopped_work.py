"""What stops in mid-work leaves the tool ready for the next try."""

import threading

from bobdesk.progress import Progress
from bobdesk.project.project import Project


def gated(gate):
    """A job that waits at its first step."""

    def steps(*_arguments, **_named):
        yield Progress(0.0, "Waiting")
        assert gate.wait(10)
        yield Progress(0.5, "Going on")
        return None

    return steps


def test_end_of_a_trace_of_another_document_is_not_that_of_the_new_one(view, hand, decoded, monkeypatch, until):
    old, new = threading.Event(), threading.Event()
    tool = view.tool("auto_trace")
    monkeypatch.setattr("bobdesk.plan.trace.trace_line", gated(old))
    view.set_tool("auto_trace")
    hand.click((600, 400), (400, 600))
    (first,) = view.desk.runner.jobs
    view.desk.session.open(Project(picture=decoded[0]), None)
    assert not tool.is_busy
    monkeypatch.setattr("bobdesk.plan.trace.trace_line", gated(new))
    view.set_tool("auto_trace")
    hand.click((600, 400), (400, 600))
    assert tool.is_busy
    old.set()
    until(lambda: first not in view.desk.runner.jobs)
    assert tool.is_busy
    assert view.desk.session.project.trace is None
    assert tool.cancel()
    new.set()
    until(lambda: not tool.is_busy)


def test_live_wire_whose_preparing_was_stopped_prepares_again(view, monkeypatch, until):
    gate = threading.Event()
    with monkeypatch.context() as changed:
        changed.setattr("bobdesk.plan.livewire.prepare", gated(gate))
        view.set_tool("live_wire")
        view.desk.runner.stop_all()
        gate.set()
        until(lambda: view.desk.runner.jobs == ())
    assert view.sentence == "Preparing the picture …"
    view.set_tool("select")
    view.set_tool("live_wire")
    until(lambda: view.sentence == "Click the start of the drawn line.")

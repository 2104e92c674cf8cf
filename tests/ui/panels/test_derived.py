import threading
from dataclasses import replace

import pytest

from bobdesk.errors import InputError
from bobdesk.project import derive, edits
from bobdesk.ui.derived import DerivedLater, centreline_later
from bobdesk.ui.newest import Newest


def test_only_the_newest_question_is_answered(desk, idle):
    gate, asked, answers = threading.Event(), [], []
    newest = Newest(desk.runner, "Test", desk.session)
    newest.answered.connect(answers.append)

    def answer(value):
        def work():
            asked.append(value)
            gate.wait(5)
            return value

        return work

    for value in range(5):
        newest.ask(answer(value))
    gate.set()
    idle()
    assert answers == [4]
    assert asked[-1] == 4
    assert len(asked) <= 2


def test_a_refusal_is_told_and_the_next_question_answered(desk, idle):
    newest = Newest(desk.runner, "Test", desk.session)
    sentences, answers = [], []
    newest.failed.connect(sentences.append)
    newest.answered.connect(answers.append)

    def refuse():
        raise InputError("no line")

    newest.ask(refuse)
    idle()
    newest.ask(lambda: 1)
    idle()
    assert (sentences, answers) == (["no line"], [1])


def test_a_value_follows_only_what_it_needs(desk, project, idle):
    calls = []

    def trace_of(project):
        calls.append(project)
        return project.trace

    later = DerivedLater(desk, "Test", trace_of, lambda project: (project.trace,), desk.session)
    desk.session.open(project, None)
    idle()
    assert later.value is project.trace
    desk.session.apply("Name", lambda project: edits.name_project(project, "other"))
    idle()
    before = len(calls)
    desk.session.apply("Move", lambda project: edits.move_vertex(project, 3, 1.0, 2.0))
    assert not later.is_current
    assert later.value is project.trace
    idle()
    assert later.is_current
    assert later.value is desk.session.project.trace
    assert len(calls) == before + 1


def test_the_centreline_is_shared_and_right(desk, opened, idle):
    later = centreline_later(desk)
    assert centreline_later(desk) is later
    idle()
    assert later.value.value is derive.centreline(desk.session.project).value


def test_closing_forgets(desk, opened, idle):
    later = centreline_later(desk)
    idle()
    assert later.value is not None
    desk.session.close()
    idle()
    assert later.value is None
    assert later.is_current


@pytest.mark.parametrize("part", ["trace", "fit", "calibration"])
def test_what_the_centreline_needs(project, part):
    from bobdesk.ui.derived import line_inputs, same_inputs

    other = {"trace": None, "fit": replace(project.fit, spacing=2.0), "calibration": replace(project.calibration)}
    assert not same_inputs(line_inputs(project), line_inputs(replace(project, **{part: other[part]})))
    assert same_inputs(line_inputs(project), line_inputs(replace(project, name="x")))

"""The user does not wait: works on while a file is read, closes while one is written, opens another one meanwhile."""

import threading

import pytest

from bobdesk.errors import InputError
from bobdesk.files.project_file import load_project, save_project
from bobdesk.files.recovery import Recovery
from bobdesk.files.recovery_store import recoverable
from bobdesk.project import edits
from bobdesk.project.project import Project


def rename(desk, name):
    desk.session.apply("Name the project", lambda project: edits.name_project(project, name))


class Gate:
    """Stands before a function, and lets calls through when it is opened."""

    def __init__(self, function):
        self._function = function
        self.is_open = threading.Event()
        self.reached = threading.Event()

    def __call__(self, *arguments):
        self.reached.set()
        assert self.is_open.wait(10)
        return self._function(*arguments)


@pytest.fixture
def slow_save(monkeypatch):
    gate = Gate(save_project)
    monkeypatch.setattr("bobdesk.ui.documents.save_project", gate)
    yield gate
    gate.is_open.set()


@pytest.fixture
def slow_load(monkeypatch):
    gate = Gate(load_project)
    monkeypatch.setattr("bobdesk.ui.documents.load_project", gate)
    yield gate
    gate.is_open.set()


@pytest.fixture
def opened(documents, desk, tmp_path, until):
    path = tmp_path / "first.bobdesk"
    save_project(Project(name="first"), path)
    documents.open_project(path)
    until(lambda: desk.session.path == path)
    return path


@pytest.fixture
def second(tmp_path):
    path = tmp_path / "second.bobdesk"
    save_project(Project(name="second"), path)
    return path


def test_edits_made_while_another_project_is_read_are_asked_about(
    documents, desk, answers, opened, second, slow_load, until
):
    documents.open_project(second)
    rename(desk, "worked on")
    slow_load.is_open.set()
    until(lambda: answers.asked == ["save changes"])
    until(lambda: desk.runner.jobs == ())
    assert desk.session.project.name == "worked on"
    assert desk.session.path == opened
    answers.save_answer = "save"
    documents.open_project(second)
    until(lambda: desk.session.path == second)
    assert load_project(opened).name == "worked on"


def test_document_keeps_its_own_file_when_the_last_one_is_still_being_saved(
    documents, desk, answers, opened, second, slow_save, until
):
    rename(desk, "late")
    documents.save()
    answers.save_answer = "discard"
    documents.open_project(second)
    until(lambda: desk.session.path == second)
    slow_save.is_open.set()
    until(lambda: desk.runner.jobs == ())
    assert desk.session.path == second
    rename(desk, "second edited")
    documents.save()
    until(lambda: desk.session.is_saved)
    assert load_project(second).name == "second edited"
    assert load_project(opened).name == "late"


def test_leaving_while_a_save_is_under_way_waits_for_it_and_then_leaves(
    documents, desk, answers, opened, slow_save, until
):
    left = []
    rename(desk, "worked on")
    documents.save()
    answers.save_answer = "save"
    documents.guard(lambda: left.append(desk.session.is_saved))
    slow_save.is_open.set()
    until(lambda: left == [True])


def test_edits_made_while_saving_before_leaving_are_saved_too(documents, desk, answers, opened, slow_save, until):
    left = []
    rename(desk, "worked on")
    answers.save_answer = "save"
    documents.guard(lambda: left.append(True))
    assert slow_save.reached.wait(10)
    rename(desk, "worked on still")
    slow_save.is_open.set()
    until(lambda: left == [True])
    assert load_project(opened).name == "worked on still"


def test_save_under_another_name_is_not_lost_behind_a_save(
    documents, desk, answers, opened, tmp_path, slow_save, until
):
    rename(desk, "worked on")
    documents.save()
    answers.save_path = tmp_path / "third.bobdesk"
    documents.save_as()
    slow_save.is_open.set()
    until(lambda: desk.session.path == tmp_path / "third.bobdesk")
    assert load_project(tmp_path / "third.bobdesk").name == "worked on"


def test_saving_works_again_after_a_fault_in_it(documents, desk, opened, monkeypatch, until, qtbot, said):
    def broken(*_arguments):
        raise ZeroDivisionError

    rename(desk, "worked on")
    with monkeypatch.context() as changed:
        changed.setattr("bobdesk.ui.documents.save_project", broken)
        with qtbot.captureExceptions() as faults:
            documents.save()
            until(lambda: bool(faults))
    assert "not saved" in said[0]
    documents.save()
    until(lambda: desk.session.is_saved)


def test_failed_save_of_a_document_that_was_left_does_not_offer_to_save_this_one(
    documents, desk, answers, opened, second, monkeypatch, until
):
    def full(*_arguments):
        raise InputError("the disk is full")

    told = []
    desk.notices.told.connect(told.append)
    gate = Gate(full)
    monkeypatch.setattr("bobdesk.ui.documents.save_project", gate)
    rename(desk, "worked on")
    documents.save()
    answers.save_answer = "discard"
    documents.open_project(second)
    until(lambda: desk.session.path == second)
    gate.is_open.set()
    until(lambda: bool(told))
    assert told[0].remedies == ()


def test_recovery_copy_stays_while_no_new_one_could_be_written(documents, desk, tmp_path, monkeypatch, until):
    dead = Recovery(tmp_path / "data")
    dead.keep(Project(name="Lake Placid"), path=None, last_edit="Name the project")
    assert dead.wait(5)
    dead.close(forget=False)
    (item,) = recoverable(tmp_path / "data")
    monkeypatch.setattr(documents.keeper._recovery, "wait", lambda _timeout: False)
    documents.recover(item)
    until(lambda: desk.session.project.name == "Lake Placid")
    assert item.folder.exists()


def test_a_name_without_the_suffix_does_not_overwrite_the_file_with_it(documents, desk, answers, tmp_path, until):
    there = tmp_path / "Igls 1.2.bobdesk"
    save_project(Project(name="there"), there)
    rename(desk, "Igls")
    answers.save_path = tmp_path / "Igls 1.2"
    documents.save()
    until(lambda: desk.runner.jobs == ())
    assert answers.asked == ["where", "overwrite"]
    assert load_project(there).name == "there"
    answers.overwrite_answer = True
    documents.save()
    until(lambda: desk.session.is_saved)
    assert load_project(there).name == "Igls"

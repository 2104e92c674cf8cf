from dataclasses import replace
from pathlib import Path

import pytest

from bobdesk.errors import InputError
from bobdesk.project import edits
from bobdesk.project.project import Project
from bobdesk.ui.session import Session


@pytest.fixture
def session(qapp):
    return Session()


def named(name):
    return lambda project: edits.name_project(project, name)


def test_an_edit_is_one_step_and_told_once(session):
    told = []
    session.changed.connect(lambda before, after: told.append((before, after)))
    first = session.project
    assert session.apply("Name the project", named("Igls"))
    assert told == [(first, session.project)]
    assert session.undo_label == "Name the project"
    assert session.is_open
    assert not session.is_saved


def test_undo_gives_back_the_same_object_and_redo_too(session):
    first = session.project
    session.apply("Name", named("Igls"))
    second = session.project
    session.undo()
    assert session.project is first
    session.redo()
    assert session.project is second


def test_refused_edit_changes_nothing_and_says_why(session):
    said = []
    session.refused.connect(said.append)

    def refuse(project):
        raise InputError("that place does not lie on the line")

    before = session.project
    assert not session.apply("Set the start", refuse)
    assert said == ["that place does not lie on the line"]
    assert session.project is before
    assert session.undo_label is None


def test_edits_with_one_key_are_one_step(session):
    first = session.project
    for name in ("a", "b", "c"):
        session.apply("Type the name", named(name), key="name")
    assert session.project.name == "c"
    session.undo()
    assert session.project is first


def test_saved_mark_goes_with_the_value(session):
    session.apply("Name", named("a"))
    session.saved(session.project, Path("a.bobdesk"))
    assert session.is_saved
    session.apply("Name", named("b"))
    assert not session.is_saved
    session.undo()
    assert session.is_saved


def test_a_save_of_an_older_value_leaves_later_edits_unsaved(session):
    session.apply("Name", named("a"))
    written = session.project
    session.apply("Name", named("b"))
    session.saved(written, Path("a.bobdesk"))
    assert not session.is_saved


def test_recovered_project_counts_as_not_saved(session):
    session.open(replace(Project(), name="x"), Path("x.bobdesk"), recovered=True)
    assert not session.is_saved
    session.saved(session.project, Path("x.bobdesk"))
    assert session.is_saved

from __future__ import annotations

import gc
import tracemalloc

import pytest

from bobdesk.project import edits
from bobdesk.project.history import History
from bobdesk.project.project import Picture, Project
from tests.project.made_projects import bends


def test_undo_and_redo_give_back_the_same_objects() -> None:
    values = [Project(name=str(number)) for number in range(4)]
    history = History(values[0])
    for number, value in enumerate(values[1:], 1):
        history.push(f"edit {number}", value)
    assert history.undo_labels == ("edit 3", "edit 2", "edit 1")
    assert history.undo() is values[2]
    assert history.undo() is values[1]
    assert history.redo_labels == ("edit 2", "edit 3")
    assert history.redo() is values[2]
    assert history.undo() is values[1]
    assert history.undo() is values[0]
    assert history.undo() is values[0]
    assert not history.undo_labels
    assert [history.redo() for _ in range(4)] == [values[1], values[2], values[3], values[3]]


def test_an_edit_forgets_what_was_undone() -> None:
    history = History("a")
    history.push("to b", "b")
    history.undo()
    history.push("to c", "c")
    assert history.redo_labels == ()
    assert history.undo() == "a"
    assert history.redo() == "c"


def test_the_same_value_is_no_step() -> None:
    value = Project()
    history = History(value)
    history.push("nothing", value)
    assert history.undo_labels == ()


def test_steps_with_one_key_become_one_until_something_comes_between() -> None:
    history = History(0)
    for value in (1, 2, 3):
        history.push("Set length", value, key="length")
    assert history.undo_labels == ("Set length",)
    history.push("Set drop", 4, key="drop")
    history.push("Set length", 5, key="length")
    assert history.undo_labels == ("Set length", "Set drop", "Set length")
    assert [history.undo() for _ in range(3)] == [4, 3, 0]


def test_saving_and_undo_end_a_row_of_merged_steps() -> None:
    history = History(0)
    history.push("Set length", 1, key="length")
    history.mark_saved()
    history.push("Set length", 2, key="length")
    assert history.undo() == 1
    assert history.is_saved
    history.push("Set length", 3, key="length")
    assert history.undo() == 1


def test_the_saved_mark_follows_undo_and_is_lost_with_its_branch() -> None:
    history = History(object())
    assert history.is_saved
    history.push("a", object())
    assert not history.is_saved
    history.mark_saved()
    history.undo()
    assert not history.is_saved
    history.redo()
    assert history.is_saved
    history.undo()
    history.push("b", object())
    assert not history.is_saved
    history.undo()
    assert not history.is_saved


def test_old_steps_are_forgotten() -> None:
    history = History(0, limit=3)
    for value in range(1, 10):
        history.push(str(value), value)
    assert len(history.undo_labels) == 3
    assert [history.undo() for _ in range(4)] == [8, 7, 6, 6]
    assert len(History(0).undo_labels) == 0
    with pytest.raises(ValueError, match="one step"):
        History(0, limit=0)


def test_two_hundred_steps_of_a_long_trace_with_a_large_picture_cost_under_20_mb() -> None:
    picture = Picture(bytes(20_000_000), "plan.png")
    history = History(edits.draw_line(edits.open_picture(Project(), picture), bends(2000)))
    gc.collect()
    tracemalloc.start()
    try:
        for step in range(200):
            project = history.value
            x, y = bends(2000)[step * 7]
            history.push("Move vertex", edits.move_vertex(project, step * 7, x + 1.0, y))
        gc.collect()
        held, _ = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert len(history.undo_labels) == 200
    assert history.value.picture is picture
    assert held < 20e6

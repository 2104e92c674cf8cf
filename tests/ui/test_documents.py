import os
import time
from pathlib import Path

from bobdesk.files.instance_lock import take_project_lock
from bobdesk.files.project_file import load_project, save_project
from bobdesk.files.recovery_store import recoverable
from bobdesk.project import edits
from bobdesk.project.project import Project


def rename(desk, name):
    desk.session.apply("Name the project", lambda project: edits.name_project(project, name))


def test_save_asks_for_a_name_once_and_remembers_it(documents, desk, answers, tmp_path, until):
    rename(desk, "Igls")
    answers.save_path = tmp_path / "igls"
    documents.save()
    until(lambda: desk.session.is_saved)
    path = tmp_path / "igls.bobdesk"
    assert load_project(path).name == "Igls"
    assert desk.session.path == path
    assert desk.settings.recent == (path,)
    rename(desk, "Innsbruck-Igls")
    documents.save()
    until(lambda: desk.session.is_saved)
    assert load_project(path).name == "Innsbruck-Igls"
    assert answers.asked == ["where"]


def test_guard_lets_nothing_go_unasked(documents, desk, answers):
    done = []
    documents.guard(lambda: done.append("at once"))
    rename(desk, "Igls")
    documents.guard(lambda: done.append("cancelled"))
    answers.save_answer = "discard"
    documents.guard(lambda: done.append("discarded"))
    assert done == ["at once", "discarded"]
    assert answers.asked == ["save changes", "save changes"]


def test_guard_saves_first_and_goes_on_only_when_that_has_worked(documents, desk, answers, tmp_path, until, said):
    rename(desk, "Igls")
    done = []
    answers.save_answer = "save"
    answers.save_path = tmp_path / "missing" / "igls.bobdesk"
    documents.guard(lambda: done.append(True))
    until(lambda: bool(said))
    assert done == []
    assert not desk.session.is_saved
    assert "not saved" in said[0]
    answers.save_path = tmp_path / "igls.bobdesk"
    documents.guard(lambda: done.append(True))
    until(lambda: done == [True])


def test_failed_opening_keeps_the_open_project(documents, desk, tmp_path, until, said):
    rename(desk, "Igls")
    desk.session.saved(desk.session.project, tmp_path / "igls.bobdesk")
    before = desk.session.project
    bad = tmp_path / "bad.bobdesk"
    bad.write_bytes(b"PK nothing of the kind")
    documents.open_project(bad)
    until(lambda: bool(said))
    assert desk.session.project is before
    assert "bad.bobdesk" in said[0]


def test_file_changed_by_another_program_is_asked_about(documents, desk, answers, tmp_path, until):
    path = tmp_path / "a.bobdesk"
    save_project(Project(name="a"), path)
    documents.open_project(path)
    until(lambda: desk.session.path == path)
    save_project(Project(name="from elsewhere"), path)
    os.utime(path, (time.time() + 5, time.time() + 5))
    rename(desk, "mine")
    documents.save()
    assert answers.asked == ["changed on disk"]
    assert load_project(path).name == "from elsewhere"
    answers.changed_answer = "overwrite"
    documents.save()
    until(lambda: desk.session.is_saved)
    assert load_project(path).name == "mine"


def test_deleted_file_is_written_again(documents, desk, tmp_path, until):
    path = tmp_path / "a.bobdesk"
    save_project(Project(name="a"), path)
    documents.open_project(path)
    until(lambda: desk.session.path == path)
    path.unlink()
    rename(desk, "b")
    documents.save()
    until(lambda: desk.session.is_saved)
    assert load_project(path).name == "b"


def test_project_that_is_open_elsewhere_opens_as_a_copy_if_wanted(documents, desk, answers, tmp_path, until):
    path = tmp_path / "a.bobdesk"
    save_project(Project(name="a"), path)
    other = take_project_lock(tmp_path / "data", path)
    assert other is not None
    documents.open_project(path)
    assert answers.asked == ["open elsewhere"]
    assert not desk.session.is_open
    answers.copy_answer = True
    documents.open_project(path)
    until(lambda: desk.session.is_open)
    assert desk.session.path is None
    assert not desk.session.is_saved
    other.release()


def test_recovery_copy_follows_every_edit_and_goes_with_the_save(documents, desk, answers, tmp_path, until):
    rename(desk, "Igls")
    copies = tmp_path / "data" / "recovery"
    until(lambda: any(copies.glob("*/state.json")))
    answers.save_path = tmp_path / "igls.bobdesk"
    documents.save()
    until(lambda: desk.session.is_saved)
    until(lambda: not any(copies.glob("*/state.json")))


def test_what_a_dead_window_left_can_be_recovered(documents, desk, tmp_path, until):
    from bobdesk.files.recovery import Recovery

    dead = Recovery(tmp_path / "data")
    dead.keep(Project(name="Lake Placid"), path=None, last_edit="Name the project")
    assert dead.wait(5)
    dead.close(forget=False)
    (item,) = recoverable(tmp_path / "data")
    documents.recover(item)
    until(lambda: desk.session.project.name == "Lake Placid")
    assert not desk.session.is_saved
    assert recoverable(tmp_path / "data") == ()


def test_a_failing_disk_while_saving_says_so_and_loses_nothing(documents, desk, tmp_path, until, said, monkeypatch):
    path = tmp_path / "a.bobdesk"
    save_project(Project(name="a"), path)
    documents.open_project(path)
    until(lambda: desk.session.path == path)

    def full(*_args, **_kwargs):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    rename(desk, "b")
    documents.save()
    until(lambda: any("not saved" in sentence for sentence in said))
    monkeypatch.undo()
    assert load_project(Path(path)).name == "a"
    assert desk.session.project.name == "b"
    assert not desk.session.is_saved

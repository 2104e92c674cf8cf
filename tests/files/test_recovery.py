from __future__ import annotations

import hashlib
import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from bobdesk.errors import InputError
from bobdesk.files import recovery_store
from bobdesk.files.instance_lock import is_locked, take_project_lock
from bobdesk.files.recovery import Recovery, user_data_folder
from bobdesk.files.recovery_store import LOCK, forget, recover, recoverable, recovery_folder
from bobdesk.project import edits
from bobdesk.project.project import Picture, Project
from tests.project.made_projects import bends, full_project
from tests.project.same_project import print_of

SOON = 10.0


def dies(session: Recovery) -> None:
    """End a session as a crash does: its copy stays, its lock is gone."""
    session.close(forget=False)


@contextmanager
def crashed(data_folder: Path, project: Project, path: Path | None = None) -> Iterator[None]:
    session = Recovery(data_folder)
    session.keep(project, path=path, last_edit="Move vertex")
    assert session.wait(SOON)
    dies(session)
    yield


def test_what_a_crash_leaves_is_the_project_to_the_last_bit(tmp_path: Path) -> None:
    before = time.time()
    file = tmp_path / "tracks" / "Königssee.bobdesk"
    with crashed(tmp_path, full_project(), file):
        (item,) = recoverable(tmp_path)
    assert (item.name, item.path, item.last_edit) == ("Königssee", file, "Move vertex")
    assert before <= item.time <= time.time()
    assert print_of(recover(item)) == print_of(full_project())
    forget(item)
    assert recoverable(tmp_path) == ()


def test_an_untitled_project_is_kept_too(tmp_path: Path) -> None:
    with crashed(tmp_path, Project()):
        (item,) = recoverable(tmp_path)
    assert (item.name, item.path) == ("untitled", None)


def test_a_window_that_is_alive_has_nothing_to_recover(tmp_path: Path) -> None:
    session = Recovery(tmp_path)
    session.keep(Project(), path=None, last_edit="")
    assert session.wait(SOON)
    assert recoverable(tmp_path) == ()
    dies(session)
    assert len(recoverable(tmp_path)) == 1


def test_a_project_that_was_saved_and_closed_leaves_nothing(tmp_path: Path) -> None:
    session = Recovery(tmp_path)
    session.keep(full_project(), path=None, last_edit="")
    assert session.wait(SOON)
    session.close(forget=True)
    assert list(recovery_folder(tmp_path).iterdir()) == []
    # A session in which nothing was edited never made a folder.
    Recovery(tmp_path).close(forget=False)
    assert list(recovery_folder(tmp_path).iterdir()) == []


def test_a_saved_project_has_nothing_to_recover_until_the_next_edit(tmp_path: Path) -> None:
    session = Recovery(tmp_path)
    session.keep(full_project(), path=None, last_edit="1")
    session.saved()
    assert session.wait(SOON)
    assert not (session.folder / "state.json").exists()
    session.keep(Project(name="later"), path=None, last_edit="2")
    assert session.wait(SOON)
    dies(session)
    assert [item.name for item in recoverable(tmp_path)] == ["later"]


def test_a_copy_is_there_within_half_a_second_and_the_caller_never_waits(tmp_path: Path) -> None:
    picture = Picture(bytes(20_000_000), "plan.png")
    project = edits.draw_line(edits.open_picture(Project(), picture), bends(2000))
    session = Recovery(tmp_path)
    session.keep(project, path=None, last_edit="first")
    assert session.wait(SOON)
    longest = 0.0
    for number in range(50):
        project = edits.move_vertex(project, number, float(number), 5.0)
        began = time.perf_counter()
        session.keep(project, path=None, last_edit=str(number))
        longest = max(longest, time.perf_counter() - began)
    assert session.wait(0.5)
    assert longest < 0.05
    dies(session)
    (item,) = recoverable(tmp_path)
    assert item.last_edit == "49"
    assert print_of(recover(item)) == print_of(project)


def test_the_picture_is_written_once_and_old_ones_go(tmp_path: Path) -> None:
    session = Recovery(tmp_path)
    first = edits.open_picture(Project(), Picture(b"first" * 1000, "a.png"))
    session.keep(first, path=None, last_edit="1")
    assert session.wait(SOON)
    place = session.folder / hashlib.sha256(b"first" * 1000).hexdigest()
    written = place.stat().st_mtime_ns
    session.keep(edits.name_project(first, "new name"), path=None, last_edit="2")
    assert session.wait(SOON)
    assert place.stat().st_mtime_ns == written
    session.keep(edits.open_picture(first, Picture(b"second", "b.png")), path=None, last_edit="3")
    assert session.wait(SOON)
    assert not place.exists()
    dies(session)
    picture = recover(recoverable(tmp_path)[0]).picture
    assert picture is not None
    assert picture.data == b"second"


def test_the_last_ten_projects_are_kept(tmp_path: Path) -> None:
    for number in range(13):
        with crashed(tmp_path, edits.name_project(Project(), str(number))):
            pass
    session = Recovery(tmp_path)
    session.keep(Project(), path=None, last_edit="")
    assert session.wait(SOON)
    assert [item.name for item in recoverable(tmp_path)] == [str(number) for number in range(12, 2, -1)]
    dies(session)


def test_a_failing_disk_is_said_once_and_tried_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    said: list[str] = []
    trials = threading.Semaphore(0)
    write = recovery_store.write_atomic

    def full(path: Path, content: bytes) -> None:
        trials.release()
        raise InputError(f"{path}: cannot be written: no space left on device")

    monkeypatch.setattr(recovery_store, "write_atomic", full)
    session = Recovery(tmp_path, say=said.append, try_again_s=0.01)
    session.keep(full_project(), path=None, last_edit="1")
    for _ in range(3):
        assert trials.acquire(timeout=SOON)
    assert len(said) == 1
    assert said[0].startswith("No recovery copy could be written, and it is tried again: ")
    assert said[0].endswith("no space left on device")

    monkeypatch.setattr(recovery_store, "write_atomic", write)
    assert session.wait(SOON)
    monkeypatch.setattr(recovery_store, "write_atomic", full)
    session.keep(Project(), path=None, last_edit="2")
    for _ in range(3):
        assert trials.acquire(timeout=SOON)
    assert len(said) == 2
    # Closing does not wait for a disk that never comes back, and the copy before is whole.
    dies(session)
    assert print_of(recover(recoverable(tmp_path)[0])) == print_of(full_project())


def test_a_newer_edit_is_what_a_recovered_disk_gets(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write = recovery_store.write_atomic
    failed = threading.Event()

    def full(path: Path, content: bytes) -> None:
        failed.set()
        raise InputError("no space")

    monkeypatch.setattr(recovery_store, "write_atomic", full)
    session = Recovery(tmp_path, try_again_s=0.01)
    session.keep(edits.name_project(Project(), "old"), path=None, last_edit="1")
    assert failed.wait(SOON)
    session.keep(edits.name_project(Project(), "new"), path=None, last_edit="2")
    monkeypatch.setattr(recovery_store, "write_atomic", write)
    assert session.wait(SOON)
    dies(session)
    assert recover(recoverable(tmp_path)[0]).name == "new"


def test_a_folder_that_vanishes_is_made_again_with_its_picture(tmp_path: Path) -> None:
    session = Recovery(tmp_path)
    session.keep(full_project(), path=None, last_edit="1")
    assert session.wait(SOON)
    recovery_folder(tmp_path).rename(tmp_path / "gone")
    session.keep(edits.name_project(full_project(), "again"), path=None, last_edit="2")
    assert session.wait(SOON)
    assert is_locked(session.folder / LOCK)
    dies(session)
    (item,) = recoverable(tmp_path)
    assert recover(item).name == "again"


def test_a_data_folder_that_cannot_be_is_said(tmp_path: Path) -> None:
    (tmp_path / "data").write_text("a file where the folder should be")
    said: list[str] = []
    told = threading.Event()

    def say(sentence: str) -> None:
        said.append(sentence)
        told.set()

    session = Recovery(tmp_path / "data", say=say, try_again_s=0.01)
    session.keep(Project(), path=None, last_edit="")
    assert told.wait(SOON)
    dies(session)
    assert len(said) == 1
    assert recoverable(tmp_path / "data") == ()


@pytest.mark.parametrize("damage", ["cut", "nothing", "blob", "name", "deep"])
def test_a_damaged_copy_is_a_sentence_or_is_not_offered(damage: str, tmp_path: Path) -> None:
    with crashed(tmp_path, full_project()):
        (item,) = recoverable(tmp_path)
    state = item.folder / "state.json"
    if damage == "cut":
        state.write_bytes(state.read_bytes()[:-100])
    elif damage == "nothing":
        state.write_bytes(b"")
    elif damage == "deep":
        state.write_bytes(b'{"format":' + b"[" * 200_000)
    elif damage == "name":
        digest = next(place.name for place in item.folder.iterdir() if len(place.name) == 64)
        state.write_bytes(state.read_bytes().replace(digest.encode(), b"../../../../etc/passwd"))
    else:
        next(place for place in item.folder.iterdir() if len(place.name) == 64).write_bytes(b"other")
    if damage in ("cut", "nothing", "deep"):
        assert recoverable(tmp_path) == ()
    with pytest.raises(InputError, match="the recovery copy of Königssee cannot be"):
        recover(item)


def test_a_second_instance_is_told_and_a_dead_one_holds_nothing(tmp_path: Path) -> None:
    project = tmp_path / "track.bobdesk"
    script = (
        "import sys; from pathlib import Path; from bobdesk.files.instance_lock import take_project_lock\n"
        "lock = take_project_lock(Path(sys.argv[1]), Path(sys.argv[2]))\n"
        "print('told' if lock is None else 'holds', flush=True); sys.stdin.read()"
    )
    call = [sys.executable, "-c", script, str(tmp_path), str(tmp_path / "sub" / ".." / "track.bobdesk")]
    environment = dict(os.environ, PYTHONPATH=str(Path.cwd()))
    with subprocess.Popen(call, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment) as other:
        assert other.stdout is not None
        assert other.stdout.readline().strip() == b"holds"
        assert take_project_lock(tmp_path, project) is None
        other_project = take_project_lock(tmp_path, tmp_path / "other.bobdesk")
        assert other_project is not None
        other_project.release()
        other.kill()
    lock = take_project_lock(tmp_path, project)
    assert lock is not None
    assert take_project_lock(tmp_path, project) is None
    lock.release()
    again = take_project_lock(tmp_path, project)
    assert again is not None
    again.release()


def test_the_data_folder_is_the_users(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    assert user_data_folder().name == "bobdesk"

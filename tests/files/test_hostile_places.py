"""Places that do not take a file, or have names that no one thought of: real ones, not pretended."""

from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bobdesk.cli.main import run
from bobdesk.errors import InputError
from bobdesk.files import atomic, instance_lock
from bobdesk.files.atomic import is_windows_device, write_atomic
from bobdesk.files.importers.formats import read_line
from bobdesk.files.instance_lock import is_locked, take_lock
from bobdesk.files.project_file import is_project, load_project, save_project
from bobdesk.files.recovery import Recovery
from bobdesk.files.recovery_store import recover, recoverable
from bobdesk.project.project import Project
from tests.project.made_projects import full_project, ready_project
from tests.project.same_project import print_of

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="names and limits are those of POSIX")


def test_a_link_is_kept_and_what_it_points_to_replaced(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    link = tmp_path / "a.bobdesk"
    link.symlink_to(Path("real") / "b.bobdesk")
    save_project(Project(name="first"), link)
    save_project(Project(name="second"), link)
    assert link.is_symlink()
    assert load_project(tmp_path / "real" / "b.bobdesk").name == "second"
    assert [place.name for place in (tmp_path / "real").iterdir()] == ["b.bobdesk"]


def test_links_that_lead_nowhere_are_sentences(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "circle").symlink_to(tmp_path / "circle")
    (tmp_path / "gone").symlink_to(tmp_path / "no" / "where")
    for name, reading, writing in (
        ("circle", "too many levels of symbolic links", "too many levels of symbolic links"),
        ("gone", "there is no such file", "there is no folder"),
    ):
        for read in (load_project, read_line):
            with pytest.raises(InputError, match=reading):
                read(tmp_path / name)
        with pytest.raises(InputError, match=writing):
            save_project(Project(), tmp_path / name)
        assert not is_project(tmp_path / name)
        calls = (["segment", tmp_path / name, "-o", tmp_path / "s.csv"], ["segment", "x.csv", "-o", tmp_path / name])
        for call in calls:
            assert run([str(part) for part in call]) == 3
            said = capsys.readouterr().err
            assert said.startswith("bobdesk: ")
            assert said.count("\n") == 1


def test_names_that_cannot_be_are_sentences(tmp_path: Path) -> None:
    for name in ("a\0b.bobdesk", "x" * 300 + ".bobdesk", "d/" * 3000 + "x.bobdesk"):
        for read in (load_project, read_line):
            with pytest.raises(InputError) as error:
                read(tmp_path / name)
            assert "\0" not in str(error.value).replace("\\0", "") or "no such file" in str(error.value)
        with pytest.raises(InputError, match="cannot be written"):
            save_project(Project(), tmp_path / name)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "name", [b"\xff\xfe.bobdesk", b"two\nlines.bobdesk", "Königssee 🛷.bobdesk".encode(), b"x" * 247 + b".bobdesk"]
)
def test_odd_names_are_saved_opened_and_recovered(name: bytes, tmp_path: Path) -> None:
    path = Path(os.fsdecode(os.fsencode(tmp_path) + b"/" + name))
    try:
        save_project(ready_project(), path)
    except InputError:
        pytest.skip("this file system has no such names")
    assert print_of(load_project(path)) == print_of(ready_project())
    said: list[str] = []
    session = Recovery(tmp_path / "data", say=said.append)
    session.keep(ready_project(), path=path, last_edit=f"Open {path.name}")
    assert session.wait(5)
    session.close(forget=False)
    assert said == []
    (item,) = recoverable(tmp_path / "data")
    assert item.path == path
    assert print_of(recover(item)) == print_of(ready_project())


def test_a_state_that_cannot_be_written_is_said_and_the_next_one_is_kept(tmp_path: Path) -> None:
    said: list[str] = []

    def say(sentence: str) -> None:
        said.append(sentence)
        raise KeyError("whoever listens may fail")

    session = Recovery(tmp_path, say=say, try_again_s=0.01)
    session.keep(ready_project(), path=None, last_edit="good")
    assert session.wait(5)
    for broken in (Project(name=3), Project(fit=None), Project(runs=7)):  # type: ignore[arg-type]
        session.keep(broken, path=None, last_edit="broken")
        assert not session.wait(0.2)
    assert len(said) == 1
    assert said[0].startswith("No recovery copy could be written, and it is tried again: ")
    session.keep(full_project(), path=None, last_edit="good again")
    assert session.wait(5)
    session.close(forget=False)
    (item,) = recoverable(tmp_path)
    assert item.last_edit == "good again"
    assert print_of(recover(item)) == print_of(full_project())


def test_names_that_windows_keeps_for_devices(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("CON", "con.bobdesk", "NUL .csv", "aux.tar.gz", "COM1", "lpt9.txt", "COM¹.csv"):
        assert is_windows_device(name), name
    for name in ("CONSOLE.csv", "a.con", "COM10", "COM0", "LPT", "nul-meridian.csv", ".bobdesk"):
        assert not is_windows_device(name), name
    monkeypatch.setattr(atomic.os, "name", "nt")
    with pytest.raises(InputError, match="Windows keeps that name for a device"):
        atomic.check_writable(tmp_path / "con.bobdesk")


def test_a_lock_where_there_are_none_is_no_other_window(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def without_locks(_: object) -> None:
        raise OSError(37, "No locks available")

    monkeypatch.setattr(instance_lock, "_lock", without_locks)
    with pytest.raises(OSError, match="No locks"):
        take_lock(tmp_path / "a.lock")
    assert not is_locked(tmp_path / "a.lock")


_SAVE = """
import os, resource, signal, sys
from pathlib import Path
from bobdesk.errors import InputError
from bobdesk.files.project_file import save_project
from bobdesk.files.recovery import Recovery
from tests.project.made_projects import full_project
project = full_project()
if sys.argv[3] == "small":
    # A write beyond the limit fails as on a full disk, half-way.
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, 10_000))
elif os.getuid() == 0:
    os.setgroups([])
    os.setgid(65534)
    os.setuid(65534)
try:
    save_project(project, Path(sys.argv[1]))
except InputError as error:
    print(error)
session = Recovery(Path(sys.argv[2]), say=print, try_again_s=0.05)
session.keep(project, path=None, last_edit="x")
print(session.wait(0.5))
session.close(forget=False)
"""


def _said(path: Path, data: Path, how: str) -> str:
    return subprocess.run(
        [sys.executable, "-c", _SAVE, str(path), str(data), how],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    ).stdout


def test_a_disk_that_takes_half_a_file_keeps_the_old_one(tmp_path: Path) -> None:
    path = tmp_path / "a.bobdesk"
    save_project(ready_project(), path)
    before = path.read_bytes()
    said = _said(path, tmp_path / "data", "small").splitlines()
    assert said[0] == f"{path}: cannot be written: file too large"
    assert said[1].startswith("No recovery copy could be written, and it is tried again: ")
    assert said[2:] == ["False"]
    assert path.read_bytes() == before
    assert [place.name for place in tmp_path.iterdir() if place.is_file()] == ["a.bobdesk"]
    assert recoverable(tmp_path / "data") == ()


@pytest.fixture
def folder() -> Iterator[Path]:
    """Yield a folder that others may look into, unlike those of pytest."""
    place = Path(tempfile.mkdtemp())
    place.chmod(0o755)
    yield place
    place.chmod(0o755)
    shutil.rmtree(place)


def test_a_folder_that_may_not_be_written_to_keeps_its_file(folder: Path) -> None:
    path = folder / "a.bobdesk"
    save_project(ready_project(), path)
    path.chmod(0o644)
    before = path.read_bytes()
    folder.chmod(0o555)
    said = _said(path, folder / "data", "nobody").splitlines()
    assert said[0] == f"{path}: cannot be written: permission denied"
    assert said[1].startswith("No recovery copy could be written, and it is tried again: ")
    assert said[2:] == ["False"]
    assert path.read_bytes() == before
    assert list(folder.iterdir()) == [path]


def test_many_windows_at_once_lose_nothing(tmp_path: Path) -> None:
    sessions = [Recovery(tmp_path) for _ in range(8)]
    for round_number in range(5):
        for number, session in enumerate(sessions):
            session.keep(Project(name=f"{number} {round_number}"), path=None, last_edit=str(round_number))
    for session in sessions:
        assert session.wait(20)
        session.close(forget=False)
    assert {item.name for item in recoverable(tmp_path)} == {f"{number} 4" for number in range(8)}


def test_writers_of_one_file_leave_one_of_their_whole_contents(tmp_path: Path) -> None:
    from concurrent.futures import ThreadPoolExecutor

    path = tmp_path / "a"
    contents = [bytes([number]) * 200_000 for number in range(16)]
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda content: write_atomic(path, content), contents))
    assert path.read_bytes() in contents
    assert list(tmp_path.iterdir()) == [path]


_PIECES = (b'"', b"null", b"1e999", b"..", b"\\u0000", b"[" * 2000)


@settings(
    deadline=None, max_examples=120, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=st.data())
def test_a_damaged_recovery_copy_raises_nothing_but_the_one_error(tmp_path: Path, data: st.DataObject) -> None:
    folder = tmp_path / "recovery" / "1"
    if not folder.exists():
        session = Recovery(tmp_path)
        session.keep(ready_project(), path=Path(os.fsdecode(b"/tmp/\xff.bobdesk")), last_edit="x")
        assert session.wait(5)
        session.close(forget=False)
        session.folder.rename(folder)
        (tmp_path / "whole").write_bytes((folder / "state.json").read_bytes())
    content = bytearray((tmp_path / "whole").read_bytes())
    for _ in range(data.draw(st.integers(1, 3))):
        # What stands before and behind the long document is hit as often as that.
        at = data.draw(
            st.integers(0, 300) | st.integers(len(content) - 300, len(content) - 1) | st.integers(0, len(content) - 1)
        )
        piece = data.draw(
            st.binary(max_size=5) | st.sampled_from([b'"', b"null", b"1e999", b"..", b"\\u0000", b"[" * 2000])
        )
        content[at : at + data.draw(st.integers(0, 9))] = piece
    (folder / "state.json").write_bytes(bytes(content))
    for item in recoverable(tmp_path):
        with contextlib.suppress(InputError):
            recover(item)

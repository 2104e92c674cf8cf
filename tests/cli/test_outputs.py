"""A command that fails leaves no file and changes none; what exists and is no file stays what it is."""

import errno
import os
import pwd
import stat
import sys
from pathlib import Path

import pytest

from bobdesk.cli.main import run
from tests.cli.calls import TARGETS, contents, one_sentence

ALL = ("--report", "r.json", "--envelope", "e.csv", "--picture", "p.svg")


@pytest.fixture
def full_call(call):
    """Call reconstruct with all four outputs in a folder of their own."""
    out = call.path("out")
    out.mkdir()
    given = [part if part.startswith("--") else out / part for part in ALL]
    return call, out, ("reconstruct", call.plan, *TARGETS, "-o", out / "line.csv", *given)


def test_all_outputs_are_written_and_no_other(full_call):
    call, out, arguments = full_call
    assert call(*arguments).status == 0
    assert {path.name for path in out.iterdir()} == {"line.csv", "r.json", "e.csv", "p.svg"}
    assert all(path.stat().st_size > 300 for path in out.iterdir())


@pytest.mark.parametrize(
    ("existing", "fails_at", "function"), [(False, 1, "fsync"), (True, 4, "fsync"), (False, 4, "fdopen")]
)
def test_a_full_disk_leaves_what_was_there(full_call, monkeypatch, existing, fails_at, function):
    call, out, arguments = full_call
    if existing:
        for name in ("line.csv", "r.json", "e.csv", "p.svg"):
            (out / name).write_text("kept")
    real, count = getattr(os, function), iter(range(1, 100))

    def full(*given, **named):
        if next(count) == fails_at:
            if function == "fdopen":
                os.close(given[0])
            raise OSError(errno.ENOSPC, "No space left on device")
        return real(*given, **named)

    monkeypatch.setattr(f"bobdesk.files.atomic.os.{function}", full)
    assert "no space left on device" in call.refused(*arguments, status=3)


def test_the_folder_of_an_output_is_missing(call):
    output = call.path("nowhere") / "x.csv"
    for command in (("segment", call.plan, "-o", output), ("check", call.plan, *TARGETS, "--report", output)):
        assert "there is no folder" in call.refused(*command, status=3)
    for option in ("-o", "--report", "--envelope"):
        named = ("-o", call.path("l.csv")) if option != "-o" else ()
        call.refused("reconstruct", call.plan, *TARGETS, *named, option, output, status=3)
    assert not output.parent.exists()


def test_an_output_is_a_folder_or_beneath_a_file(call):
    assert "it is a folder" in call.refused("segment", call.plan, "-o", call.folder, status=3)
    assert "it is a folder" in call.refused("segment", call.plan, "-o", "", status=3)
    call.refused("segment", call.plan, "-o", call.plan / "x.csv", status=3)


def test_a_name_that_is_too_long_is_refused_and_the_longest_is_not(call):
    assert "name too long" in call.refused("segment", call.plan, "-o", call.path("a" * 300), status=3)
    assert call("segment", call.plan, "-o", call.path("a" * 255)).status == 0


def test_an_output_would_overwrite_an_input(call, monkeypatch):
    monkeypatch.chdir(call.folder)
    call("segment", "plan.csv", "-o", "s.csv")
    link = call.path("link.csv")
    link.symlink_to(call.plan)
    for plan in (call.plan, "plan.csv", "../here/plan.csv", link):
        assert "overwrite" in call.refused("segment", call.plan, "-o", plan, status=2)
        assert "overwrite" in call.refused("reconstruct", call.plan, *TARGETS, "-o", plan, status=2)
        assert "overwrite" in call.refused("check", call.plan, *TARGETS, "--report", plan, status=2)
    arguments = ("reconstruct", call.plan, *TARGETS, "--segments", "s.csv", "-o", "l.csv", "--envelope", "s.csv")
    assert "overwrite" in call.refused(*arguments, status=2)


def test_two_outputs_are_the_same_file(call, monkeypatch):
    monkeypatch.chdir(call.folder)
    for other in ("l.csv", "./l.csv", "../here/l.csv", call.path("l.csv")):
        arguments = ("reconstruct", call.plan, *TARGETS, "-o", "l.csv")
        assert "two outputs" in call.refused(*arguments, "--report", other, status=2)


def test_a_pipe_stays_a_pipe(call):
    # A stand-in for devices such as /dev/null, which tests must never be able to replace.
    pipe = call.path("pipe")
    os.mkfifo(pipe)
    said = call("segment", call.plan, "-o", pipe)
    assert said.status == 3
    assert "no ordinary file" in said.err
    assert stat.S_ISFIFO(pipe.stat().st_mode)


def test_a_link_stays_a_link_and_its_file_is_replaced(call):
    target, link = call.path("target.csv"), call.path("link.csv")
    target.write_text("old")
    link.symlink_to(target)
    assert call("segment", call.plan, "-o", link).status == 0
    assert link.is_symlink()
    assert target.read_text("utf-8").startswith("segment,kind")


def test_permissions_of_a_replaced_file_are_kept(call):
    output = call.path("s.csv")
    output.write_text("old")
    output.chmod(0o640)
    assert call("segment", call.plan, "-o", output).status == 0
    assert stat.S_IMODE(output.stat().st_mode) == 0o640


def test_a_closed_folder_and_a_closed_file_are_refused(call):
    """Run without root's rights, which pass every check of permissions."""
    closed = call.path("closed")
    closed.mkdir()
    output = call.path("mine.csv")
    output.write_text("kept")
    output.chmod(0o444)
    call.plan.chmod(0o644)
    call.folder.chmod(0o777)
    closed.chmod(0o555)
    before = contents(call.folder)
    for path in ("closed/s.csv", "mine.csv"):
        status, said = without_rights(call.folder, ["segment", "plan.csv", "-o", path])
        assert status == 3
        assert "permission denied" in one_sentence(said)
    closed.chmod(0o755)
    assert contents(call.folder) == before


def without_rights(folder: Path, arguments: list[str]) -> tuple[int, str]:
    """Run a command in a child, as nobody if this is root, with paths that begin in the folder."""
    said = folder.parent / "stderr"
    child = os.fork()
    if child == 0:
        status = 99
        try:
            os.chdir(folder)
            os.dup2(os.open(said, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), 2)
            sys.stderr = os.fdopen(2, "w", buffering=1)
            if os.geteuid() == 0:
                os.setuid(pwd.getpwnam("nobody").pw_uid)
            status = run(arguments)
        finally:
            sys.stderr.flush()
            os._exit(status)
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    return status, said.read_text("utf-8")


def test_a_read_only_plan_can_be_read(call):
    call.plan.chmod(0o444)
    assert call("segment", call.plan, "-o", Path(call.folder) / "s.csv").status == 0

"""A file is replaced by a whole one or not at all."""

import errno
import os
from pathlib import Path

import pytest

from bobdesk.errors import InputError
from bobdesk.files.atomic import check_writable, write_all, write_atomic


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_content_is_what_was_given_and_nothing_is_left_beside_it(tmp_path):
    path = tmp_path / "a.bin"
    for content in (b"", b"one", bytes(range(256)) * 1000):
        write_atomic(path, content)
        assert path.read_bytes() == content
        assert names(tmp_path) == ["a.bin"]


def test_a_new_file_has_the_permissions_that_the_mask_gives(tmp_path):
    before = os.umask(0o027)
    try:
        write_atomic(tmp_path / "a", b"x")
    finally:
        os.umask(before)
    assert (tmp_path / "a").stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("function", ["fsync", "fdopen"])
def test_a_failure_is_one_sentence_and_leaves_the_old_file(tmp_path, monkeypatch, function):
    path = tmp_path / "a.csv"
    path.write_bytes(b"old")

    def full(handle, *_given):
        if function == "fdopen":
            os.close(handle)
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(f"bobdesk.files.atomic.os.{function}", full)
    with pytest.raises(InputError, match="cannot be written: no space left on device"):
        write_atomic(path, b"new")
    assert path.read_bytes() == b"old"
    assert names(tmp_path) == ["a.csv"]


def test_of_several_files_none_is_written_if_one_cannot_be(tmp_path):
    with pytest.raises(InputError, match="there is no folder"):
        write_all({tmp_path / "a": b"a", tmp_path / "missing" / "b": b"b"})
    assert names(tmp_path) == []


def test_an_interrupt_leaves_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "a.csv"
    path.write_bytes(b"old")

    def interrupted(_handle):
        raise KeyboardInterrupt

    monkeypatch.setattr("bobdesk.files.atomic.os.fsync", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_atomic(path, b"new")
    assert path.read_bytes() == b"old"
    assert names(tmp_path) == ["a.csv"]


def test_content_is_flushed_to_the_disk_before_the_file_is_moved(tmp_path, monkeypatch):
    done = []
    real_sync, real_replace = os.fsync, Path.replace
    monkeypatch.setattr("bobdesk.files.atomic.os.fsync", lambda handle: (done.append("sync"), real_sync(handle))[1])
    monkeypatch.setattr(Path, "replace", lambda self, to: (done.append("move"), real_replace(self, to))[1])
    write_all({tmp_path / "a": b"a", tmp_path / "b": b"b"})
    assert done == ["sync", "sync", "move", "move"]


def test_what_is_no_ordinary_file_is_refused(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path, why in ((tmp_path / "pipe", "no ordinary file"), (tmp_path, "it is a folder")):
        with pytest.raises(InputError, match=why):
            check_writable(path)
        with pytest.raises(InputError, match=why):
            write_atomic(path, b"x")
    assert (tmp_path / "pipe").is_fifo()

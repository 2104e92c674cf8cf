"""A new file has a name of its own, and a folder that takes none says so at once."""

import os
import stat

import pytest

from bobdesk.files import new_file as module
from bobdesk.files.new_file import new_file


def test_it_is_new_empty_and_the_users_own(tmp_path):
    first, one = new_file(tmp_path, prefix=".a-", suffix=".part")
    second, other = new_file(tmp_path, prefix=".a-", suffix=".part")
    os.close(first)
    os.close(second)
    assert {one, other} == set(tmp_path.iterdir())
    assert one.name.startswith(".a-")
    assert one.suffix == ".part"
    assert one.read_bytes() == b""
    if os.name == "posix":
        assert stat.S_IMODE(one.stat().st_mode) == 0o600


def test_a_refusal_is_not_taken_for_a_name_that_is_taken(tmp_path, monkeypatch):
    # `tempfile` goes on for hours where the system is Windows and says of the folder that it can be written to.
    asked = []

    def refused(path, *_):
        asked.append(path)
        raise PermissionError(13, "Access is denied")

    monkeypatch.setattr(module.os, "open", refused)
    with pytest.raises(PermissionError):
        new_file(tmp_path)
    assert len(asked) == 1


def test_another_name_is_tried_where_one_is_taken(tmp_path, monkeypatch):
    names = iter(["taken", "taken", "free"])
    monkeypatch.setattr(module.secrets, "token_hex", lambda _count: next(names))
    (tmp_path / "taken").write_text("mine")
    handle, path = new_file(tmp_path)
    os.close(handle)
    assert path == tmp_path / "free"
    assert (tmp_path / "taken").read_text() == "mine"

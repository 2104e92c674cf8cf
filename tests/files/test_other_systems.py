"""What other systems do otherwise, made to happen on this one."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from bobdesk.errors import InputError
from bobdesk.files import atomic, processes
from bobdesk.files.atomic import write_atomic
from bobdesk.files.file_names import usable_name

ROOT = Path(__file__).parents[2]


@pytest.fixture
def busy(monkeypatch):
    """Return a function that has the next moves refused, as Windows does while a scanner has the old file open."""
    monkeypatch.setattr(atomic, "_PAUSES_S", (0.0, 0.0, 0.0))
    real, left = Path.replace, []

    def refused(self, target):
        if left:
            left.pop()
            raise PermissionError(13, "Access is denied")
        return real(self, target)

    monkeypatch.setattr(Path, "replace", refused)
    return lambda times: left.extend([None] * times)


def test_a_file_that_a_scanner_has_open_is_replaced_a_moment_later(tmp_path, busy):
    path = tmp_path / "line.csv"
    path.write_bytes(b"old")
    busy(3)
    write_atomic(path, b"new")
    assert path.read_bytes() == b"new"
    assert [one.name for one in tmp_path.iterdir()] == ["line.csv"]


def test_a_file_that_stays_open_is_left_and_told_of(tmp_path, busy):
    path = tmp_path / "line.csv"
    path.write_bytes(b"old")
    busy(4)
    with pytest.raises(InputError, match="cannot be written: access is denied"):
        write_atomic(path, b"new")
    assert path.read_bytes() == b"old"
    assert [one.name for one in tmp_path.iterdir()] == ["line.csv"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Whistler", "Whistler.csv"),
        ("Königssee, Kurve 1–3", "Königssee, Kurve 1–3.csv"),
        ("Run 1: start/finish", "Run 1- start-finish.csv"),
        ('a<b>c"d|e?f*g\\h', "a-b-c-d-e-f-g-h.csv"),
        ("two\nlines\x00", "two-lines-.csv"),
        ("ends with dots . .", "ends with dots.csv"),
        ("..", "untitled.csv"),
        ("", "untitled.csv"),
        ("aux", "_aux.csv"),
        ("COM3", "_COM3.csv"),
        ("x" * 300, "x" * 120 + ".csv"),
    ],
)
def test_a_proposed_name_is_one_that_every_system_takes(text, expected):
    assert usable_name(text, ".csv") == expected


def test_windows_gets_no_more_workers_than_it_can_wait_for(monkeypatch):
    asked = []

    class Executor:
        def __init__(self, workers, **_options):
            asked.append(workers)

        def shutdown(self, **_options):
            pass

    monkeypatch.setattr(processes, "ProcessPoolExecutor", Executor)
    for platform in ("linux", "win32"):
        monkeypatch.setattr(processes.sys, "platform", platform)
        with processes.process_executor(128):
            pass
    assert asked == [128, 61]


def test_a_worker_needs_no_streams_of_python(tmp_path):
    code = "import sys; sys.stdin = sys.stdout = sys.stderr = None; from bobdesk.__main__ import main; sys.exit(main())"
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-c", code, "--dxf-worker"],
        input=b"no drawing", capture_output=True, env=environment, timeout=60, check=False,
    )  # fmt: skip
    assert b'"error"' in done.stdout or done.returncode == 1
    request = b'{"name": "x", "page": 1, "dpi": 200, "limit_megapixels": 1, "world": null, "size": 4}\nnone'
    done = subprocess.run(
        [sys.executable, "-c", code, "--picture-worker"],
        input=request, capture_output=True, env=environment, timeout=60, check=False,
    )  # fmt: skip
    assert done.stdout.startswith(b'{"error"')


# Modules that one system alone has, and the guard that mypy and readers see.
_ALONE = re.compile(r"^\s*import (fcntl|resource|msvcrt|winreg|pwd|grp|termios)\b", re.MULTILINE)


def test_what_one_system_alone_has_is_imported_under_a_guard():
    for path in (ROOT / "bobdesk").rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        for found in _ALONE.finditer(text):
            assert found[0].startswith(("\n ", " ")), path
            before = text[: found.start()]
            assert 'sys.platform == "win32"' in before or 'sys.platform != "win32"' in before, path


_TEXT = re.compile(r"\.(?:read_text|write_text)\([^)]*\)|\.open\(\"[rwax]\+?\"[^)]*\)")


def test_text_files_are_read_and_written_in_utf_8_whatever_the_system_usually_takes():
    calls = [
        (path.name, call)
        for path in (ROOT / "bobdesk").rglob("*.py")
        for call in _TEXT.findall(path.read_text(encoding="utf-8"))
    ]
    assert calls
    assert [call for call in calls if "encoding=" not in call[1]] == []

"""A few calls of the real program: `python -m bobdesk`."""

import os
import resource
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.calls import MUGELLO, TARGETS, one_sentence

ROOT = Path(__file__).parents[2]


def bobdesk(*arguments, folder, **options):
    environment = {**os.environ, "PYTHONPATH": str(ROOT)} | {"PYTHONWARNINGS": "error"}
    return subprocess.run(
        [sys.executable, "-m", "bobdesk", *map(str, arguments)],
        cwd=folder, env=environment, capture_output=True, text=True, timeout=60, check=False, **options,
    )  # fmt: skip


def test_a_line_and_its_picture_without_a_screen(tmp_path, monkeypatch):
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)
    done = bobdesk(
        "reconstruct", MUGELLO, *TARGETS, "-o", "line.csv", "--picture", "p.png", "--report", "r.json", folder=tmp_path
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    assert {path.name for path in tmp_path.iterdir()} == {"line.csv", "p.png", "r.json"}
    assert (tmp_path / "p.png").read_bytes().startswith(b"\x89PNG\r\n")
    assert "703.000 m" in done.stdout


@pytest.mark.parametrize(
    ("arguments", "status"),
    [
        (("check", "plan.csv", "--length", "700"), 2),
        (("check", "nowhere.csv", *TARGETS), 3),
        (("check", MUGELLO, "--length", "700", "--drop", "30", "--strict"), 4),
    ],
)
def test_each_exit_status(tmp_path, arguments, status):
    done = bobdesk(*arguments, folder=tmp_path)
    assert done.returncode == status
    assert done.stdout == ""
    one_sentence(done.stderr)
    assert list(tmp_path.iterdir()) == []


def test_help_and_version(tmp_path):
    for command in ("segment", "reconstruct"):
        done = bobdesk(command, "--help", folder=tmp_path)
        assert (done.returncode, done.stderr) == (0, "")
        assert done.stdout.startswith(f"Usage: bobdesk {command}")
    assert bobdesk("--version", folder=tmp_path).stdout.startswith("BobDesk, version ")


def test_the_same_call_writes_the_same_bytes(tmp_path):
    for name in ("a", "b"):
        bobdesk(
            "reconstruct",
            MUGELLO,
            *TARGETS,
            "-o",
            f"{name}.csv",
            "--envelope",
            f"{name}e.csv",
            "--spacing",
            4,
            folder=tmp_path,
        )
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()
    assert (tmp_path / "ae.csv").read_bytes() == (tmp_path / "be.csv").read_bytes()


def test_ten_million_rows_are_refused_soon_and_within_a_gigabyte(tmp_path):
    with (tmp_path / "many.csv").open("wb") as stream:
        block = b"123456.7,890\n" * 100_000
        stream.write(b"x_m,y_m\n")
        for _ in range(100):
            stream.write(block)

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (1_000_000_000, 1_000_000_000))
        resource.setrlimit(resource.RLIMIT_CPU, (5, 5))

    # One thread of BLAS: each reserves address space that it never uses.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    done = bobdesk("segment", "many.csv", "-o", "s.csv", folder=tmp_path, preexec_fn=limit)
    assert done.returncode == 3, done.stderr
    assert "10,000,001" in one_sentence(done.stderr)
    assert "1,000,000 points" in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["many.csv"]
    (tmp_path / "many.csv").unlink()

"""Standard streams as other systems have them: none at all, or in an encoding that lacks signs."""

import os
import subprocess
import sys
from pathlib import Path

from tests.cli.calls import MUGELLO

ROOT = Path(__file__).parents[2]


def run(code, *arguments, **environment):
    surroundings = os.environ | {"PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"} | environment
    return subprocess.run(
        [sys.executable, "-c", f"{code}\nimport sys; from bobdesk.__main__ import main; sys.exit(main())", *arguments],
        capture_output=True, env=surroundings, timeout=120, check=False,
    )  # fmt: skip


def test_a_program_without_a_console_does_its_work_all_the_same(tmp_path):
    out = tmp_path / "line.csv"
    none = "import sys; sys.stdin = sys.stdout = sys.stderr = None"
    done = run(none, "reconstruct", str(MUGELLO), "-o", str(out), "--length", "703.7", "--drop", "35.73")
    assert done.returncode == 0
    assert out.read_text().startswith("station_m,")


def test_signs_that_the_encoding_lacks_are_no_fault():
    code = "import click, bobdesk.cli.check as module\n"
    code += "module.command.callback = lambda **_: click.echo('\\u2212 1 \\u00b1 2')"
    said = run(code, "check", "x", "--length", "1", "--drop", "1", PYTHONIOENCODING="cp1252")
    assert said.returncode == 0, said.stderr
    assert said.stdout.split() == [b"?", b"1", b"\xb1", b"2"]

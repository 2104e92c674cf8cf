from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest


@pytest.mark.skipif(not hasattr(os, "fork"), reason="the workers are forked")
def test_a_process_killed_at_any_moment_loses_nothing() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "tests.soak.kill_while_editing", "--seconds", "15", "--seed", "20260301"],
        capture_output=True,
        text=True,
        timeout=120,
        env=dict(os.environ, PYTHONPATH=str(Path.cwd()), OPENBLAS_NUM_THREADS="1"),
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert int(done.stdout.split()[0]) >= 5
    assert "nothing was lost" in done.stdout

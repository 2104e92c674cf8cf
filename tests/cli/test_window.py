import subprocess
import sys

import pytest

from bobdesk.cli.main import COMMANDS
from bobdesk.cli.window import wants_window


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    [
        ([], True),
        (["plan.png"], True),
        (["folder/plan"], True),
        (["trace"], False),
        (["--help"], False),
        (["--version"], False),
        (["chek"], False),
        (["plan.png", "other.png"], False),
    ],
)
def test_a_word_without_a_path_is_a_mistyped_command(arguments, wanted):
    assert wants_window(arguments, COMMANDS) is wanted


def test_without_a_screen_it_says_so(tmp_path, monkeypatch):
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("HOME", str(tmp_path))
    done = subprocess.run([sys.executable, "-m", "bobdesk"], capture_output=True, text=True, timeout=60, check=False)
    if sys.platform == "linux":
        assert done.returncode == 3
        assert done.stderr.count("\n") == 1
        assert "no screen" in done.stderr

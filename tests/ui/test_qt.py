"""Which pairs of Python and PySide6 are refused, and that the one at hand is sound."""

import subprocess
import sys

import pytest

from bobdesk.errors import InputError
from bobdesk.ui.qt import application_without_screen, refuse_unsound_versions


@pytest.mark.parametrize(
    ("python", "qt"), [((3, 11, 7), "6.12.0"), ((3, 11, 0), "6.13.1"), ((3, 11, 9), "7.0.0"), ((3, 11, 7), "6.12.0a1")]
)
def test_an_unsound_pair_is_refused_with_what_to_install(python, qt):
    with pytest.raises(InputError, match=r"PySide6-Essentials<6\.12"):
        refuse_unsound_versions(python, qt)


@pytest.mark.parametrize(
    ("python", "qt"), [((3, 11, 7), "6.11.3"), ((3, 11, 7), "6.9.0"), ((3, 12, 0), "6.12.0"), ((3, 13, 1), "7.0.0")]
)
def test_a_sound_pair_is_not(python, qt):
    refuse_unsound_versions(python, qt)


EMITS = """
import sys
from PySide6.QtCore import QObject, Signal

class Source(QObject):
    happened = Signal(bool)

source, received = Source(), []
source.happened.connect(received.append)
before = sys.getrefcount(True)
for _ in range(2000):
    source.happened.emit(True)
held = len(received)
received.clear()
print(held, sys.getrefcount(True) - before)
"""


def test_two_thousand_signals_keep_the_references_to_true():
    # In a process of its own: where it fails, Python aborts.
    done = subprocess.run([sys.executable, "-c", EMITS], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    held, change = map(int, done.stdout.split())
    assert held == 2000
    assert abs(change) <= 10


def test_there_is_one_application():
    first = application_without_screen()
    assert application_without_screen() is first

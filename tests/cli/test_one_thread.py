"""The number of threads decides over the last digits: it must not depend on what was started how."""

import os
import subprocess
import sys

CODE = """
import os, sys
from bobdesk.__main__ import main
assert "numpy" not in sys.modules
sys.argv = ["bobdesk", "--version"]
main()
print(os.environ["OPENBLAS_NUM_THREADS"])
"""


def last_line(**added):
    environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"} | added
    done = subprocess.run([sys.executable, "-c", CODE], env=environment, capture_output=True, text=True, check=True)
    return done.stdout.splitlines()[-1]


def test_the_program_calculates_with_one_thread_unless_told_otherwise():
    assert last_line() == "1"
    assert last_line(OPENBLAS_NUM_THREADS="3") == "3"

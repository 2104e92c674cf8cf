"""Reports of several systems are compared to six digits."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[2] / "packaging" / "same_figures.py"


def report(passed=True, version="1.0", length=1358.7599994381187, rows=1353, percent=0.0062983, iterations=205):
    return {
        "version": version,
        "passed": passed,
        "step": None if passed else "solve",
        "error": None if passed else "no result",
        "system": {"platform": "Made", "machine": "up"},
        "figures": {"length": length},
        "against_the_truth": {"z_rms": 1.683959195435371, "plan_length_percent": percent},
        "counts": {"rows": rows, "iterations": iterations},
    }


def compared(folder, *reports):
    paths = []
    for number, content in enumerate(reports):
        paths.append(folder / f"{number}.json")
        paths[-1].write_text(json.dumps(content))
    return subprocess.run([sys.executable, str(SCRIPT), *map(str, paths)], capture_output=True, text=True, check=False)


def test_the_same_to_six_digits_will_do(tmp_path):
    done = compared(
        tmp_path, report(), report(length=1358.7599994381187 * (1 + 5e-7)), report(percent=0.006297, iterations=199)
    )
    assert done.returncode == 0, done.stdout
    assert "the same figures" in done.stdout


@pytest.mark.parametrize(
    ("other", "said"),
    [
        (report(length=1358.7599994381187 * (1 + 2e-6)), "length 1358.76"),
        (report(percent=0.00632), "plan_length_percent 0.00632, not 0.0062983"),
        (report(rows=1354), "rows 1354, not 1353"),
        (report(version="1.1"), "version 1.1, not 1.0"),
        (report(passed=False), "solve: no result"),
        (report() | {"counts": {}}, "rows None, not 1353"),
        (report(length=float("nan")), "length nan"),
    ],
)
def test_anything_else_is_said_and_fails(tmp_path, other, said):
    done = compared(tmp_path, report(), other)
    assert done.returncode == 1
    assert said in done.stdout


def test_one_report_cannot_be_compared(tmp_path):
    assert compared(tmp_path, report()).returncode == 2

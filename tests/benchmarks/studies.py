"""A study of 200 solves on one core and on two."""

from __future__ import annotations

import csv
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tests.benchmarks.measure import Row
from tests.benchmarks.solvers import made_track

COUNTS = ",".join(str(count) for count in range(10, 30))


def rows() -> list[Row]:
    """Return a row for each number of processes; the tables must be equal."""
    found: list[Row] = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        plan = folder / "plan.csv"
        with plan.open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(("x_m", "y_m"))
            writer.writerows(made_track(1_300, 29)[0].tolist())
        tables = []
        for workers in (1, 2):
            table = folder / f"{workers}.csv"
            started = time.perf_counter()
            command = f"study {plan} --length 1306 --drop 130 --counts {COUNTS} --height-weights 0.5,1,1.5"
            command += f" --methods pgd,published,lbfgsb,slsqp --workers {workers} -o {table}"
            with _cores(workers):
                subprocess.run([sys.executable, "-m", "bobdesk", *command.split()], check=True, capture_output=True)
            seconds = time.perf_counter() - started
            tables.append(table.read_bytes())
            found.append({"solves": tables[-1].count(b"\n") - 1, "processes": workers, "seconds": seconds})
        found[-1]["times as fast"] = found[0]["seconds"] / found[1]["seconds"]
        found[-1]["same table"] = tables[0] == tables[1]
    return found


@contextmanager
def _cores(count: int) -> Iterator[None]:
    """Have what is started use so many cores; a single busy process that may wander between two is slower for it."""
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, sorted(before)[:count])
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)

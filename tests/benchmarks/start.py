"""Seconds from the start of a program to its first painted window: python -m tests.benchmarks.start [COMMAND ...]

COMMAND is what starts the window, such as dist/bobdesk/bobdesk; without one it is this checkout's. The window is shown
on a screen of its own (Xvfb), whose pixels are watched: what counts is when the middle of the window has its content.
The first start is not counted, so that files are in memory. Processor seconds, of all threads, are less disturbed by
what else the machine does.
"""

from __future__ import annotations

import mmap
import os
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

_TIMES = 9
_WIDTH, _HEIGHT = 1400, 900
_POLL_S = 0.004
_LONGEST_S = 60


def main(command: list[str]) -> None:
    """Print a line of figures."""
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        read, write = os.pipe()
        size = f"{_WIDTH}x{_HEIGHT}x24"
        call = ["Xvfb", "-displayfd", str(write), "-screen", "0", size, "-fbdir", str(folder), "-nolisten", "tcp"]
        with subprocess.Popen(call, pass_fds=[write], stderr=subprocess.DEVNULL) as screen:
            os.close(write)
            display = os.read(read, 16).decode().strip()
            environment = os.environ | {"DISPLAY": f":{display}", "QT_QPA_PLATFORM": "xcb", "HOME": str(folder)}
            try:
                found = [_start(command, environment, folder / "Xvfb_screen0") for _ in range(_TIMES + 1)][1:]
            finally:
                screen.terminate()
    wall, processor = [sorted(values) for values in zip(*found, strict=True)]
    print(
        f"first paint after {statistics.median(wall):.2f} s ({wall[0]:.2f} to {wall[-1]:.2f}),"
        f" processor {statistics.median(processor):.2f} s, {_TIMES} warm starts of {' '.join(command)}"
    )


def _start(command: list[str], environment: dict[str, str], screen: Path) -> tuple[float, float]:
    """Return the seconds until something is painted, and the processor's until then."""
    with screen.open("rb") as stream, mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as pixels:
        _wait(lambda: not _painted(pixels))
        before = time.perf_counter()
        with subprocess.Popen(
            command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        ) as program:
            _wait(lambda: _painted(pixels))
            seconds = time.perf_counter() - before
            used = sum(map(int, Path(f"/proc/{program.pid}/stat").read_text().rsplit(")", 1)[1].split()[11:13]))
            program.send_signal(signal.SIGKILL)
    return seconds, used / os.sysconf("SC_CLK_TCK")


def _painted(pixels: mmap.mmap) -> bool:
    """Return whether the screen's middle rows are not all of one colour, as the empty screen is."""
    line = 4 * _WIDTH
    start = len(pixels) - line * _HEIGHT // 2
    rows = pixels[start : start + 40 * line]
    return rows != rows[:4] * (len(rows) // 4)


def _wait(until: Callable[[], bool]) -> None:
    end = time.monotonic() + _LONGEST_S
    while not until():
        if time.monotonic() > end:
            raise TimeoutError("nothing was painted")
        time.sleep(_POLL_S)


if __name__ == "__main__":
    main(sys.argv[1:] or [sys.executable, "-m", "bobdesk"])

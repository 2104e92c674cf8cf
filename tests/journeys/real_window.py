"""A screen of its own with a window manager, the real program on it, and a hand that moves mouse and keys."""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent.parent
NEEDED = ("Xvfb", "openbox", "xdotool")
_PATIENCE_S = 30.0


def missing() -> list[str]:
    """Return the programs that a journey needs and that are not here."""
    return [name for name in NEEDED if shutil.which(name) is None]


class Screen:
    """An X server and a window manager."""

    def __init__(self, width: int = 1500, height: int = 950) -> None:
        reading, writing = os.pipe()
        self._server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{width}x{height}x24", "-nolisten", "tcp"],
            pass_fds=[writing],
            stderr=subprocess.DEVNULL,
        )
        os.close(writing)
        with os.fdopen(reading) as pipe:
            self.display = f":{pipe.readline().strip()}"
        self._manager = subprocess.Popen(
            ["openbox"],
            env={**os.environ, "DISPLAY": self.display},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    def close(self) -> None:
        for process in (self._manager, self._server):
            process.terminate()
            process.wait(10)


class RealWindow:
    """The program, and a person before it.

    Parameters
    ----------
    home
        Settings and data folders lie below it: a second program with the same home finds what the first left.
    """

    def __init__(self, screen: Screen, home: Path, *arguments: str | Path, environment: dict[str, str] | None = None):
        home.mkdir(exist_ok=True)
        self._screen = screen
        self._socket_path = str(home / "looking")
        Path(self._socket_path).unlink(missing_ok=True)
        self._environment = {
            **{name: value for name, value in os.environ.items() if name != "QT_QPA_PLATFORM"},
            "DISPLAY": screen.display,
            "HOME": str(home),
            "XDG_CONFIG_HOME": str(home / "config"),
            "XDG_DATA_HOME": str(home / "data"),
            "XDG_CACHE_HOME": str(home / "cache"),
            "QT_QPA_PLATFORM": "xcb",
            "LC_ALL": "C.UTF-8",
            # Where it ends by a fault, what it says shows where.
            "PYTHONFAULTHANDLER": "1",
            **(environment or {}),
        }
        self._said = (home / "said.txt").open("wb")
        self._program = subprocess.Popen(
            [sys.executable, "-m", "tests.journeys.driven", self._socket_path, *map(str, arguments)],
            cwd=ROOT,
            env=self._environment,
            stdout=self._said,
            stderr=subprocess.STDOUT,
        )
        self._home = home
        self._holds = False
        try:
            self._connection = self._connected()
            self.until("window.isVisible() and window.isActiveWindow()")
        except BaseException:
            self._program.kill()
            self._program.wait(10)
            self._said.close()
            raise

    @property
    def output(self) -> str:
        """What the program has written to its terminal."""
        return (self._home / "said.txt").read_text(errors="replace")

    def ask(self, question: str) -> Any:
        """Look: return the value of an expression in the program."""
        self._connection.sendall(question.replace("\n", " ").encode() + b"\n")
        line = b""
        while not line.endswith(b"\n"):
            try:
                piece = self._connection.recv(1 << 20)
            except ConnectionResetError:
                piece = b""
            if not piece:
                raise AssertionError(f"the program has ended: {self.output}")
            line += piece
        answer = json.loads(line)
        if "failed" in answer:
            raise LookupError(answer["failed"])
        return answer["is"]

    def until(self, question: str, true: Callable[[Any], bool] = bool) -> Any:
        """Wait until the answer to a question is as wanted, and return it."""
        end = time.monotonic() + _PATIENCE_S
        answer: Any = None
        while time.monotonic() < end:
            try:
                answer = self.ask(question)
            except LookupError as error:
                answer = error
            else:
                if true(answer):
                    return answer
            time.sleep(0.05)
        raise AssertionError(f"waited in vain for {question}: {answer}\n{self.output}")

    def key(self, *keys: str) -> None:
        """Press keys, such as "ctrl+z"; a mouse button that is held stays down."""
        for key in keys:
            # --clearmodifiers would lift the button for the time of the key.
            self._hand("key", *(() if self._holds else ("--clearmodifiers",)), key)
        self._settle()

    def type(self, text: str) -> None:
        """Type a text."""
        self._hand("type", "--delay", "8", "--", text)
        self._settle()

    def move(self, x: float, y: float) -> None:
        """Move the mouse to a place on the screen."""
        self._hand("mousemove", str(round(x)), str(round(y)))
        self._settle()

    def click(self, x: float, y: float, *, button: int = 1, times: int = 1) -> None:
        """Click at a place on the screen."""
        self.move(x, y)
        self._hand("click", "--repeat", str(times), "--delay", "60", str(button))
        self._settle()

    def click_on(self, name: str) -> None:
        """Click on the widget with this name or text."""
        self.until(f"middle({name!r})")
        self.click(*self.ask(f"middle({name!r})"))

    def click_plan(self, x: float, y: float, **how: Any) -> None:
        """Click on a pixel of the picture."""
        self.click(*self.ask(f"plan({float(x)}, {float(y)})"), **how)

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        """Drag with the left button from one place on the screen to another."""
        self.hold(start, end)
        self.release()

    def hold(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        """Begin to drag with the left button, and hold it at the end: `key` and `move` act in mid-drag."""
        self.move(*start)
        self._hand("mousedown", "1")
        self._holds = True
        self._settle()
        for part in (0.2, 0.5, 0.8, 1.0):
            self.move(start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1]))

    def release(self) -> None:
        """Let the left button go."""
        self._hand("mouseup", "1")
        self._holds = False
        self._settle()

    def drop_file(self, path: Path, x: float, y: float) -> None:
        """Drag a file out of another window and drop it at a place on the screen."""
        other = subprocess.Popen(
            [sys.executable, "-m", "tests.journeys.drag_source", str(path)],
            cwd=ROOT,
            env=self._environment,
            stdout=subprocess.PIPE,
        )
        assert other.stdout is not None
        other.stdout.readline()
        time.sleep(0.4)
        self._hand("mousemove", "30", "20")
        self._hand("mousedown", "1")
        for part in range(1, 11):
            self._hand("mousemove", str(round(30 + part * (x - 30) / 10)), str(round(20 + part * (y - 20) / 10)))
            time.sleep(0.06)
        self._hand("mouseup", "1")
        other.wait(20)
        other.stdout.close()

    def picture(self, path: Path) -> None:
        """Take a picture of the window."""
        self.ask(f"window.grab().save({str(path)!r})")

    def kill(self) -> None:
        """End the program as a crash would."""
        self._connection.close()
        self._program.kill()
        self._program.wait(10)
        self._said.close()

    def wait_for_end(self) -> int:
        """Wait until the program has ended by itself, and return its exit status."""
        status = self._program.wait(_PATIENCE_S)
        self._connection.close()
        self._said.close()
        return status

    def _connected(self) -> socket.socket:
        end = time.monotonic() + _PATIENCE_S
        while time.monotonic() < end:
            connection = socket.socket(socket.AF_UNIX)
            try:
                connection.connect(self._socket_path)
            except OSError:
                connection.close()
                if self._program.poll() is not None:
                    raise AssertionError(f"the program has ended: {self.output}") from None
                time.sleep(0.05)
            else:
                connection.settimeout(_PATIENCE_S)
                return connection
        raise AssertionError(f"the program does not answer: {self.output}")

    def _hand(self, *arguments: str) -> None:
        subprocess.run(["xdotool", *arguments], env=self._environment, check=True, timeout=20)

    def _settle(self) -> None:
        """Let the program take what the hand did; that may have been its end."""
        time.sleep(0.06)
        try:
            self.ask("1")
        except (OSError, AssertionError):
            if self._program.poll() is None:
                time.sleep(0.5)
            if self._program.poll() is None:
                raise

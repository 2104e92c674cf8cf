"""A Windows to try things on: Wine on a screen of its own, with users that have nothing but their own folders."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

WINE = next((path for path in ("/usr/lib/wine/wine64", "/usr/lib/wine/wine") if Path(path).exists()), "wine")
SERVER = next((path for path in ("/usr/lib/wine/wineserver64", "/usr/lib/wine/wineserver") if Path(path).exists()), "")
LONGEST_S = 600
_FONTS = ("MS Shell Dlg", "MS Shell Dlg 2", "MS Sans Serif", "Tahoma", "Segoe UI", "Arial")


class TrialError(Exception):
    """What was tried does not work; the message says what."""


class Machine:
    """One user's Windows.

    Parameters
    ----------
    home
        An empty folder for it.
    shims
        A folder with the libraries that Wine lacks.
    user
        The number of the user that it is for, or None for who runs the test; only root can choose.
    display
        Of the X server.
    """

    def __init__(self, home: Path, shims: Path, user: int | None, display: str) -> None:
        self.home = home
        self.drive = home / "prefix" / "drive_c"
        self._user = user
        libraries = sorted(path.stem for path in shims.glob("*.dll"))
        self._environment = {
            "HOME": str(home),
            "USER": "analyst",
            "PATH": os.environ["PATH"],
            "LANG": "C.UTF-8",
            "TMPDIR": str(home),
            "DISPLAY": display,
            "WINEPREFIX": str(home / "prefix"),
            "WINEARCH": "win64",
            "WINEDEBUG": "-all",
            # Neither .NET nor HTML, which would be asked for; no shortcuts among those of the Unix desktop.
            "WINEDLLOVERRIDES": "mscoree=;mshtml=;winemenubuilder.exe=d",
        }
        self._own(home)
        self._plain([WINE, "wineboot", "-i"])
        for library in shims.glob("*.dll"):
            shutil.copy(library, self.drive / "windows" / "system32")
        self._environment["WINEDLLOVERRIDES"] += ";" + ";".join(f"{name}=n" for name in libraries)
        self._plain([SERVER, "-k"])
        # Wine's own processes are started here and kept up: they would hold the pipes of a program that starts them.
        self._plain([SERVER, "-p"])
        self._plain([WINE, "wineboot"])
        self.run("reg", "add", r"HKCU\Software\Wine", "/v", "Version", "/d", "win10", "/f")
        for font in _FONTS:
            self.run("reg", "add", r"HKCU\Software\Wine\Fonts\Replacements", "/v", font, "/d", "DejaVu Sans", "/f")

    def run(self, *command: str, status: int | None = 0, within: float = LONGEST_S) -> str:
        """Run a program to its end and return what it says.

        Parameters
        ----------
        command
            The program, by its path there or in Unix, and its arguments.
        status
            With what it must end; None is whatever.

        Raises
        ------
        TrialError
            If it ends with another status, or does not end.
        """
        process = self.start(*command)
        try:
            said = _read(process.communicate(timeout=within)[0])
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            raise TrialError(f"{command[0]} did not end within {within:g} s") from None
        if status is not None and process.returncode != status:
            raise TrialError(
                f"{' '.join(command)} ended with {process.returncode}, not {status}: {said.strip()[-2000:]}"
            )
        return said.replace("\r", "")

    def start(self, *command: str) -> subprocess.Popen[bytes]:
        """Start a program; what it says and reads goes through pipes, without which Wine wants a console."""
        return subprocess.Popen(
            [*self._as_user(), WINE, *command],
            cwd=self.home,
            env=self._environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )

    def registry(self, key: str, name: str = "") -> str | None:
        """Return a text or number of the user's registry, or None if it is not there."""
        which = ["/v", name] if name else ["/ve"]
        said = self.run("reg", "query", f"HKCU\\{key}", *which, status=None)
        lines = [line.split("    ", 3)[-1] for line in said.splitlines() if "REG_" in line]
        return lines[0].strip() if lines else None

    def has_key(self, key: str) -> bool:
        """Return whether there is a key of the user's registry."""
        return "HKEY" in self.run("reg", "query", f"HKCU\\{key}", status=None)

    def windows(self) -> list[str]:
        """Return the titles of all windows."""
        said = subprocess.run(["xwininfo", "-root", "-tree"], env=self._environment, capture_output=True, check=False)
        return [line.split('"')[1] for line in said.stdout.decode("utf-8", "replace").splitlines() if '"' in line]

    def photograph(self, picture: Path) -> None:
        """Take a picture of the screen."""
        picture.unlink(missing_ok=True)
        subprocess.run(["scrot", str(picture)], env=self._environment, check=True)

    def give(self, path: Path) -> Path:
        """Make a file or folder, and all in it, the user's own."""
        self._own(path)
        return path

    def files(self) -> set[str]:
        """Return the paths of all files and folders in the home, in which drive C lies."""
        return {path.relative_to(self.home).as_posix() for path in self.home.rglob("*")}

    def stop(self) -> None:
        """End everything that runs there."""
        self._plain([SERVER, "-k"], check=False)

    def _plain(self, command: Sequence[str], *, check: bool = True) -> None:
        nothing = subprocess.DEVNULL
        subprocess.run(
            [*self._as_user(), *command],
            cwd=self.home,
            env=self._environment,
            stdin=nothing,
            stdout=nothing,
            stderr=nothing,
            check=check,
            timeout=LONGEST_S,
        )

    def _as_user(self) -> list[str]:
        if self._user is None:
            return []
        return ["setpriv", f"--reuid={self._user}", f"--regid={self._user}", "--clear-groups"]

    def _own(self, path: Path) -> None:
        if self._user is not None:
            for one in (path, *path.rglob("*")):
                os.chown(one, self._user, self._user, follow_symlinks=False)


def _read(said: bytes) -> str:
    try:
        return said.decode("utf-8")
    except UnicodeDecodeError:
        return said.decode("cp437")  # as Windows' own tools for the console write


@contextmanager
def screen(size: str = "1600x1000x24") -> Iterator[str]:
    """Start an X server and yield its display."""
    there, here = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(here), "-screen", "0", size, "-nolisten", "tcp", "-ac"],
        pass_fds=[here],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    os.close(here)
    try:
        with os.fdopen(there) as told:
            number = told.readline().strip()
        if not number:
            raise TrialError("Xvfb does not start")
        yield f":{number}"
    finally:
        server.terminate()
        server.wait()


def wait_for(true: Callable[[], object], what: str, within: float = 180.0) -> None:
    """Wait until something is true.

    Raises
    ------
    TrialError
        If it does not become true.
    """
    end = time.monotonic() + within
    while not true():
        if time.monotonic() > end:
            raise TrialError(f"{what}: not within {within:g} s")
        time.sleep(0.5)


def say(sentence: str) -> None:
    """Say what was seen, at once."""
    print(f"  {sentence}", flush=True)

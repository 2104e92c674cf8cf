"""Decode a picture in a process of its own, with limits on time and memory."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Generator
from typing import IO, Any

import numpy as np

from bobdesk.errors import InputError
from bobdesk.files.process_start import START_S
from bobdesk.plan.image import LIMIT_MEGAPIXELS, PlanImage
from bobdesk.plan.world import PixelToWorld
from bobdesk.progress import Progress

WORKER_ARGUMENT = "--picture-worker"

_TIME_LIMIT_S = 9.0 + START_S
_SECONDS_PER_MEGAPIXEL = 0.1  # more for decoding a large scan; 100 megapixels of LZW take about 1.5 s
_STEP_S = 0.03


def worker_command() -> list[str]:
    """Return the command that starts `bobdesk.files.picture_worker`.

    A frozen program (PyInstaller, Nuitka: `sys.frozen`) has no interpreter to run a module with; it starts
    itself with the one argument `WORKER_ARGUMENT`, which `bobdesk.__main__` must answer before anything
    else by `bobdesk.files.picture_worker.main()`.
    """
    if getattr(sys, "frozen", False):
        return [sys.executable, WORKER_ARGUMENT]
    # -P: a module of the user's working folder must not come before ours.
    return [sys.executable, "-P", "-W", "ignore", "-m", "bobdesk.files.picture_worker"]


def decode_in_process(
    data: bytes,
    *,
    name: str,
    page: int = 1,
    dpi: float = 200.0,
    limit_megapixels: float = LIMIT_MEGAPIXELS,
    world: PixelToWorld | None = None,
    time_limit_s: float = _TIME_LIMIT_S,
) -> Generator[Progress, None, PlanImage]:
    """Return the picture in `data` as `decode_picture` does, from a process with limits.

    A generator; closing it ends the process at once.

    Parameters
    ----------
    data, name, page, dpi, limit_megapixels, world
        As in `bobdesk.plan.image.decode_picture`.
    time_limit_s
        Seconds after which a page (PDF, SVG) is given up; PNG and the like get 0.1 s more for each
        megapixel.

    Raises
    ------
    InputError
        If the bytes are no picture, damaged, over a limit, or take too long or too much memory.
    """
    request = {
        "name": name,
        "page": page,
        "dpi": dpi,
        "limit_megapixels": limit_megapixels,
        "world": None if world is None else world.coefficients,
        "size": len(data),
    }
    with subprocess.Popen(
        worker_command(),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env=_environment(),
        creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
    ) as process:
        talk = _Talk(process, json.dumps(request).encode() + b"\n", data)
        talk.start()
        try:
            yield from _waited(talk, name=name, time_limit_s=time_limit_s)
        finally:
            process.kill()
            talk.join()
    return talk.picture(name=name)


def _waited(talk: _Talk, *, name: str, time_limit_s: float) -> Generator[Progress, None, None]:
    started = time.monotonic()
    while talk.is_alive():
        talk.join(_STEP_S)
        header = talk.header
        allowed = time_limit_s
        if header is not None and header["format"] not in ("PDF", "SVG"):
            allowed += header["megapixels"] * _SECONDS_PER_MEGAPIXEL
        waited = time.monotonic() - started
        if talk.is_alive() and waited > allowed:
            drawn = header is not None and header["format"] in ("PDF", "SVG")
            advice = "open it at a lower dpi or " if drawn else ""
            raise InputError(
                f"{name} took longer than {_seconds(allowed)} to open and was given up; "
                f"{advice}save it in a simpler form."
            )
        yield Progress(min(waited / allowed, 1.0), f"Opening {name}")


def _seconds(seconds: float) -> str:
    whole = max(1, round(seconds))
    return "1 second" if whole == 1 else f"{whole} seconds"


def _environment() -> dict[str, str]:
    """Return an environment in which the process finds the modules that this one has."""
    environment = dict(os.environ)
    environment["PYTHONPATH"] = os.pathsep.join(entry for entry in sys.path if entry)
    # numpy's threads would reserve the memory that the pixels need.
    environment.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", MKL_NUM_THREADS="1")
    return environment


class _Talk(threading.Thread):
    """Sends the request and takes the answer, so that the caller can wait with a limit."""

    def __init__(self, process: subprocess.Popen[bytes], request: bytes, data: bytes) -> None:
        super().__init__(name="picture", daemon=True)
        self._process = process
        self._request = request
        self._data = data
        self._answer: dict[str, Any] = {}
        self._pixels: np.ndarray[Any, Any] | None = None
        self.header: dict[str, Any] | None = None

    def run(self) -> None:
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None
        assert stdout is not None
        # A process that ends early breaks the pipe: what it said, if anything, tells why.
        with contextlib.suppress(OSError):
            stdin.write(self._request)
            stdin.write(self._data)
        with contextlib.suppress(OSError):
            stdin.close()
        try:
            self._take(stdout)
        except (OSError, ValueError, MemoryError):
            self._answer = {}

    def _take(self, stdout: IO[bytes]) -> None:
        while line := stdout.readline():
            message = json.loads(line)
            if "header" in message:
                self.header = message["header"]
                continue
            self._answer = message
            if "picture" in message:
                pixels = np.empty(message["picture"]["shape"], dtype=message["picture"]["dtype"])
                if _filled(pixels.data.cast("B"), stdout):
                    self._pixels = pixels
            return

    def picture(self, *, name: str) -> PlanImage:
        """Return the picture that came, or raise InputError with the sentence that came instead."""
        if "error" in self._answer:
            raise InputError(self._answer["error"])
        if self._pixels is None:
            raise InputError(f"{name} could not be opened: it is damaged, or takes more memory than a picture may.")
        told = self._answer["picture"]
        return PlanImage(
            pixels=self._pixels,
            dpi=None if told["dpi"] is None else (told["dpi"][0], told["dpi"][1]),
            pages=told["pages"],
            format=told["format"],
            notes=tuple(told["notes"]),
            world=None if told["world"] is None else PixelToWorld(*told["world"]),
        )


def _filled(target: memoryview, source: IO[bytes]) -> bool:
    """Read until `target` is full; return whether it is."""
    done = 0
    while done < len(target):
        count = source.readinto(target[done : done + 2**22])  # type: ignore[attr-defined]
        if not count:
            return False
        done += count
    return True

"""What a self-test has found so far, on the disk at any moment: also when the program is ended in the middle of a step.

Nothing here needs Qt, which may be what fails.
"""

from __future__ import annotations

import json
import os
import shutil
import sys
import threading
import time
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from bobdesk import __version__
from bobdesk.files.atomic import write_atomic

_ENDED = "the program ended in this step without saying why"


class SelfTestError(Exception):
    """Something is not as it should be; the message is the sentence for the report."""


class Record:
    """The report of a self-test.

    Parameters
    ----------
    path
        Of the JSON file, None for no file.
    say
        Called with the name of each step as it begins.

    Attributes
    ----------
    found : dict
        What is written: `passed`, `step` and `error` of a failure, `steps` with seconds, and what steps add.
    """

    def __init__(self, path: Path | None, say: Callable[[str], object]) -> None:
        self._path = path
        self._say = say
        self._lock = threading.RLock()
        self.found: dict[str, Any] = {
            "program": "BobDesk",
            "version": __version__,
            "passed": False,
            "step": "start",
            "error": _ENDED,
            "trace": None,
            "notes": [],
            "steps": [],
        }
        self.write()

    @property
    def passed(self) -> bool:
        """Whether all steps have come to their end."""
        return bool(self.found["passed"])

    @contextmanager
    def step(self, name: str) -> Iterator[None]:
        """Name what is being done, and put down how long it took; what it raises goes on."""
        with self._lock:
            self.found["step"] = name
        self._say(name)
        self.write()
        began = time.perf_counter()
        yield
        with self._lock:
            self.found["steps"].append({"step": name, "seconds": round(time.perf_counter() - began, 3)})

    def note(self, sentence: str) -> None:
        """Put down something that is good to know and no failure."""
        with self._lock:
            self.found["notes"].append(sentence)
        self._say(f"note: {sentence}")

    def put(self, name: str, value: object) -> None:
        """Put down what was found."""
        with self._lock:
            self.found[name] = value

    def pass_(self) -> None:
        """Put down that all is well."""
        with self._lock:
            self.found.update(passed=True, step=None, error=None)

    def fail(self, error: BaseException) -> None:
        """Put down why the step that is being done has failed."""
        with self._lock:
            known = isinstance(error, SelfTestError)
            self.found["passed"] = False
            self.found["error"] = str(error) if known else f"{type(error).__name__}: {error}"
            self.found["trace"] = "".join(traceback.format_exception(error))

    def write(self) -> None:
        """Bring the report to the disk."""
        with self._lock:
            if self._path is not None:
                text = json.dumps(self.found, indent=2, ensure_ascii=False, default=str) + "\n"
                write_atomic(self._path, text.encode("utf-8", "replace"))


class Watchdog:
    """Ends the program with a report when a step hangs, be it in a dialog that nobody answers or in a library.

    Parameters
    ----------
    seconds
        For all steps together.
    folder
        That is deleted first.
    """

    def __init__(self, record: Record, seconds: float, folder: Path) -> None:
        self._record, self._seconds, self._folder = record, seconds, folder
        self._main = threading.get_ident()
        self._is_over = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="self-test watchdog", daemon=True)
        self._thread.start()

    def end(self) -> None:
        """Watch no more."""
        self._is_over.set()
        self._thread.join()

    def _watch(self) -> None:
        if self._is_over.wait(self._seconds):
            return
        self._record.fail(SelfTestError(f"all steps together were given {self._seconds:g} s, and it hangs in this one"))
        frame = sys._current_frames().get(self._main)
        self._record.put("trace", "".join(traceback.format_stack(frame)))
        shutil.rmtree(self._folder, ignore_errors=True)
        self._record.write()
        os._exit(1)

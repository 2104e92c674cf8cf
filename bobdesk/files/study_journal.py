"""The rows of a study that are finished, kept beside its table until all are: what is killed goes on from there."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bobdesk.errors import InputError
from bobdesk.files.atomic import reason

if TYPE_CHECKING:
    from bobdesk.track.study import Task, Unready

Row = tuple[str, ...]
_ENDING = ".unfinished"
_HEAD_BEGINS = b'{"study": '
_LONGEST_HEAD = 1000


class StudyJournal:
    """One line of JSON a finished row, below a line that says which study they belong to.

    Parameters
    ----------
    table
        Where the table is to be written; the journal lies beside it.
    digest
        Of all that the rows depend on. Rows of another study are not used.
    """

    def __init__(self, table: Path, digest: str) -> None:
        self.path = table.with_name(table.name + _ENDING)
        self._digest = digest
        self._length = 0

    @property
    def is_anothers(self) -> bool:
        """Whether what lies there are finished rows of another study, or something else altogether."""
        try:
            with self.path.open("rb") as file:
                head = file.readline(_LONGEST_HEAD)
        except OSError:
            return False
        # A head that was cut short belongs to a study that had no row yet.
        cut_short = not head.endswith(b"\n") and self._head.startswith(head[: len(_HEAD_BEGINS)])
        return not cut_short and _parsed(head) != {"study": self._digest}

    @property
    def _head(self) -> bytes:
        return (json.dumps({"study": self._digest}) + "\n").encode()

    def finished(self) -> dict[int, Row]:
        """Return the rows that are there, by the number of their cell; a line that was cut short is left out."""
        found: dict[int, Row] = {}
        self._length = 0
        try:
            content = self.path.read_bytes()
        except OSError:
            return found
        lines = content.splitlines(keepends=True)
        if not lines or _parsed(lines[0]) != {"study": self._digest}:
            return found
        self._length = len(lines[0])
        for line in lines[1:]:
            entry = _parsed(line)
            if not (_is_entry(entry) and line.endswith(b"\n")):
                break
            found[entry[0]] = tuple(entry[1])
            self._length += len(line)
        return found

    def add(self, number: int, row: Row) -> None:
        """Keep a row.

        Raises
        ------
        InputError
            If it cannot be written.
        """
        line = (json.dumps([number, list(row)]) + "\n").encode()
        try:
            if self._length == 0:
                self.path.write_bytes(self._head + line)
                self._length = len(self._head) + len(line)
                return
            with self.path.open("r+b") as file:
                file.seek(self._length)
                file.truncate()
                file.write(line)
            self._length += len(line)
        except OSError as error:
            raise InputError(f"{self.path}: cannot keep the finished rows: {reason(error)}") from error

    def remove(self) -> None:
        """Remove the journal, once the table is written."""
        self.path.unlink(missing_ok=True)


def digest_of(tasks: Iterable[Task | Unready], version: str) -> str:
    """Return a fingerprint of all that the rows of these tasks depend on."""
    from bobdesk.track.study import Unready

    found = hashlib.sha256(version.encode())
    for task in tasks:
        if isinstance(task, Unready):
            found.update(repr(task).encode())
            continue
        rest = (task.cell, task.segments, task.targets, task.settings, task.factor)
        found.update(repr(rest).encode())
        found.update(task.centreline.points.tobytes())
        if task.actual is not None:
            found.update(task.actual.tobytes())
    return found.hexdigest()


def _is_entry(entry: Any) -> bool:
    return (
        isinstance(entry, list)
        and len(entry) == 2
        and type(entry[0]) is int
        and isinstance(entry[1], list)
        and all(isinstance(cell, str) for cell in entry[1])
    )


def _parsed(line: bytes) -> Any:
    try:
        return json.loads(line)
    except ValueError:
        return None

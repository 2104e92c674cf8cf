"""What the start page shows of recent projects, read from their files in the background."""

from __future__ import annotations

from collections.abc import Generator, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from bobdesk.arrays import FloatArray, frozen
from bobdesk.errors import InputError
from bobdesk.project.project import Project
from bobdesk.ui.line_picture import thinned

RecentState = Literal["empty", "plan", "line", "segments", "solved", "out of date", "damaged", "missing", "unknown"]
# Reading a larger file for a picture of the size of a thumb is not worth the user's disk.
_LARGEST_LOOKED_INTO = 300_000_000
_NO_LINE = np.zeros((0, 2))


@dataclass(frozen=True, eq=False)
class RecentEntry:
    """A recent project.

    Attributes
    ----------
    path
        Of its file.
    name
        Of the project, or of its file.
    modified
        When the file was written, seconds since 1970; None for a missing one.
    state
        How far the work is.
    line : (n, 2)
        At most 200 points of its line, y up; none where there is no line.
    """

    path: Path
    name: str
    modified: float | None
    state: RecentState
    line: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "line", frozen(self.line, columns=2))


def recent_entry_steps(paths: Iterable[Path]) -> Generator[RecentEntry, None, tuple[RecentEntry, ...]]:
    """Look into project files, one a step; a damaged or missing file gives an entry that says so."""
    found: list[RecentEntry] = []
    for path in paths:
        found.append(recent_entry(path))
        yield found[-1]
    return tuple(found)


def unread_entry(path: Path) -> RecentEntry:
    """Return what is known of a project before its file was read."""
    return RecentEntry(path, path.stem, None, "unknown", _NO_LINE)


def recent_entry(path: Path) -> RecentEntry:
    """Look into one project file."""
    # its parts bring in much that the first look at the window does without
    from bobdesk.files.project_file import load_project

    try:
        status = path.stat()
    except (OSError, ValueError):
        return RecentEntry(path, path.stem, None, "missing", _NO_LINE)
    if status.st_size > _LARGEST_LOOKED_INTO:
        return RecentEntry(path, path.stem, status.st_mtime, "unknown", _NO_LINE)
    try:
        project = load_project(path)
    except InputError:
        return RecentEntry(path, path.stem, status.st_mtime, "damaged", _NO_LINE)
    return RecentEntry(path, project.name.strip() or path.stem, status.st_mtime, _state(project), line_of(project))


def line_of(project: Project) -> FloatArray:
    """Return at most 200 points (n, 2) of a project's line as it was given, y up; none without a line."""
    if project.source is not None:
        return thinned(project.source.polyline.vertices)
    if project.trace is not None:
        flipped: FloatArray = thinned(project.trace.points) * (1.0, -1.0)
        return flipped
    return _NO_LINE


def _state(project: Project) -> RecentState:
    if project.run is not None:
        from bobdesk.project.derive_runs import why_out_of_date

        return "solved" if why_out_of_date(project, project.run) is None else "out of date"
    if project.source is None and project.trace is None:
        return "empty" if project.picture is None else "plan"
    return "line" if project.segments is None else "segments"

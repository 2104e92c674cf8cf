"""The samples that come with the program."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from bobdesk.ui.resources import resource

_PRACTICE = ("mugello", "plan.png")


@dataclass(frozen=True)
class Sample:
    """A sample track.

    Attributes
    ----------
    name
        Of its folder, by which it is opened.
    title
        In one line, from its SOURCE.md.
    licence
        First line of its licence, "" where the text beside it says all.
    folder
        Where it lies.
    """

    name: str
    title: str
    licence: str
    folder: Path


def samples() -> tuple[Sample, ...]:
    """Return the samples by title; none if the program was installed without them."""
    try:
        folders = [place for place in resource("samples").iterdir() if place.is_dir()]
    except OSError:
        return ()
    found = [
        Sample(folder.name, title, _first_line(folder / "LICENSE.txt"), folder)
        for folder in folders
        if (title := _first_line(folder / "SOURCE.md").lstrip("# "))
    ]
    return tuple(sorted(found, key=lambda sample: sample.title.casefold()))


def practice_picture() -> Path | None:
    """Return the picture of a plan to practise with; None if the program was installed without it."""
    path = resource("samples", *_PRACTICE)
    return path if path.is_file() else None


def _first_line(path: Path) -> str:
    try:
        with path.open(encoding="utf-8") as text:
            return next((line.strip() for line in text if line.strip()), "")
    except (OSError, UnicodeDecodeError):
        return ""

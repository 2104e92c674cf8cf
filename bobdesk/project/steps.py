"""The steps along the top of the window: what is done, next, out of date, and why, as data."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from bobdesk.alignment.segments import in_words
from bobdesk.project import derive
from bobdesk.project.derive_runs import why_out_of_date
from bobdesk.project.project import Project
from bobdesk.sentences import as_sentence

StepName = Literal["Plan", "Scale", "Centreline", "Segments", "Solve", "Export"]
StepState = Literal["done", "next", "later", "out of date"]
# Below this a pixel's size has six digits behind the point, m.
_FINE = 0.01


@dataclass(frozen=True)
class Amount:
    """A number in a sentence, to be written as the reader writes numbers.

    Attributes
    ----------
    value
        In SI units.
    digits
        Behind the point.
    is_length
        Whether it is in metres.
    """

    value: float
    digits: int = 0
    is_length: bool = False


@dataclass(frozen=True)
class Told:
    """What a solver has said: a sentence with numbers in it, and without names."""

    text: str


Part = Amount | Told | str


def plainly(part: Part) -> str:
    """Return a part of a sentence as files and commands have it: metres, points, no groups."""
    if isinstance(part, Amount):
        return f"{part.value:.{part.digits}f}" + (" m" if part.is_length else "")
    return part.text if isinstance(part, Told) else part


@dataclass(frozen=True)
class Step:
    """One step.

    Attributes
    ----------
    name
        As the window shows it.
    state
        "next" is the first one that is not done; those behind it come "later".
    template, parts
        What there is, or what to do, for a person: a sentence with `{}` for each of the parts.
    """

    name: StepName
    state: StepState
    template: str
    parts: tuple[Part, ...] = ()

    @property
    def sentence(self) -> str:
        """The sentence as files and commands have it."""
        return self.said(plainly)

    def said(self, show: Callable[[Part], str]) -> str:
        """Return the sentence with its parts as `show` writes them."""
        return self.template.format(*(show(part) for part in self.parts))


class _Look:
    def __init__(self, state: Literal["done", "open", "out of date"], template: str, *parts: Part) -> None:
        self.state = state
        self.template = template
        self.parts = parts


def steps(project: Project) -> tuple[Step, ...]:
    """Return the six steps in order."""
    found: list[Step] = []
    next_is_known = False
    for name, look in _LOOKS.items():
        seen = look(project)
        state: StepState = "later" if seen.state == "open" else seen.state
        if seen.state != "done" and not next_is_known:
            next_is_known = True
            state = "next" if seen.state == "open" else state
        found.append(Step(name, state, seen.template, seen.parts))
    return tuple(found)


def _plan(project: Project) -> _Look:
    if project.source is not None:
        return _Look("done", "Coordinates from {}.", project.source.name)
    if project.picture is not None:
        return _Look("done", "Picture {}.", project.picture.name)
    return _Look("open", "Open a picture of the plan, or coordinates.")


def _scale(project: Project) -> _Look:
    if not derive.scale_is_known(project):
        return _Look("done", "The scale is unknown; it is found from the length.")
    if project.source is not None:
        return _Look("done", "The coordinates are metres.")
    if project.picture is None:
        return _Look("open", "A plan comes first.")
    found = derive.calibration(project)
    if found.value is None:
        return _Look("open", "{}", _sentence(found.problem))
    per_pixel = found.value.metres_per_pixel
    return _Look("done", "{} per pixel.", Amount(per_pixel, 4 if per_pixel >= _FINE else 6, is_length=True))


def _centreline(project: Project) -> _Look:
    found = derive.centreline(project)
    if found.value is None:
        return _Look("open", "{}", _sentence(found.problem))
    return _Look("done", "{} in plan.", Amount(found.value.length, 1, is_length=True))


def _segments(project: Project) -> _Look:
    found = derive.segments(project)
    if found.value is None:
        return _Look("open", "{}", _sentence(found.problem))
    template = "{}, " + ("found automatically." if project.segments is None else "set by hand.")
    return _Look("done", template, in_words(found.value))


def _solve(project: Project) -> _Look:
    ready = derive.run_inputs(project)
    run = project.run
    if run is None:
        return _Look(
            "open", "{}", "Everything is ready to solve." if ready.value is not None else _sentence(ready.problem)
        )
    why = why_out_of_date(project, run)
    if why is not None:
        return _Look("out of date", "{}", _sentence(why))
    return _Look("done", "{}", Told(run.message))


def _export(project: Project) -> _Look:
    if project.run is None:
        return _Look("open", "A result comes first.")
    why = why_out_of_date(project, project.run)
    if why is not None:
        return _Look("out of date", "The result is out of date; solve again before exporting it.")
    return _Look("open", "The result can be exported.")


def _sentence(text: str | None) -> str:
    return as_sentence(text or "something is missing")


_LOOKS: dict[StepName, Callable[[Project], _Look]] = {
    "Plan": _plan,
    "Scale": _scale,
    "Centreline": _centreline,
    "Segments": _segments,
    "Solve": _solve,
    "Export": _export,
}

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


@dataclass(frozen=True)
class Step:
    """One step.

    Attributes
    ----------
    name
        As the window shows it.
    state
        "next" is the first one that is not done; those behind it come "later".
    sentence
        What there is, or what to do, for a person.
    """

    name: StepName
    state: StepState
    sentence: str


@dataclass(frozen=True)
class _Look:
    state: Literal["done", "open", "out of date"]
    sentence: str


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
        found.append(Step(name, state, seen.sentence))
    return tuple(found)


def _plan(project: Project) -> _Look:
    if project.source is not None:
        return _Look("done", f"Coordinates from {project.source.name}.")
    if project.picture is not None:
        return _Look("done", f"Picture {project.picture.name}.")
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
        return _Look("open", _sentence(found.problem))
    return _Look("done", f"{found.value.metres_per_pixel:.5g} m per pixel.")


def _centreline(project: Project) -> _Look:
    found = derive.centreline(project)
    if found.value is None:
        return _Look("open", _sentence(found.problem))
    return _Look("done", f"{found.value.length:.1f} m in plan.")


def _segments(project: Project) -> _Look:
    found = derive.segments(project)
    if found.value is None:
        return _Look("open", _sentence(found.problem))
    how = "found automatically" if project.segments is None else "set by hand"
    return _Look("done", f"{in_words(found.value)}, {how}.")


def _solve(project: Project) -> _Look:
    ready = derive.run_inputs(project)
    run = project.run
    if run is None:
        return _Look("open", _sentence(ready.problem) if ready.value is None else "Everything is ready to solve.")
    why = why_out_of_date(project, run)
    if why is not None:
        return _Look("out of date", _sentence(why))
    return _Look("done", run.message)


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

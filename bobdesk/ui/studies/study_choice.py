"""What the user has chosen for a study, as it is remembered, and what it means."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from PySide6.QtCore import QLocale

from bobdesk.errors import InputError
from bobdesk.files.solvers import solver_methods
from bobdesk.solve.run import SolverMethod
from bobdesk.solve.targets import KnownElevation
from bobdesk.track.study_choices import NO_SET, check_size, counts_of, known_set, set_name, weights_of
from bobdesk.ui.widgets.typed_number import typed_number

_NAME = "study"
KnownSets = dict[str, tuple[KnownElevation, ...]]


@dataclass(frozen=True)
class PlanFile:
    """A file that is studied beside the open project, with its targets, m, where it is no project."""

    path: str
    length: float | None = None
    drop: float | None = None
    used: bool = True


@dataclass(frozen=True)
class StudyChoice:
    """The texts and ticks of the form.

    Attributes
    ----------
    counts, weights, known
        As they were typed; known has a set a line.
    methods
        Keys.
    without_known
        Whether the empty set is one of the sets.
    workers
        Processes; 0 for as many as there are cores.
    with_project
        Whether the open project is studied.
    files
        Plans from files.
    """

    counts: str = "auto"
    weights: str = "1"
    methods: tuple[str, ...] = ("pgd", "published")
    known: str = ""
    without_known: bool = True
    workers: int = 0
    with_project: bool = True
    files: tuple[PlanFile, ...] = ()


@dataclass(frozen=True)
class Wanted:
    """What a choice means."""

    counts: tuple[int | None, ...]
    weights: tuple[float, ...]
    methods: tuple[SolverMethod, ...]
    sets: KnownSets

    def cells_of(self, plans: int) -> int:
        """Return how many solves that makes on so many plans."""
        each = sum(
            (1 if method.key == "pgd" else len(self.weights)) * (len(self.sets) if method.holds_known else 1)
            for method in self.methods
        )
        return plans * len(self.counts) * each


def wanted_of(choice: StudyChoice, plans: int) -> Wanted:
    """Return what a choice means on so many plans.

    Raises
    ------
    InputError
        If something of it cannot be read, or is missing.
    """
    methods = tuple(method for method in solver_methods().formats if method.key in choice.methods)
    if not methods:
        raise InputError("choose a method at least")
    needs_weights = any(method.key != "pgd" for method in methods)
    found = Wanted(
        counts_of(choice.counts),
        weights_of(_parts(choice.weights), typed_number) if needs_weights else (1.0,),
        methods,
        _sets(choice),
    )
    check_size(found.cells_of(plans))
    return found


def _parts(text: str) -> Sequence[str]:
    """Part numbers at spaces, semicolons and, where that can be no sign of decimals, commas."""
    is_decimal = QLocale().decimalPoint() == "," or ";" in text
    between = r"[;\s]+" if is_decimal else r"[,;\s]+"
    return [part for part in re.split(between, text.strip()) if part]


def _sets(choice: StudyChoice) -> KnownSets:
    found: KnownSets = {}
    lines = [line.strip() for line in choice.known.splitlines() if line.strip()]
    if choice.without_known or not lines:
        found[NO_SET] = ()
    for line in lines:
        known = known_set(line, _known)
        found[set_name(known)] = known
    return found


def _known(text: str) -> KnownElevation:
    parts = text.split(":")
    try:
        numbers = [typed_number(part) for part in parts]
    except InputError:
        numbers = []
    if len(numbers) not in (2, 3) or any(number < 0 for number in numbers[2:]):
        raise InputError(
            f"known elevations are written STATION:ELEVATION in metres, such as 250:98.5, not '{text[:40]}'"
        )
    return KnownElevation(*numbers)


def to_text(choice: StudyChoice) -> str:
    """Return a choice as it is remembered."""
    return json.dumps(asdict(choice))


def from_text(text: str) -> StudyChoice:
    """Return the choice that was remembered, or the usual one where there is none or it cannot be read."""
    try:
        found: dict[str, Any] = json.loads(text)
        files = tuple(PlanFile(**file) for file in found.pop("files"))
        choice = StudyChoice(**{**found, "methods": tuple(found["methods"])}, files=files)
    except (ValueError, TypeError, KeyError, AttributeError):
        return StudyChoice()
    usual = StudyChoice()
    good = all(isinstance(getattr(choice, name), type(value)) for name, value in asdict(usual).items())
    return choice if good else usual


SETTING = _NAME

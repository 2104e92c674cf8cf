"""Targets from the command line, and from a project where the command line says nothing."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import click

from bobdesk.errors import InputError
from bobdesk.files.project_file import is_project
from bobdesk.project import derive
from bobdesk.project.project import Limits, Project, TargetSet
from bobdesk.solve.targets import (
    DEFINITIONS,
    KnownElevation,
    MeanGradientDefinition,
    Targets,
    check_targets,
)
from bobdesk.track import study_choices


@dataclass(frozen=True)
class TargetOptions:
    """What the command line says of the targets; None and () where it says nothing."""

    length: float | None
    drop: float | None
    mean_gradient: float | None
    mean_gradient_is: MeanGradientDefinition | None
    min_gradient: float | None
    max_gradient: float | None
    known: tuple[KnownElevation, ...]
    unknown_scale: bool


def taken_target_options(
    plan: Path,
    *,
    length: float | None,
    drop: float | None,
    mean_gradient: float | None,
    mean_gradient_is: str | None,
    min_gradient: float | None,
    max_gradient: float | None,
    known: Iterable[str],
    unknown_scale: bool,
) -> TargetOptions:
    """Take the options; what is no usable figure, or missing for a plan that is no project, is a wrong call."""
    options = TargetOptions(
        length=length,
        drop=drop,
        mean_gradient=mean_gradient,
        mean_gradient_is=next((name for name in DEFINITIONS if name == mean_gradient_is), None),
        min_gradient=min_gradient,
        max_gradient=max_gradient,
        known=tuple(known_elevation(text) for text in known),
        unknown_scale=unknown_scale,
    )
    if not is_project(plan):
        _refuse_missing(length, drop, where="")
    # Figures that a project may still bring are filled in, so that a wrong one is told before any file is read.
    largest = 1e6 if length is None else length
    usual = TargetSet("", largest, largest / 2 if drop is None else drop)
    try:
        _targets(options, usual, Limits(), (), scale_known=True)
    except InputError as error:
        raise click.UsageError(str(error)) from error
    return options


def targets_of(options: TargetOptions, project: Project | None, *, plan: Path) -> Targets:
    """Return the targets in force: the command line's, else the project's; known elevations in the plan's own scale.

    Raises
    ------
    click.UsageError
        If length or drop are said by neither.
    InputError
        If the project's figures cannot be used, alone or with those of the command line.
    """
    if project is None:
        _refuse_missing(options.length, options.drop, where="")
        return _targets(options, TargetSet(""), Limits(), (), scale_known=True)
    chosen = project.targets
    _refuse_missing(
        chosen.length if options.length is None else options.length,
        chosen.drop if options.drop is None else options.drop,
        where=f": {plan} does not say it either",
    )
    known = derive.elevations_on_the_line(project)
    try:
        return _targets(options, chosen, project.limits, known, scale_known=derive.scale_is_known(project))
    except InputError as error:
        raise InputError(f"{plan}: {error}") from error


def _refuse_missing(length: float | None, drop: float | None, *, where: str) -> None:
    for option, value in (("--length", length), ("--drop", drop)):
        if value is None:
            raise click.UsageError(f"Missing option '{option}'{where}.")


def _targets(
    options: TargetOptions, chosen: TargetSet, limits: Limits, known: tuple[KnownElevation, ...], *, scale_known: bool
) -> Targets:
    length = chosen.length if options.length is None else options.length
    drop = chosen.drop if options.drop is None else options.drop
    assert length is not None
    assert drop is not None
    # A mean of the command line without its definition is the usual one, not the project's.
    definition = options.mean_gradient_is
    if definition is None:
        definition = chosen.mean_gradient_is if options.mean_gradient is None else "drop-per-length"
    return check_targets(
        Targets(
            length=length,
            drop=drop,
            mean_gradient=chosen.mean_gradient if options.mean_gradient is None else options.mean_gradient,
            mean_gradient_is=definition,
            min_gradient=limits.min_gradient if options.min_gradient is None else options.min_gradient,
            max_gradient=limits.max_gradient if options.max_gradient is None else options.max_gradient,
            known=options.known or known,
            unknown_scale=options.unknown_scale or not scale_known,
        )
    )


def known_elevation(text: str, option: str = "--known") -> KnownElevation:
    """Return STATION:ELEVATION or STATION:ELEVATION:TOLERANCE; anything else is a wrong call."""
    try:
        return study_choices.known_elevation(text)
    except InputError as error:
        raise click.UsageError(
            f"{option} takes STATION:ELEVATION, two numbers in metres such as 250:98.5, not '{text}'"
        ) from error

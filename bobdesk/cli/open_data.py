"""Options of `reconstruct` for what the data leave open: the error budget, and the methods side by side."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bobdesk.cli.options import FILE, combined, within
from bobdesk.cli.steps import with_progress
from bobdesk.files.plan_input import PlanInput
from bobdesk.files.solvers import watched_methods
from bobdesk.project.target_edits import LARGEST_PLAN_ERROR
from bobdesk.sentences import listed
from bobdesk.solve.settings import SolverSettings

if TYPE_CHECKING:
    from bobdesk.track.method_comparison import MethodRow

open_data_options = combined(
    click.option(
        "--error-budget",
        type=FILE,
        metavar="B.csv",
        help="Write what each source of error is worth in plan length, scale, elevation and gradient (pgd, 95 %).",
    ),
    click.option(
        "--error-band",
        type=FILE,
        metavar="S.csv",
        help="Write elevation and gradient with the half widths of their 95 % bands by station (pgd).",
    ),
    click.option(
        "--plan-error",
        type=float,
        callback=within(0, LARGEST_PLAN_ERROR),
        metavar="SHARE",
        show_default="a project's own or its calibration's; else it counts as 0",
        help="1 sigma of the plan's scale for the error budget: 0.002 is 0.2 %.",
    ),
    click.option(
        "--second-opinions",
        type=FILE,
        metavar="M.csv",
        help="Run all methods and write of each whether it meets the targets, objective, deviations and effort.",
    ),
)


@dataclass(frozen=True)
class OpenDataOptions:
    """What the command line asks for."""

    error_budget: Path | None
    error_band: Path | None
    plan_error: float | None
    second_opinions: Path | None

    @property
    def outputs(self) -> list[Path | None]:
        """Files to be written."""
        return [self.error_budget, self.error_band, self.second_opinions]


def taken_open_data_options(options: dict[str, Any]) -> OpenDataOptions:
    """Take these options out of all."""
    names = ("error_budget", "error_band", "plan_error", "second_opinions")
    return OpenDataOptions(**{name: options.pop(name) for name in names})


def open_data_files(
    given: PlanInput, settings: SolverSettings, asked: OpenDataOptions
) -> tuple[dict[Path, bytes], list[str]]:
    """Return the files that are asked for, and what is to be said."""
    files: dict[Path, bytes] = {}
    sentences: list[str] = []
    if asked.error_budget is not None or asked.error_band is not None:
        files |= _budget_files(given, settings, asked, sentences)
    if asked.second_opinions is not None:
        from bobdesk.files.exporters.study_tables import methods_table
        from bobdesk.track.method_comparison import compare_methods

        job = compare_methods(
            given.centreline,
            given.segments,
            given.targets,
            settings,
            clock=time.perf_counter,
            methods=watched_methods(),
        )
        rows = with_progress(job, "methods")
        files[asked.second_opinions] = methods_table(rows)
        sentences += _verdicts(rows)
    return files, sentences


def _verdicts(rows: Sequence[MethodRow]) -> list[str]:
    """Say which methods meet the targets, what the others miss, and why J may not show it."""
    from bobdesk.track.missed import MET_WITHIN, missed_text

    within = f"within {100 * MET_WITHIN:g} %"
    met = [row.method for row in rows if row.verdict == "met"]
    said = [f"the targets are met {within} by {listed(met)}" if met else f"no method meets the targets {within}"]
    said += [f"{row.method} does not meet them: {missed_text(row.missed)}" for row in rows if row.verdict == "not met"]
    rising = [
        f"{row.counted_drop:.2f} m where {row.method} has {row.found.drop:.2f} m"
        for row in rows
        if row.found is not None and row.has_rises_in_objective
    ]
    if rising:
        said.append(f"the objective J counts rises like falls: it sees a height difference of {listed(rising)}")
    unaware = [row.method for row in rows if any(miss.target == "known elevations" for miss in row.missed)]
    if unaware:
        said.append(f"J has no term for known elevations; it does not show what is missed of them by {listed(unaware)}")
    return said


def _budget_files(
    given: PlanInput, settings: SolverSettings, asked: OpenDataOptions, sentences: list[str]
) -> dict[Path, bytes]:
    from bobdesk.files.exporters.study_tables import budget_table, error_band_table
    from bobdesk.track.error_budget import error_budget
    from bobdesk.track.input_errors import input_errors

    if settings.method != "pgd":
        raise click.UsageError("--error-budget and --error-band go with the method pgd alone")
    errors = input_errors(
        given.centreline,
        given.asked,
        vertices=given.vertices,
        wavelength=given.wavelength,
        scale=given.scale_error if asked.plan_error is None else asked.plan_error,
    )
    job = error_budget(given.centreline, given.segments, given.targets, errors, settings.pgd)
    budget = with_progress(job, "error budget")
    sentences.append(budget.sentence)
    files: dict[Path, bytes] = {}
    if asked.error_budget is not None:
        files[asked.error_budget] = budget_table(budget)
    if asked.error_band is not None:
        files[asked.error_band] = error_band_table(budget)
    return files

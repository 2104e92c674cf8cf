"""`bobdesk study`: segment counts × height weights × methods × known elevations, a row for each."""

from __future__ import annotations

import os
from collections.abc import Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bobdesk import __version__
from bobdesk.cli.options import FILE, SeveralValues, plan_options, target_options
from bobdesk.cli.steps import check_outputs, read_plan, tell_own_segments, with_progress
from bobdesk.cli.targets import known_elevation, taken_target_options, targets_of
from bobdesk.errors import InputError
from bobdesk.files.atomic import write_all
from bobdesk.files.exporters.study_tables import study_table
from bobdesk.files.processes import process_executor
from bobdesk.files.solvers import solver_methods
from bobdesk.files.study_journal import StudyJournal, digest_of
from bobdesk.files.study_plans import StudyPlan, study_tasks
from bobdesk.files.study_run import dask_executor, run_study
from bobdesk.sentences import counted
from bobdesk.solve.targets import KnownElevation
from bobdesk.track.study import FAILED, STUDY_COLUMNS, Task, Unready, cells
from bobdesk.track.study_choices import NO_SET, check_size, counts_of, known_set, set_name, weights_of

if TYPE_CHECKING:
    from concurrent.futures import Executor


def _counts(_context: click.Context, _option: click.Parameter, text: str) -> tuple[int | None, ...]:
    try:
        return counts_of(text)
    except InputError as error:
        raise click.BadParameter(f"{error}.") from error


def _weights(_context: click.Context, _option: click.Parameter, text: str) -> tuple[float, ...]:
    try:
        return weights_of(text.split(","))
    except InputError as error:
        raise click.BadParameter(f"{error}.") from error


@click.command("study", cls=SeveralValues)
@click.argument("plans", type=FILE, nargs=-1, required=True, metavar="PLAN...")
@click.option("-o", "--output", type=FILE, required=True, metavar="TABLE.csv", help="Where to write the rows.")
@target_options
@plan_options
@click.option(
    "--counts",
    default="auto",
    callback=_counts,
    show_default=True,
    help="Numbers of segments: 10,15,21 or 10-20 or 10-30:5; auto is found.",
)
@click.option(
    "--height-weights",
    default="1",
    callback=_weights,
    show_default=True,
    help="Weights b of the published objective: 0.5,1,1.5. The method pgd has none, and is solved once.",
)
@click.option("--methods", default="pgd", show_default=True, help="Methods: pgd,published,lbfgsb.")
@click.option(
    "--known-set",
    "known_sets",
    multiple=True,
    metavar="'STATION:ELEVATION ...'",
    help="A set of known elevations beside those of --known; several sets are several rows. none is an empty one.",
)
@click.option("--workers", type=click.IntRange(1, 256), show_default="as many as there are cores", help="Processes.")
@click.option("--dask", metavar="ADDRESS", help="Solve on the Dask cluster whose scheduler listens at ADDRESS.")
@click.option("--restart", is_flag=True, help="Solve all rows again, whatever an interrupted study left.")
@click.option(
    "--picture",
    type=FILE,
    metavar="P.png",
    help="Draw the deviations as tables of colours and as curves (.png or .svg).",
)
def command(
    plans: tuple[Path, ...],
    output: Path,
    spacing: float | None,
    wavelength: float | None,
    counts: tuple[int | None, ...],
    height_weights: tuple[float, ...],
    methods: str,
    known_sets: tuple[str, ...],
    workers: int | None,
    dask: str | None,
    restart: bool,
    picture: Path | None,
    **options: Any,
) -> None:
    """Solve PLAN in every combination of segment counts, height weights, methods and known elevations.

    Projects bring their own targets. A line with elevations is its own actual track: z_rms_m is the error
    against it. What was interrupted goes on where it stopped when the same command is given again. A cell that cannot
    be solved is a row with its reason.
    """
    names = tuple(part.strip() for part in methods.split(","))
    available = solver_methods().formats
    for name in names:
        if name not in [method.key for method in available]:
            keys = ", ".join(method.key for method in available)
            raise click.UsageError(f"--methods must be of {keys}, not '{name}'")
    chosen = [_known_set(text) for text in known_sets or (NO_SET,)]
    sets = {set_name(known): known for known in chosen}
    asked = [taken_target_options(plan, **options) for plan in plans]
    check_outputs([output, picture], inputs=plans)
    if picture is not None and picture.suffix.lower() not in (".png", ".svg"):
        raise click.UsageError(f"--picture must end in .png or .svg, not '{picture.name}'")
    if len({plan.stem for plan in plans}) < len(plans):
        raise click.UsageError("two plans have the same name; the rows could not be told apart")
    wanted = cells([plan.stem for plan in plans], counts, height_weights, names, list(sets), available=available)
    try:
        check_size(len(wanted))
    except InputError as error:
        raise click.UsageError(str(error)) from error
    read = []
    for plan, targets in zip(plans, asked, strict=True):
        line = read_plan(plan)
        if None in counts:
            tell_own_segments(plan, line, None, None)
        read.append(StudyPlan(plan.stem, line, targets_of(targets, line.project, plan=plan)))
    tasks = with_progress(study_tasks(read, wanted, sets, spacing=spacing, wavelength=wavelength), "plans")
    journal = StudyJournal(output, digest_of(tasks, __version__))
    if restart:
        journal.remove()
    elif journal.is_anothers:
        raise InputError(
            f"{journal.path} holds the finished rows of another study (other plans, options or version): "
            "give another -o, or --restart to throw them away"
        )
    rows = _solved(tasks, journal, workers=workers, dask=dask)
    files = {output: study_table(rows)}
    if picture is not None:
        from bobdesk.ui.plots.study_picture import draw_study

        files[picture] = draw_study(rows, kind=picture.suffix.lower())
    write_all(files)
    journal.remove()
    failed = sum(row[STUDY_COLUMNS.index("status")] == FAILED for row in rows)
    said = f", {failed} of them failed and say why" if failed else ""
    click.echo(f"{counted(len(rows), 'row')}{said}, written to {output}")


def _known_set(text: str) -> tuple[KnownElevation, ...]:
    if not text.strip():
        raise click.UsageError(f"--known-set needs a STATION:ELEVATION, or {NO_SET} for an empty set")
    return known_set(text, lambda part: known_elevation(part, "--known-set"))


def _solved(
    tasks: Sequence[Task | Unready], journal: StudyJournal, *, workers: int | None, dask: str | None
) -> tuple[tuple[str, ...], ...]:
    open_tasks = len(tasks) - len(journal.finished())
    if 0 < open_tasks < len(tasks):
        click.echo(f"note: rows that were solved before are kept: {len(tasks) - open_tasks}", err=True)
    executor: AbstractContextManager[Executor]
    if dask is not None:
        executor = dask_executor(dask)
    else:
        executor = process_executor(min(workers or os.cpu_count() or 1, max(open_tasks, 1)))
    try:
        with executor as pool:
            return with_progress(run_study(tasks, pool, journal), "study")
    except KeyboardInterrupt:
        if journal.path.exists():
            raise click.Abort(
                f"stopped; the finished rows are kept in {journal.path}, and the same command goes on from there"
            ) from None
        raise

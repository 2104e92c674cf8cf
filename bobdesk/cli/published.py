"""`bobdesk published`: the paper's tables beside ours."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from bobdesk.cli.options import FILE
from bobdesk.cli.steps import check_outputs, read_plan, with_progress
from bobdesk.files.atomic import write_atomic
from bobdesk.files.published_tables import deviations_of, ours_of, plan_source, published_table, read_published
from bobdesk.track.published_study import METHODS, ComparedRow, PlanSource, PublishedRow, remake
from bobdesk.ui.resources import resource

_SOURCE = (
    "The paper: Chen et al., arXiv 2507.08393 v2. Its coordinates are not public: {made} plans with the published\n"
    "number of segments, and the plan length that follows from the published length, height difference and slopes,\n"
    "stand in for them ({given}).\n"
    "Deviations from the actual track, %: length, height difference, mean gradient (over the segments)."
)
_UNMET = 5e-4


@click.command("published")
@click.option("-o", "--output", type=FILE, metavar="TABLE.csv", help="Write all figures.")
@click.option(
    "--plan",
    "plans",
    multiple=True,
    metavar="NAME=FILE",
    help="A track's real plan in metres instead of a stand-in: Whistler=FILE. Several are allowed.",
)
def command(output: Path | None, plans: tuple[str, ...]) -> None:
    """Print every row of the paper's tables beside what the published and our method make of the same targets.

    Targets are length, height difference and mean gradient of the actual track, as in the paper. Where the
    plan makes the length unreachable that is said, and by how much.
    """
    rows = read_published(resource("published", "tables.json"))
    files = _named(plans, rows)
    check_outputs([output], inputs=list(files.values()))
    sources: dict[str, PlanSource] = {name: plan_source(read_plan(path)) for name, path in files.items()}
    found = with_progress(remake(rows, sources), "published tables")
    if output is not None:
        write_atomic(output, published_table(found))
    click.echo(_said(found, files))
    if output is not None:
        click.echo(f"written to {output}")


def _named(plans: Sequence[str], rows: Sequence[PublishedRow]) -> dict[str, Path]:
    tracks = list(dict.fromkeys(row.track for row in rows))
    by_name = {track.lower(): track for track in tracks}
    found: dict[str, Path] = {}
    for text in plans:
        name, sign, file = text.partition("=")
        track = by_name.get(name.strip().lower())
        if track is None or not sign or not file:
            raise click.UsageError(f"--plan takes NAME=FILE with a name of {', '.join(tracks)}, not '{text}'")
        found[track] = Path(file)
    return found


def _said(found: Sequence[ComparedRow], files: dict[str, Path]) -> str:
    given = f"real plans of {', '.join(files)} are used" if files else "--plan Whistler=FILE takes a real one"
    lines = [_SOURCE.format(made="other made" if files else "made", given=given), ""]
    titles = ("the paper", *(f"our {method}" for method in METHODS))
    lines.append(f"{'table':14}{'track':12}{'segments':>8}{'b':>5}  " + "".join(f"{title:^27}" for title in titles))
    # One a track: its other rows differ by some centimetres, and the table has them all.
    notes: dict[tuple[str, str], str] = {}
    for compared in found:
        row = compared.row
        paper = row.generated
        cells = _three(deviations_of(row, paper.length, paper.drop, paper.mean_gradient))
        for ours in compared.ours:
            off = ours_of(row, ours)
            cells += f"{'failed':^27}" if off is None else _three(off)
            if off is None or (ours.method == "pgd" and abs(off[0]) >= _UNMET):
                about = f"{row.track}, {row.segments} segments, {ours.method}: {ours.message}"
                notes.setdefault((row.track, ours.method), about)
        lines.append(f"{row.table:14}{row.track:12}{row.segments:8}{row.height_weight:5g}  {cells}")
    scales = [
        f"table 2: the paper finds a factor of 1.1126 on the plan at 90 %, {', '.join(_factors(compared))}; true 1.1111"
        for compared in found
        if compared.row.table == "table 2"
    ]
    return "\n".join([*lines, "", *scales, *notes.values()])


def _three(off: tuple[float, float, float]) -> str:
    return "".join(f"{round(value, 3) + 0.0:9.3f}" for value in off)


def _factors(compared: ComparedRow) -> list[str]:
    return [f"{ours.method} {ours.scale:.4f}" for ours in compared.ours]

"""`bobdesk rules`: what design rules say of a line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from bobdesk.cli.options import FILE, combined
from bobdesk.cli.project_runs import shown_run
from bobdesk.cli.steps import check_outputs
from bobdesk.errors import InputError
from bobdesk.files.atomic import write_atomic
from bobdesk.files.importers.line3d import read_line3d
from bobdesk.files.project_file import is_project, load_project
from bobdesk.files.rules_file import findings_table, read_rules
from bobdesk.project.derive_runs import run_line
from bobdesk.sentences import counted
from bobdesk.track.centreline3d import Centreline3D
from bobdesk.track.design_rules import Finding, Rule, judged
from bobdesk.track.sled import Sled, check_sled
from bobdesk.ui.resources import resource

_MOST_STRETCHES = 6
sled_options = combined(
    click.option("--mass", type=float, show_default="630", help="Of sled and crew, kg."),
    click.option(
        "--drag-area", type=float, show_default="0.12, assumed", help="Drag coefficient times front area, m²."
    ),
    click.option("--friction", type=float, show_default="0.0042", help="Of runners on ice."),
    click.option("--start-speed", type=float, show_default="10", help="With which the sled passes the start, m/s."),
    click.option("--air-density", type=float, show_default="1.25", help="kg/m³."),
)


@click.command("rules")
@click.argument("line", type=FILE)
@click.option(
    "--rules", "rules_from", type=FILE, metavar="FILE", help="Rules as JSON; a project's or BobDesk's without."
)
@click.option("-o", "--output", type=FILE, metavar="FINDINGS.csv", help="Write the findings with their stretches.")
@sled_options
def command(line: Path, rules_from: Path | None, output: Path | None, **options: Any) -> None:
    """Judge LINE.csv, any line with elevations, or the result of a project by design rules.

    Speeds and loads are those of a simple sled that is neither steered nor braked. All of BobDesk's own rules are
    second hand: their sources are said, and a file of your own takes their place.
    """
    check_outputs([output], inputs=[line, rules_from])
    given = {name: value for name, value in options.items() if value is not None}
    try:
        check_sled(Sled(**given))
    except InputError as error:
        raise click.UsageError(str(error)) from error
    own = None if rules_from is None else read_rules(rules_from)
    track, rules, sled = _read(line)
    if own is not None:
        rules = own
    elif rules is None:
        rules = read_rules(_usual())
    findings = judged(track, rules, replace(sled, **given))
    if output is not None:
        write_atomic(output, findings_table(findings))
    for found in findings:
        click.echo(_said(found))
    click.echo(_counted(findings) if findings else _why_none(line, rules_from, are_there=bool(rules)))
    if output is not None:
        click.echo(f"written to {output}")


def _counted(findings: Sequence[Finding]) -> str:
    broken = sum(found.verdict == "broken" for found in findings)
    kept = sum(found.verdict == "kept" for found in findings)
    return f"{counted(kept, 'rule')} kept, {broken} broken, {len(findings) - kept - broken} not judged"


def _why_none(line: Path, rules_from: Path | None, *, are_there: bool) -> str:
    """Say why nothing was judged, and where rules are: a list without any is the user's own."""
    if rules_from is not None:
        if are_there:
            return f'nothing is judged: every rule in {rules_from} has "used": false'
        others = "the project's" if is_project(line) else "BobDesk's"
        return f"nothing is judged: there are no rules in {rules_from}; without --rules {others} are taken"
    judges = f"--rules {_usual()} judges by those that come with BobDesk"
    if are_there:
        return f"nothing is judged: no rule in the list of {line} is ticked; {judges}"
    back = "Usual rules in step 6, Export, brings them back"
    return f"nothing is judged: there are no rules in the list of {line}; {back}, and {judges}"


def _usual() -> Path:
    return resource("rules", "design_rules.json")


def _read(path: Path) -> tuple[Centreline3D, tuple[Rule, ...] | None, Sled]:
    if is_project(path):
        project = load_project(path)
        return run_line(shown_run(project, path)), project.rules, project.sled
    found = read_line3d(path)
    for note in found.notes:
        click.echo(f"note: {path}: {note}", err=True)
    return found.line, None, Sled()


def _said(found: Finding) -> str:
    rule = found.rule
    asked = [
        f"{word} {_shown(value, rule.unit)}"
        for word, value in (("at least", rule.lowest), ("at most", rule.highest))
        if value is not None
    ]
    limits = " and ".join(asked)
    if rule.lowest is not None and rule.lowest == rule.highest:
        limits = f"{_shown(rule.lowest, rule.unit)} asked for"
    if found.verdict == "not judged" or found.value is None:
        said = f"not judged, {found.why}"
    else:
        said = f"{found.verdict}, {_shown(found.value, rule.unit)} ({limits})"
        if found.verdict == "broken":
            shown = [f"{start:.0f}-{end:.0f} m" for start, end in found.stretches[:_MOST_STRETCHES]]
            more = len(found.stretches) - len(shown)
            said += f" at {', '.join(shown)}" + (f" and {more} more" if more else "")
    return f"{rule.name}: {said}" + (f" [{rule.source}]" if rule.source else "")


def _shown(value: float, unit: str) -> str:
    if unit == "gradient":
        return f"{100 * value:.2f} %"
    return f"{value:,.4g} {unit}" if unit != "m" else f"{value:,.2f} m"

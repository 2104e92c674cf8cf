"""The design rules that come with BobDesk."""

from __future__ import annotations

from functools import cache

from bobdesk.files.rules_file import read_rules
from bobdesk.project.project import Project
from bobdesk.track.design_rules import Rule
from bobdesk.ui.resources import resource


@cache
def usual_rules() -> tuple[Rule, ...]:
    """Return them; all are second hand, and say where from."""
    return read_rules(resource("rules", "design_rules.json"))


def rules_of(project: Project) -> tuple[Rule, ...]:
    """Return a project's rules: its own, else the usual ones."""
    return usual_rules() if project.rules is None else project.rules

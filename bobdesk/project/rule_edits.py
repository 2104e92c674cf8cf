"""What a user does to design rules and to the sled that they are judged by."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from bobdesk.errors import InputError
from bobdesk.project.project import Project
from bobdesk.track.design_rules import Rule, check_rule
from bobdesk.track.sled import Sled, check_sled


def set_rules(project: Project, rules: Iterable[Rule] | None) -> Project:
    """Take other rules in the place of all there are; None for those that come with BobDesk."""
    return replace(project, rules=None if rules is None else tuple(check_rule(rule) for rule in rules))


def add_rule(project: Project, rule: Rule, *, usual: tuple[Rule, ...]) -> Project:
    """Add a rule at the end; `usual` are the rules of a project that has none of its own."""
    return set_rules(project, (*_rules(project, usual), rule))


def change_rule(project: Project, index: int, rule: Rule, *, usual: tuple[Rule, ...]) -> Project:
    """Put another rule in the place of one."""
    rules = _rules(project, usual)
    _check(rules, index)
    return set_rules(project, (*rules[:index], rule, *rules[index + 1 :]))


def remove_rule(project: Project, index: int, *, usual: tuple[Rule, ...]) -> Project:
    """Take a rule away."""
    rules = _rules(project, usual)
    _check(rules, index)
    return set_rules(project, (*rules[:index], *rules[index + 1 :]))


def set_sled(project: Project, sled: Sled) -> Project:
    """Let rules be judged by another sled."""
    return replace(project, sled=check_sled(sled))


def _rules(project: Project, usual: tuple[Rule, ...]) -> tuple[Rule, ...]:
    return usual if project.rules is None else project.rules


def _check(rules: tuple[Rule, ...], index: int) -> None:
    if not 0 <= index < len(rules):
        raise InputError(f"there is no rule {index + 1}")

"""Design rules in files: read from JSON, and findings written as a table."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import msgspec

from bobdesk.errors import InputError
from bobdesk.files.exporters.csv_flavours import FLAVOURS, text_cell, to_csv
from bobdesk.files.importers.table import read_bytes
from bobdesk.track.design_rules import QUANTITIES, UNITS, Finding, Quantity, Rule, check_rule

_MOST_RULES = 500
# Words by which the quantity of a rule is known where a file does not name it, by its unit; "" is any word.
_GUESSES: tuple[tuple[str, str, Quantity], ...] = (
    ("m", "length", "length"),
    ("gradient", "mean", "mean gradient"),
    ("gradient", "start block", "mean gradient"),
    ("gradient", "gradient", "gradient"),
    ("km/h", "", "speed"),
    ("g", "", "acceleration"),
    ("curves", "", "curves"),
)
# Likewise the stretch: "first 250 m", "start block: 15 m at 2 %"; that a second part begins at 250 m is an assumption.
_FROM_START = re.compile(r"(?:first|start block:?)\s+(\d+(?:\.\d+)?)\s*m\b", re.IGNORECASE)
_SECOND_PART, _SECOND_PART_BEGINS = "second part", 250.0


class _RuleEntry(msgspec.Struct):
    rule: str
    unit: str
    min: float | None = None
    max: float | None = None
    source: str = ""
    quantity: str | None = None
    from_m: float | None = None
    to_m: float | None = None
    used: bool = True


class _RulesFile(msgspec.Struct):
    rules: list[_RuleEntry]
    note: str = ""


def read_rules(path: Path) -> tuple[Rule, ...]:
    """Read rules from JSON: `{"rules": [{"rule", "quantity", "min", "max", "unit", "from_m", "to_m", "source"}]}`.

    Of these only `rule` and `unit` must be there; the quantity is one of `QUANTITIES`. It and the stretch follow
    from the unit and the words of the rule where they are missing.

    Raises
    ------
    InputError
        If the file cannot be used.
    """
    data = read_bytes(path)
    try:
        found = msgspec.json.decode(data.removeprefix(b"\xef\xbb\xbf"), type=_RulesFile)
    except msgspec.ValidationError as error:
        raise InputError(f"{path}: these are no design rules: {str(error)[:200]}") from error
    except (msgspec.DecodeError, RecursionError) as error:
        raise InputError(f"{path}: these are no design rules: the file is not JSON") from error
    if len(found.rules) > _MOST_RULES:
        raise InputError(f"{path}: it holds {len(found.rules):,} rules; at most {_MOST_RULES} can be used")
    try:
        return tuple(_rule(entry) for entry in found.rules)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def rules_json(rules: Iterable[Rule]) -> bytes:
    """Return rules as `read_rules` reads them."""
    entries: list[dict[str, Any]] = [
        {
            "rule": rule.name,
            "quantity": rule.quantity,
            "min": rule.lowest,
            "max": rule.highest,
            "unit": rule.unit,
            "from_m": rule.start,
            "to_m": rule.end,
            "source": rule.source,
            "used": rule.is_used,
        }
        for rule in rules
    ]
    return (json.dumps({"rules": entries}, indent=1, ensure_ascii=False, allow_nan=False) + "\n").encode()


def findings_table(findings: Iterable[Finding]) -> bytes:
    """Return one row a finding; stretches are FROM-TO in metres of plan, several with a blank between them."""
    flavour = FLAVOURS["default"]
    rows = [
        [
            text_cell(found.rule.name, flavour),
            found.rule.quantity,
            _number(found.rule.lowest),
            _number(found.rule.highest),
            found.rule.unit,
            _number(found.rule.start),
            _number(found.rule.end),
            found.verdict,
            "" if found.value is None else f"{found.value:.6g}",
            " ".join(f"{start:.2f}-{end:.2f}" for start, end in found.stretches),
            text_cell(found.why, flavour),
            text_cell(found.rule.source, flavour),
        ]
        for found in findings
    ]
    header = (
        "rule",
        "quantity",
        "min",
        "max",
        "unit",
        "from_m",
        "to_m",
        "verdict",
        "value",
        "broken_m",
        "why",
        "source",
    )
    return to_csv(header, rows, flavour)


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.9g}"


def _rule(entry: _RuleEntry) -> Rule:
    quantity = _quantity(entry)
    if entry.unit != UNITS[quantity]:
        raise InputError(f'the rule "{entry.rule}" is about {quantity}: its unit must be {UNITS[quantity]}')
    start, end = _stretch(entry)
    return check_rule(Rule(entry.rule, quantity, entry.min, entry.max, start, end, entry.source, entry.used))


def _stretch(entry: _RuleEntry) -> tuple[float, float | None]:
    if entry.from_m is not None or entry.to_m is not None:
        return entry.from_m or 0.0, entry.to_m
    said = _FROM_START.search(entry.rule)
    if said is not None:
        return 0.0, float(said.group(1))
    return (_SECOND_PART_BEGINS if _SECOND_PART in entry.rule.lower() else 0.0), None


def _quantity(entry: _RuleEntry) -> Quantity:
    if entry.quantity is not None:
        for quantity in QUANTITIES:
            if quantity == entry.quantity:
                return quantity
        raise InputError(f'the quantity of the rule "{entry.rule}" must be one of {", ".join(QUANTITIES)}')
    for unit, words, quantity in _GUESSES:
        if entry.unit == unit and words in entry.rule.lower():
            return quantity
    raise InputError(
        f'what the rule "{entry.rule}" is about does not follow from its words: give it a "quantity", one of'
        f" {', '.join(QUANTITIES)}"
    )

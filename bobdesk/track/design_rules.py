"""Design rules: limits with unit and source, and what a line makes of them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from bobdesk.arrays import BoolArray, FloatArray
from bobdesk.errors import InputError
from bobdesk.track.centreline3d import Centreline3D
from bobdesk.track.rounding import half_unit
from bobdesk.track.sled import GRAVITY, Ride, Sled, ride

Quantity = Literal["length", "mean gradient", "gradient", "speed", "acceleration", "curves"]
QUANTITIES: tuple[Quantity, ...] = get_args(Quantity)
UNITS: dict[Quantity, str] = {
    "length": "m",
    "mean gradient": "gradient",
    "gradient": "gradient",
    "speed": "km/h",
    "acceleration": "g",
    "curves": "curves",
}
Verdict = Literal["kept", "broken", "not judged"]
_KMH = 3.6
# Stretches of a finding that lie so near to each other are one, m.
_ONE_STRETCH = 5.0
_LONGEST_TEXT = 300


@dataclass(frozen=True)
class Rule:
    """A limit of a quantity.

    Attributes
    ----------
    name
        Free text.
    quantity
        What is judged: the 3D length; the mean gradient of a stretch, drop / plan length; the gradient anywhere; speed
        and load of a simple sled (`bobdesk.track.sled`); the number of curves.
    lowest, highest
        In the quantity's unit (`UNITS`), or None. Where both are the same number, it is meant as it is written: 0.02
        is anything that rounds to it.
    start, end
        The stretch in plan, m; an `end` of None is the lowest point.
    source
        Where the limit comes from.
    is_used
        Whether it is judged.
    """

    name: str
    quantity: Quantity
    lowest: float | None = None
    highest: float | None = None
    start: float = 0.0
    end: float | None = None
    source: str = ""
    is_used: bool = True

    @property
    def unit(self) -> str:
        """Of the limits."""
        return UNITS[self.quantity]


@dataclass(frozen=True)
class Finding:
    """What a line makes of a rule.

    Attributes
    ----------
    rule
        Which one.
    verdict
        Kept, broken, or not judged.
    value
        The quantity, of gradients, speeds and loads the one farthest beyond a limit or nearest to it; None
        if it is not judged.
    stretches
        Where it is broken, from and to, m in plan; of figures of the whole line that line.
    why
        Why it is not judged; "" if it is.
    """

    rule: Rule
    verdict: Verdict
    value: float | None = None
    stretches: tuple[tuple[float, float], ...] = ()
    why: str = ""


def check_rule(rule: Rule) -> Rule:
    """Return a rule if it makes sense by itself.

    Raises
    ------
    InputError
        Otherwise.
    """
    if not rule.name.strip():
        raise InputError("a rule needs a name")
    if len(rule.name) > _LONGEST_TEXT or len(rule.source) > _LONGEST_TEXT:
        raise InputError(f"the name and the source of a rule may have {_LONGEST_TEXT} letters")
    if not (rule.name.isprintable() and rule.source.isprintable()):
        raise InputError("the name and the source of a rule must be one line of letters each")
    if rule.quantity not in QUANTITIES:
        raise InputError(f'the rule "{rule.name}" must be about one of {", ".join(QUANTITIES)}')
    numbers = [value for value in (rule.lowest, rule.highest, rule.start, rule.end) if value is not None]
    if not all(math.isfinite(value) and abs(value) <= 1e6 for value in numbers):
        raise InputError(f'a number of the rule "{rule.name}" cannot be used')
    if rule.lowest is not None and rule.highest is not None and rule.lowest > rule.highest:
        raise InputError(f'the rule "{rule.name}" asks for at least {rule.lowest:g} and at most {rule.highest:g}')
    if rule.start < 0 or (rule.end is not None and rule.end <= rule.start):
        raise InputError(f'the stretch of the rule "{rule.name}" must begin at 0 or later and end after that')
    return rule


def judged(line: Centreline3D, rules: Iterable[Rule], sled: Sled | None = None) -> tuple[Finding, ...]:
    """Judge a line by each rule that is used.

    Parameters
    ----------
    line
        In true size, from start to finish.
    rules
        In the order of the findings.
    sled
        For speeds and loads; the usual one without.

    Raises
    ------
    InputError
        If the sled has a figure that cannot be used.
    """
    used = [rule for rule in rules if rule.is_used]
    run = ride(line, sled) if any(rule.quantity in ("speed", "acceleration") for rule in used) else None
    return tuple(_finding(line, rule, run) for rule in used)


def not_judged(rules: Iterable[Rule], why: str) -> tuple[Finding, ...]:
    """Return findings that say of each rule that is used why it is not judged."""
    return tuple(Finding(rule, "not judged", why=why) for rule in rules if rule.is_used)


def _finding(line: Centreline3D, rule: Rule, run: Ride | None) -> Finding:
    if rule.lowest is None and rule.highest is None:
        return Finding(rule, "not judged", why="it has no limit yet")
    whole = float(line.stations[-1])
    if rule.quantity == "length":
        return _of_figure(rule, float(line.slope_lengths[-1]), (0.0, whole))
    if rule.quantity == "curves":
        count = sum(segment.kind == "curve" for segment in line.segments)
        return _of_figure(rule, float(count), (0.0, whole))
    lowest = float(line.stations[int(line.elevations.argmin())])
    end = lowest if rule.end is None else rule.end
    if end > whole + 1e-6:
        return Finding(rule, "not judged", why=f"the line is only {whole:.1f} m long, and the rule is about {end:g} m")
    if rule.start >= end:
        return Finding(rule, "not judged", why=f"the lowest point comes at {end:.1f} m, before the rule begins")
    if rule.quantity == "mean gradient":
        levels = np.interp([rule.start, end], line.stations, line.elevations)
        return _of_figure(rule, float(levels[0] - levels[1]) / (end - rule.start), (rule.start, end))
    # Speeds and gradients are judged up to the finish, not to the lowest point alone.
    end = whole if rule.end is None else end
    if rule.quantity == "gradient":
        return _of_rows(rule, line.stations, line.gradients, end)
    assert run is not None
    if run.stops and run.stations[-1] < end:
        return Finding(rule, "not judged", why=f"the sled comes to rest at {run.stations[-1]:.1f} m")
    values = _KMH * run.speeds if rule.quantity == "speed" else run.load / GRAVITY
    return _of_rows(rule, run.stations, values, end)


def _limits(rule: Rule) -> tuple[float, float]:
    low = -math.inf if rule.lowest is None else rule.lowest
    high = math.inf if rule.highest is None else rule.highest
    if low == high:
        half = half_unit(low)
        return low - half, high + half
    return low, high


def _of_figure(rule: Rule, value: float, stretch: tuple[float, float]) -> Finding:
    low, high = _limits(rule)
    # What a file keeps of a number must not break a rule that the number keeps.
    room = 1e-9 * max(abs(value), 1.0)
    if low - room <= value <= high + room:
        return Finding(rule, "kept", value)
    return Finding(rule, "broken", value, (stretch,))


def _of_rows(rule: Rule, stations: FloatArray, values: FloatArray, end: float) -> Finding:
    inside = (stations >= rule.start - 1e-9) & (stations <= end + 1e-9)
    stations, values = stations[inside], values[inside]
    if not len(values):
        return Finding(rule, "not judged", why="no row of the line lies in its stretch")
    low, high = _limits(rule)
    beyond = np.maximum(values - high, low - values)
    worst = float(values[int(beyond.argmax())])
    broken = beyond > 1e-9
    if not broken.any():
        return Finding(rule, "kept", worst)
    return Finding(rule, "broken", worst, _stretches(stations, broken))


def _stretches(stations: FloatArray, broken: BoolArray) -> tuple[tuple[float, float], ...]:
    """Return from where to where rows are broken; a row alone reaches half way to its neighbours."""
    edges = np.concatenate([stations[:1], 0.5 * (stations[1:] + stations[:-1]), stations[-1:]])
    found: list[tuple[float, float]] = []
    for index in np.flatnonzero(broken).tolist():
        start, end = float(edges[index]), float(edges[index + 1])
        if found and start - found[-1][1] <= _ONE_STRETCH:
            found[-1] = (found[-1][0], end)
        else:
            found.append((start, end))
    return tuple(found)

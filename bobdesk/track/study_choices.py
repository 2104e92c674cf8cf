"""What a study is made of, as a person writes it: numbers of segments, weights, sets of known elevations."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence

from bobdesk.errors import InputError
from bobdesk.solve.targets import KnownElevation

AUTOMATIC = "auto"
NO_SET = "none"
MOST_CELLS = 100_000
_MOST_SEGMENTS = 1000
_RANGE = re.compile(r"(\d{1,6})\s*[-–]\s*(\d{1,6})(?:\s*[:/]\s*(\d{1,6}))?")
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")


def counts_of(text: str) -> tuple[int | None, ...]:
    """Return numbers of segments: "10,15,21", "10-20", "10-30:5" (every fifth), "auto" (None); each once.

    Raises
    ------
    InputError
        If it is anything else.
    """
    found: dict[int | None, None] = {}
    for part in re.split(r"[,;]", re.sub(r"(?<=\d)\s+(?=\d)", ",", text.strip())):
        word = part.strip()
        between = _RANGE.fullmatch(word)
        if word.lower() == AUTOMATIC:
            found[None] = None
        elif between is not None:
            first, last, step = int(between[1]), int(between[2]), int(between[3] or 1)
            if not (0 < first <= last <= _MOST_SEGMENTS and step > 0):
                raise _no_counts(text)
            found |= dict.fromkeys(range(first, last + 1, step))
        elif word.isdecimal() and 0 < int(word) <= _MOST_SEGMENTS:
            found[int(word)] = None
        else:
            raise _no_counts(text)
    return tuple(found)


def _no_counts(text: str) -> InputError:
    return InputError(f"numbers of segments such as 10,15,21 or 10-20 are needed, or auto, not '{text[:60]}'")


def weights_of(parts: Sequence[str], number: Callable[[str], float] = float) -> tuple[float, ...]:
    """Return weights, each once.

    Parameters
    ----------
    parts
        One number each.
    number
        Reads one; raises ValueError or InputError.

    Raises
    ------
    InputError
        If one is no number of 0 or more.
    """
    try:
        found = tuple(dict.fromkeys(number(part) for part in parts))
    except (ValueError, InputError):
        found = (-1.0,)
    if not found or not all(0 <= weight < math.inf for weight in found):
        raise InputError(f"weights such as 0.5,1,1.5 are needed, not '{','.join(parts)[:60]}'")
    return found


def known_elevation(text: str) -> KnownElevation:
    """Return the elevation in STATION:ELEVATION or STATION:ELEVATION:TOLERANCE.

    Raises
    ------
    InputError
        If it is anything else.
    """
    parts = text.split(":")
    numbers = [float(part) for part in parts if _NUMBER.fullmatch(part.strip())]
    if len(numbers) not in (2, 3) or len(numbers) < len(parts):
        raise InputError(f"STATION:ELEVATION is needed, two numbers in metres such as 250:98.5, not '{text[:60]}'")
    return KnownElevation(*numbers)


def known_set(text: str, elevation: Callable[[str], KnownElevation] = known_elevation) -> tuple[KnownElevation, ...]:
    """Return the elevations of a set by station, each once; parted by spaces or semicolons.

    "none" and "" are the empty set.

    Parameters
    ----------
    elevation
        Reads one; raises InputError.

    Raises
    ------
    InputError
        If one of them is none.
    """
    if text.strip().lower() in ("", NO_SET):
        return ()
    parts = [part for part in re.split(r"[;\s]+", text) if part]
    found = {elevation(part) for part in parts or [text]}
    return tuple(sorted(found, key=lambda known: (known.station, known.elevation, known.tolerance)))


def set_name(known: Sequence[KnownElevation]) -> str:
    """Return the one way in which a set from `known_set` is written, and by which it is known."""
    return " ".join(_written(each) for each in known) or NO_SET


def _written(known: KnownElevation) -> str:
    numbers = [known.station, known.elevation, *([known.tolerance] if known.tolerance else [])]
    # Adding 0 takes the sign from a zero.
    return ":".join(f"{number + 0.0:.12g}" for number in numbers)


def check_size(count: int) -> None:
    """Refuse a study of more cells than anybody waits for.

    Raises
    ------
    InputError
        If there are too many.
    """
    if count > MOST_CELLS:
        raise InputError(f"these are {count:,} rows; {MOST_CELLS:,} are allowed")

"""JSON that may be hostile: limits on size and parts, no NaN, no endless nesting."""

from __future__ import annotations

import json
import math
from typing import Any, NoReturn

from bobdesk.errors import InputError
from bobdesk.files.importers.text import decode_text

_LIMIT_BYTES = 100_000_000
_LIMIT_PARTS = 6_000_000
_LIMIT_MEMBERS = 3_000_000
_LIMIT_OBJECTS = 600_000


def parse_json(data: bytes, *, name: str) -> Any:
    """Return what the JSON text holds.

    Raises
    ------
    InputError
        If it is damaged, over a limit, nested too deep, or holds NaN or Infinity.
    """
    # A list or number takes up to thirty times its text in memory, so parts are counted beforehand.
    parts, objects = data.count(b",") + data.count(b"["), data.count(b"{")
    too_many = parts > _LIMIT_PARTS or objects > _LIMIT_OBJECTS or data.count(b":") > _LIMIT_MEMBERS
    if len(data) > _LIMIT_BYTES or too_many:
        raise InputError(
            f"{name}: the JSON text is too large ({len(data) / 1e6:,.0f} MB, {parts + objects:,} parts);"
            " cut out the track first"
        )
    text = decode_text(data, name=name)
    try:
        return json.loads(text, parse_constant=_refuse)
    except json.JSONDecodeError as error:
        raise InputError(
            f"{name}, line {error.lineno}, column {error.colno}: the JSON text is damaged or ends too early"
        ) from error
    except RecursionError:
        raise InputError(f"{name}: the JSON text is nested too deep") from None
    except _NotANumberError as error:
        raise InputError(f"{name}: the JSON text holds {error}, which is not a finite number") from None
    except ValueError:
        raise InputError(f"{name}: the JSON text holds a number of over 4,000 digits") from None


def finite_number(value: object) -> float:
    """Return a JSON number, NaN if it is something else or too large."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return math.nan
    try:
        number = float(value)
    except OverflowError:
        return math.nan
    return number if math.isfinite(number) else math.nan


class _NotANumberError(Exception):
    """The text holds NaN, Infinity or -Infinity."""


def _refuse(constant: str) -> NoReturn:
    raise _NotANumberError(constant)
